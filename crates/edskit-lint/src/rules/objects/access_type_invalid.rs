use super::structure::belongs_elsewhere;
use crate::rule::rule;
use crate::similar::nearest;
use crate::{Context, Edit, Report, Severity, Variable};
use edskit_types::AccessType;

rule! {
    /// AccessType is none of the six words
    ///
    /// ## What it does
    /// Reports an `AccessType` that is not `ro`, `wo`, `rw`, `rwr`, `rww` or `const`. One of these words in upper case
    /// is a warning.
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

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(field) = variable.access_type else { return };
    match field.value {
        Ok(access) => {
            if field.entry.raw() != access.as_str().as_bytes() {
                report
                    .add(field.span(), format!("access type `{}` is not in lower case", field.text()))
                    .severity(Severity::Warning)
                    .help(format!("write `{access}`"))
                    .safe_fix("Write it in lower case", vec![Edit::replace(field.span(), access.as_str())]);
            }
        }
        Err(_) if belongs_elsewhere(field.entry) => {}
        Err(_) => {
            let finding = report.add(field.span(), format!("`{}` is no access type", field.text()));
            match meant(&field.text()) {
                Some(access) => finding.help(format!("write `{access}`")).unsafe_fix(
                    format!("Write `{access}`"),
                    vec![Edit::replace(field.span(), access.as_str())],
                ),
                None => finding.help("write `ro`, `wo`, `rw`, `rwr`, `rww` or `const`"),
            };
        }
    }
}

/// The access type that a word in use elsewhere, or a slip, stands for.
fn meant(word: &str) -> Option<AccessType> {
    let letters: String = word.chars().filter(char::is_ascii_alphabetic).collect();
    match letters.to_ascii_lowercase().as_str() {
        "r" | "read" | "readonly" => Some(AccessType::Ro),
        "w" | "write" | "writeonly" => Some(AccessType::Wo),
        "wr" | "readwrite" => Some(AccessType::Rw),
        "constant" => Some(AccessType::Const),
        known if AccessType::parse(known.as_bytes()).is_some() => AccessType::parse(known.as_bytes()),
        // The other words are too short and too much alike for a guess.
        slip => nearest(slip, [AccessType::Const.as_str()]).map(|_| AccessType::Const),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn upper_case_is_a_warning_and_other_words_are_errors() {
        let text = "[2000]\nAccessType=RW\n[2001]\nAccessType=UNKNOWN\n[2002]\nAccessType=rw\n[2003]\nAccessType=\n[2004]\nAccessType=ro ; read\n";
        assert_eq!(
            findings(&ACCESS_TYPE_INVALID, text),
            [
                "2:12 warning: access type `RW` is not in lower case",
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
