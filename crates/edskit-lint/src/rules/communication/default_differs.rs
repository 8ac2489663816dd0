use crate::evaluate::{Effective, node_ids};
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_types::{DataType, Index};

rule! {
    /// A default value differs from that of the profile
    ///
    /// ## What it does
    /// Reports a `DefaultValue` that differs from the one which CiA 301, the device profile named by 1000h, or a profile given
    /// with `--profile` states. 1014h is left to COM009, and a value that is not allowed at all to COM008.
    ///
    /// ## Why is this bad
    /// Most such differences are choices. But a master that relies on the profile, and does not set the object, meets another
    /// device than it expects.
    ///
    /// ## Example
    /// ```eds
    /// [1015]
    /// ParameterName=Inhibit time EMCY
    /// DataType=0x0006
    /// AccessType=rw
    /// DefaultValue=100
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1015]
    /// ParameterName=Inhibit time EMCY
    /// DataType=0x0006
    /// AccessType=rw
    /// DefaultValue=0
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2; the device profiles.
    pub(crate) static DEFAULT_DIFFERS = {
        code: "COM018",
        name: "default-differs",
        group: Communication,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("default differs")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.prescriptions.is_empty() || variable.index == Index::EMCY_COB_ID {
        return;
    }
    let Some(field) = variable.default_value else { return };
    for prescribed in variable.prescribed() {
        let Some(expected) = prescribed.attributes.default else { continue };
        let data_type = variable.standard_type.unwrap_or(DataType::Unsigned64);
        let Some(value) = Effective::new(field, data_type) else { return };
        // What is not even allowed is the matter of COM008.
        let differs = |node_id| {
            value.at(node_id).is_some_and(|number| {
                number != expected.at(node_id) && prescribed.attributes.allows_value(number, node_id)
            })
        };
        if node_ids(context).any(differs) {
            let message = format!(
                "the default value of {} ({}) is {}, but that of {} is {expected}",
                variable.place(),
                prescribed.name,
                field.text(),
                prescribed.profile.name
            );
            report.add(field.span(), message);
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;
    use crate::{FileKind, Linter, Profile, RuleSet};
    use edskit_model::Datasheet;

    #[test]
    fn only_another_number_differs() {
        let found =
            |value: &str| findings(&DEFAULT_DIFFERS, &format!("[1006]\nDataType=7\nDefaultValue={value}\n"));
        assert!(found("0").is_empty() && found("0x00").is_empty() && found("x").is_empty());
        assert_eq!(
            found("0x10"),
            [
                "3:14 info: the default value of 1006h (communication cycle period) is 0x10, but that of CiA 301 is 0"
            ]
        );
    }

    #[test]
    fn a_formula_is_compared_at_both_ends() {
        let profile = Profile::parse(
            "name = 'Ours'\n[[object]]\nindex = 0x2000\nname = 'identifier'\ndefault = '$NODEID+0x180'\n",
        );
        let linter = Linter::new(RuleSet::only(&[&DEFAULT_DIFFERS])).with_profiles([profile.unwrap()]);
        let found = |value: &str| {
            let sheet = Datasheet::parse(format!("[2000]\nDataType=7\nDefaultValue={value}\n").as_bytes());
            linter.lint(&sheet, FileKind::Eds, None).len()
        };
        assert_eq!((found("$NODEID+384"), found("0x181"), found("$NODEID")), (0, 1, 1));
    }
}
