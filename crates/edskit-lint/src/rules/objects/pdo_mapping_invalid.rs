use super::structure::belongs_elsewhere;
use crate::rule::rule;
use crate::{Context, Edit, Report, Variable};

rule! {
    /// PDOMapping or SRDOMapping is neither 0 nor 1
    ///
    /// ## What it does
    /// Reports a `PDOMapping` or `SRDOMapping` that is not `0` or `1`.
    ///
    /// ## Why is this bad
    /// Readers take what they do not understand for 0, for 1, or refuse the file.
    ///
    /// ## Example
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=rw
    /// PDOMapping=yes
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2010]
    /// ParameterName=Ramp time
    /// DataType=0x0006
    /// AccessType=rw
    /// PDOMapping=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3 and 4.6.3.2.
    pub(crate) static PDO_MAPPING_INVALID = {
        code: "OBJ022",
        name: "pdomapping-invalid",
        group: Objects,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("29"), EdsDcfCheck("OBJ009"), Dcfchk("invalid value for")],
        check: Variable(check),
    }
}

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    for field in [variable.pdo_mapping, variable.srdo_mapping].into_iter().flatten() {
        if field.value.is_ok() || belongs_elsewhere(field.entry) {
            continue;
        }
        let key = field.entry.key().name.spelling();
        let finding = report.add(field.span(), format!("{key} is `{}` instead of 0 or 1", field.text()));
        match field.known() {
            Some(flag) => finding.help(format!("write `{key}={}`", u8::from(flag))).unsafe_fix(
                format!("Write {}", u8::from(flag)),
                vec![Edit::replace(field.span(), u8::from(flag).to_string())],
            ),
            None => finding.help(format!("write `{key}=1` if the object may be mapped, else `{key}=0`")),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn flags_of_both_keys() {
        let text = "[2000]\nPDOMapping=0;\nSRDOMapping=2\n[2001]\nPDOMapping=0x1\nSRDOMapping=\n[2002]\nPDOMapping=1 ; yes\n";
        assert_eq!(
            findings(&PDO_MAPPING_INVALID, text),
            [
                "2:12 warning: PDOMapping is `0;` instead of 0 or 1",
                "3:13 warning: SRDOMapping is `2` instead of 0 or 1"
            ]
        );
    }

    #[test]
    fn what_was_meant() {
        for (value, flag) in [("0;", "0"), ("\"1\"", "1"), ("FALSE", "0"), ("TPDO", "1"), ("10", "10")] {
            assert_eq!(
                fixed(&PDO_MAPPING_INVALID, &format!("[2000]\nPDOMapping={value}\n")),
                format!("[2000]\nPDOMapping={flag}\n")
            );
        }
    }
}
