use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Entry, KeyName};

rule! {
    /// ObjFlags is 0
    ///
    /// ## What it does
    /// Reports `ObjFlags=0`, once for the whole file.
    ///
    /// ## Why is this bad
    /// 0 is what a missing entry means, and the entry shall be written only where it is not 0. It makes the file longer
    /// and hides the few objects whose flags matter.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=rw
    /// ObjFlags=0x0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=rw
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.3.
    pub(crate) static OBJ_FLAGS_REDUNDANT = {
        code: "OBJ019",
        name: "objflags-redundant",
        group: Objects,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    if !context.sheet.has_key(KeyName::ObjFlags) {
        return;
    }
    let is_zero = |entry: &Entry<'_>| {
        entry.key().name == KeyName::ObjFlags && entry.unsigned::<u32>().known() == Some(0)
    };
    let zeros: Vec<Entry<'_>> = context.sheet.entries().filter(is_zero).collect();
    let Some(first) = zeros.first() else { return };
    let message = match zeros.len() - 1 {
        0 => "ObjFlags is 0, which is the same as leaving it out".to_owned(),
        1 => "ObjFlags is 0 here and in 1 other section, which is the same as leaving it out".to_owned(),
        more => {
            format!("ObjFlags is 0 here and in {more} other sections, which is the same as leaving it out")
        }
    };
    let lines = zeros.iter().map(|entry| Edit::delete(entry.line().full_span())).collect();
    report.add(first.span(), message).help("leave it out").safe_fix("Leave ObjFlags out", lines);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn one_finding_and_one_fix_for_the_file() {
        let text =
            "[2001sub1]\nObjFlags=0\n[2000]\nObjFlags=1\n[2001]\nA=b\nObjFlags=0x00\n[2002]\nObjFlags=\n";
        assert_eq!(
            findings(&OBJ_FLAGS_REDUNDANT, text),
            ["2:1 info: ObjFlags is 0 here and in 1 other section, which is the same as leaving it out"]
        );
        assert_eq!(
            fixed(&OBJ_FLAGS_REDUNDANT, text),
            "[2001sub1]\n[2000]\nObjFlags=1\n[2001]\nA=b\n[2002]\nObjFlags=\n"
        );
    }
}
