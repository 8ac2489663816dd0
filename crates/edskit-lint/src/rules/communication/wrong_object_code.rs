use super::wording::with_article;
use crate::profile::alternatives;
use crate::rule::rule;
use crate::{Context, Report, Severity, Variable};
use edskit_types::{Index, ObjectCode};

rule! {
    /// An object has another object code than its profile prescribes
    ///
    /// ## What it does
    /// Reports an object whose code differs from what CiA 301, the device profile named by 1000h, or a profile given
    /// with `--profile` prescribes. ARRAY instead of RECORD, or the reverse, is left alone where OBJ016 reports it, and
    /// is only an information in the profile area.
    ///
    /// ## Why is this bad
    /// A master finds the value of a VAR at sub-index 00h and those of an ARRAY or RECORD above it. With the wrong code
    /// it reads and writes at the wrong place.
    ///
    /// ## Example
    /// ```eds
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// ObjectType=0x8
    /// SubNumber=2
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1017]
    /// ParameterName=Producer heartbeat time
    /// ObjectType=0x7
    /// DataType=0x0006
    /// AccessType=rw
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2; the device profiles.
    pub(crate) static WRONG_OBJECT_CODE = {
        code: "COM001",
        name: "wrong-object-code",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("30"), CanChkEds("31")],
        check: Variable(check),
    }
}

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.prescriptions.is_empty() || variable.sub_index.is_some() {
        return;
    }
    let Some(code) = variable.code else { return };
    for prescription in variable.prescriptions {
        let codes = &prescription.object.codes;
        if codes.is_empty() || codes.contains(&code) {
            continue;
        }
        let is_mix_up = is_listed(code) && codes.iter().all(|code| is_listed(*code));
        if is_mix_up && (is_owned_by_obj016(variable.index) || variable.is_compact()) {
            continue;
        }
        let span = variable.object_type.map_or(variable.description.span(), |field| field.span());
        let wanted = alternatives(codes.iter().map(|code| with_article(*code)));
        let message = format!(
            "{} ({}) is {}, but {} prescribes {wanted}",
            variable.index,
            prescription.object.name,
            with_article(code),
            prescription.profile.name
        );
        let finding = report.add(span, message);
        finding.help(format!("write `ObjectType=0x{}`", codes[0].code()));
        if is_mix_up && variable.index >= Index(0x2000) {
            finding.severity(Severity::Info);
        }
        return;
    }
}

/// Whether the members are the same over the network, whatever the object is called.
fn is_listed(code: ObjectCode) -> bool {
    matches!(code, ObjectCode::Array | ObjectCode::Record)
}

/// Where OBJ016 reports ARRAY and RECORD that are mixed up.
fn is_owned_by_obj016(index: Index) -> bool {
    matches!(
        index.0,
        0x1003 | 0x1010 | 0x1011 | 0x1016 | 0x1018 | 0x1029 | 0x1200..=0x12FF | 0x1400..=0x1BFF
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn the_code_that_counts_is_compared() {
        let text = "[1003]\nParameterName=no code\n[1018]\nObjectType=7\n[1400]\nObjectType=2\n[0020]\nObjectType=5\n[1021]\nObjectType=2\n[2000]\nObjectType=2\n";
        assert_eq!(
            findings(&WRONG_OBJECT_CODE, text),
            [
                "1:1 warning: 1003h (pre-defined error field) is a VAR, but CiA 301 prescribes an ARRAY",
                "4:12 warning: 1018h (identity object) is a VAR, but CiA 301 prescribes a RECORD",
                "6:12 warning: 1400h (RPDO communication parameter) is a DOMAIN, but CiA 301 prescribes a RECORD",
                "8:12 warning: 0020h (complex data type) is a DEFTYPE, but CiA 301 prescribes a DEFSTRUCT"
            ]
        );
    }

    #[test]
    fn what_obj016_reports_is_left_to_it() {
        let text = "[1018]\nObjectType=8\n[1003]\nObjectType=9\n[1A00]\nObjectType=8\n[1028]\nObjectType=9\nCompactSubObj=4\n[1020]\nObjectType=9\n";
        assert_eq!(
            findings(&WRONG_OBJECT_CODE, text),
            ["11:12 warning: 1020h (verify configuration) is a RECORD, but CiA 301 prescribes an ARRAY"]
        );
    }

    #[test]
    fn the_device_type_names_the_profile() {
        let text = |device_type: &str| {
            format!(
                "[1000]\nDataType=7\nDefaultValue={device_type}\n[6040]\nObjectType=8\n[6090]\nObjectType=9\n"
            )
        };
        assert_eq!(
            findings(&WRONG_OBJECT_CODE, &text("0x20192")),
            [
                "5:12 warning: 6040h (controlword) is an ARRAY, but CiA 402 prescribes a VAR",
                "7:12 info: 6090h (velocity encoder resolution) is a RECORD, but CiA 402 prescribes an ARRAY"
            ]
        );
        assert!(findings(&WRONG_OBJECT_CODE, &text("0x191")).is_empty());
    }
}
