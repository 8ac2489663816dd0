use crate::rule::rule;
use crate::rules::syntax::lost_header;
use crate::{Context, Report};
use edskit_model::{SectionKind, SubObject};

rule! {
    /// A sub-object belongs to no object
    ///
    /// ## What it does
    /// Reports sub-objects whose object has no section of its own, once for each object.
    ///
    /// ## Why is this bad
    /// Readers find sub-objects through their object. Without it they are lost, or the file is refused.
    ///
    /// ## Example
    /// ```eds
    /// [2010sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// DataType=0x0006
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramps
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [2010sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    ///
    /// [2010sub1]
    /// ParameterName=Ramp up
    /// DataType=0x0006
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static ORPHAN_SUB_OBJECT = {
        code: "OBJ010",
        name: "orphan-sub-object",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("OBJ008"), Dcfchk("object not defined")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let sheet = context.sheet;
    let housed: usize = sheet.objects().map(|object| object.sub_objects().len()).sum();
    if housed == sheet.sub_objects().len() {
        return;
    }
    let orphans: Vec<SubObject<'_>> =
        sheet.sub_objects().filter(|sub| sheet.object(sub.index()).is_none()).collect();
    for group in orphans.chunk_by(|a, b| a.index() == b.index()) {
        let Some(first) = group.iter().min_by_key(|sub| sub.section().id()) else { continue };
        // The object's header is not where it must be: that is the matter of SYN008 or SYN023.
        if lost_header::hides(context, SectionKind::Object(first.index())) {
            continue;
        }
        let verb = match group.len() - 1 {
            0 => "belongs".to_owned(),
            more => format!("and {more} more belong"),
        };
        let name = first.name();
        let index = first.index();
        let count = group.iter().filter(|sub| sub.sub_index().0 != 0xFF).count();
        report
            .add(first.section().span(), format!("`[{name}]` {verb} to {index}, which is not described"))
            .help(format!(
                "describe the object: `[{:X}]` with ParameterName, ObjectType and `SubNumber={count}`",
                index.0
            ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn an_object_whose_header_lost_its_line_is_described() {
        let text = "[1017]\nPDOMapping=0[2000]\nParameterName=a\nObjectType=9\n[2000sub0]\nDataType=5\n";
        assert_eq!(findings(&ORPHAN_SUB_OBJECT, text), [""; 0]);
    }

    #[test]
    fn one_finding_for_each_object() {
        let text = "[2000sub1]\nDataType=5\n[2000sub0]\nDataType=5\n[2001]\nObjectType=9\n[2001sub0]\nDataType=5\n[2002sub1]\nDataType=5\n";
        assert_eq!(
            findings(&ORPHAN_SUB_OBJECT, text),
            [
                "1:1 error: `[2000sub1]` and 1 more belong to 2000h, which is not described",
                "9:1 error: `[2002sub1]` belongs to 2002h, which is not described"
            ]
        );
    }
}
