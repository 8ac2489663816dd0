use super::structure::belongs_elsewhere;
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity, Variable};
use edskit_model::meant;
use edskit_model::{Description, Field, Object, SubObject};
use edskit_types::AccessType;

rule! {
    /// AccessType is none of the six words
    ///
    /// ## What it does
    /// Reports an `AccessType` that is not `ro`, `wo`, `rw`, `rwr`, `rww` or `const`. These words in upper case are a
    /// warning, one for the file.
    ///
    /// ## Why is this bad
    /// A reader that does not know the word refuses the object or guesses the access. Many readers compare the word
    /// exactly, so upper case is a word that they do not know.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=readonly
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=ro
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static ACCESS_TYPE_INVALID = {
        code: "OBJ005",
        name: "accesstype-invalid",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("29"), EdsDcfCheck("OBJ005"), EdsDcfCheck("LIB001"), Dcfchk("invalid AccessType")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(field) = variable.access_type else { return };
    match field.value {
        Ok(access) => {
            if !is_in_lower_case(field, access) && context.is_first(&ACCESS_TYPE_INVALID) {
                upper_case(context, report);
            }
        }
        Err(_) if belongs_elsewhere(field.entry) => {}
        Err(_) => {
            let finding = report.add(field.span(), format!("`{}` is no access type", field.text()));
            match meant::access(&field.text()) {
                Some(access) => finding.help(format!("write `{access}`")).unsafe_fix(
                    format!("Write `{access}`"),
                    vec![Edit::replace(field.span(), access.as_str())],
                ),
                None => finding.help("write `ro`, `wo`, `rw`, `rwr`, `rww` or `const`"),
            };
        }
    }
}

fn is_in_lower_case(field: Field<'_, AccessType>, access: AccessType) -> bool {
    field.entry.raw() == access.as_str().as_bytes()
}

/// All words in upper case at once: who writes one of them so writes all of them so.
fn upper_case(context: &Context<'_>, report: &mut Report) {
    let objects = context.sheet.objects().map(Object::description);
    let subs = context.sheet.sub_objects().map(SubObject::description);
    let fields = objects.chain(subs).filter_map(Description::access_type);
    // Other spellings have findings of their own.
    let mut words: Vec<_> = fields
        .filter_map(|field| Some((field, field.value.ok()?)))
        .filter(|&(field, access)| !is_in_lower_case(field, access))
        .collect();
    words.sort_by_key(|(field, _)| field.span());
    let Some(&(first, access)) = words.first() else { return };
    let more = match words.len() - 1 {
        0 => String::new(),
        1 => ", nor is one more".to_owned(),
        more => format!(", nor are {more} more"),
    };
    let edits = words.iter().map(|(field, access)| Edit::replace(field.span(), access.as_str())).collect();
    report
        .add(first.span(), format!("access type `{}` is not in lower case{more}", first.text()))
        .severity(Severity::Warning)
        .help(format!("write `{access}`"))
        .safe_fix("Write lower case", edits);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn upper_case_is_a_warning_and_other_words_are_errors() {
        let text = "[2000]\nAccessType=RW\n[2001]\nAccessType=UNKNOWN\n[2002]\nAccessType=rw\n[2003]\nAccessType=\n[2004]\nAccessType=ro ; read\n[2004sub0]\nAccessType=Const\n";
        assert_eq!(
            findings(&ACCESS_TYPE_INVALID, text),
            [
                "2:12 warning: access type `RW` is not in lower case, nor is one more",
                "4:12 error: `UNKNOWN` is no access type"
            ]
        );
    }

    #[test]
    fn what_was_meant() {
        for (word, access) in [
            ("R/W", "rw"),
            ("read-only", "ro"),
            ("\"wo\"", "wo"),
            ("cosnt", "const"),
            ("Const", "const"),
            ("rx", "rx"),
        ] {
            assert_eq!(
                fixed(&ACCESS_TYPE_INVALID, &format!("[2000]\nAccessType={word}\n")),
                format!("[2000]\nAccessType={access}\n")
            );
        }
    }
}
