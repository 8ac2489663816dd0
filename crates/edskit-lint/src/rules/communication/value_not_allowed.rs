use super::wording::range;
use crate::evaluate::{Effective, node_ids, stated};
use crate::profile::{Prescribed, alternatives};
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::{Key, KeyName};

rule! {
    /// A value is none of those that the profile allows
    ///
    /// ## What it does
    /// Reports a `DefaultValue`, a `ParameterValue` or a value of `[xxxxValue]` outside the values that CiA 301, the
    /// device profile named by 1000h, or a profile given with `--profile` lists. In CiA 301 these are the counter
    /// overflow value of the SYNC message (1019h: 0 or 2 to 240) and the error behaviour (1029h: 0 to 2, or 128 to 255
    /// of the manufacturer). A formula is tried with the lowest and the highest node-ID, or with that of the DCF.
    ///
    /// ## Why is this bad
    /// Other values are reserved. A device refuses them (abort code 0609 0030h), or does something that nobody knows.
    ///
    /// ## Example
    /// ```eds
    /// [1019]
    /// ParameterName=Synchronous counter overflow value
    /// DataType=0x0005
    /// AccessType=rw
    /// DefaultValue=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1019]
    /// ParameterName=Synchronous counter overflow value
    /// DataType=0x0005
    /// AccessType=rw
    /// DefaultValue=0
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.22 and 7.5.2.32; the device profiles.
    pub(crate) static VALUE_NOT_ALLOWED = {
        code: "COM008",
        name: "value-not-allowed",
        group: Communication,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("29")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if variable.prescriptions.is_empty() {
        return;
    }
    for prescribed in variable.prescribed() {
        if prescribed.attributes.values.is_empty() {
            continue;
        }
        for value in stated(context, variable) {
            if let Some(wrong) = wrong(context, prescribed, value) {
                complain(variable, prescribed, value, wrong, report);
            }
        }
    }
}

/// What the value is where it is wrong.
fn wrong(context: &Context<'_>, prescribed: Prescribed<'_>, value: Effective<'_>) -> Option<i128> {
    node_ids(context).find_map(|node_id| {
        let number = value.at(node_id)?;
        (!prescribed.attributes.allows_value(number, node_id)).then_some(number)
    })
}

fn complain(
    variable: &Variable<'_>,
    prescribed: Prescribed<'_>,
    value: Effective<'_>,
    wrong: i128,
    report: &mut Report,
) {
    let allowed = alternatives(prescribed.attributes.values.iter().map(range));
    let message = format!(
        "{} ({}) is {wrong}, but {} allows {allowed}",
        place(variable, value),
        prescribed.name,
        prescribed.profile.name
    );
    report.add(value.span(), message).help(format!("write {allowed}"));
}

/// Where the value belongs, which for one of `[xxxxValue]` is not the section that describes it.
fn place(variable: &Variable<'_>, value: Effective<'_>) -> String {
    match value.entry.key() {
        Key { name: KeyName::Item, number } => format!("{} sub-index {number:02X}h", variable.index),
        _ => variable.place(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in};
    use crate::{FileKind, Linter, Profile, RuleSet};
    use edskit_model::Datasheet;

    #[test]
    fn ranges_come_from_the_profile() {
        let text = |value| format!("[1019]\nDataType=5\nDefaultValue={value}\n");
        for value in ["0", "2", "0xF0", "", "x"] {
            assert!(findings(&VALUE_NOT_ALLOWED, &text(value)).is_empty(), "{value}");
        }
        assert_eq!(
            findings(&VALUE_NOT_ALLOWED, &text("0xF1")),
            [
                "3:14 error: 1019h (synchronous counter overflow value) is 241, but CiA 301 allows 0 or 2 to 240"
            ]
        );
    }

    #[test]
    fn elements_and_compact_values_are_looked_at() {
        let text = "[1029]\nObjectType=8\n[1029sub0]\nDataType=5\nDefaultValue=5\n[1029sub1]\nDataType=5\nDefaultValue=1\nParameterValue=3\n[1029sub2]\nDataType=5\nDefaultValue=0x80\n";
        assert_eq!(
            findings_in(&VALUE_NOT_ALLOWED, "a.dcf", text.as_bytes()),
            [
                "9:16 error: 1029h sub-index 01h (communication error) is 3, but CiA 301 allows 0 to 2 or 128 to 255"
            ]
        );
        let text = "[1029]\nObjectType=8\nDataType=5\nDefaultValue=0\nCompactSubObj=3\n[1029Value]\nNrOfEntries=2\n1=2\n3=0x7F\n";
        assert_eq!(
            findings_in(&VALUE_NOT_ALLOWED, "a.dcf", text.as_bytes()),
            [
                "9:3 error: 1029h sub-index 03h (error behaviour object) is 127, but CiA 301 allows 0 to 2 or 128 to 255"
            ]
        );
    }

    #[test]
    fn formulas_are_evaluated_on_both_sides() {
        let profile = Profile::parse(
            "name = 'Ours'\n[[object]]\nindex = 0x2000\nname = 'identifier'\nvalues = ['$NODEID+0x180', [1, 2]]\n",
        );
        let linter = Linter::new(RuleSet::only(&[&VALUE_NOT_ALLOWED])).with_profiles([profile.unwrap()]);
        let messages = |value: &str| {
            let sheet = Datasheet::parse(format!("[2000]\nDataType=7\nDefaultValue={value}\n").as_bytes());
            let findings = linter.lint(&sheet, FileKind::Eds, None);
            findings.into_iter().map(|finding| finding.message).collect::<Vec<_>>()
        };
        assert!(messages("$NODEID+0x180").is_empty() && messages("2").is_empty());
        assert_eq!(messages("0x181"), ["2000h (identifier) is 385, but Ours allows $NODEID+0x180 or 1 to 2"]);
    }
}
