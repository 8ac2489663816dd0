use super::dummy;
use crate::pdos::Target;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::SectionKind;
use edskit_types::PdoDirection;

rule! {
    /// A mapping uses a dummy that `[DummyUsage]` does not allow
    ///
    /// ## What it does
    /// Reports a mapping entry that names a data type to fill a gap, where `[DummyUsage]` does not say 1 for the type.
    ///
    /// ## Why is this bad
    /// The device says that it cannot do what its own mapping does. A tool that builds a mapping will not offer the
    /// dummy, and one that checks a mapping refuses it.
    ///
    /// ## Example
    /// ```eds
    /// [DummyUsage]
    /// Dummy0005=0
    ///
    /// [1600]
    /// ParameterName=RPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1600sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1600sub1]
    /// DataType=0x0007
    /// DefaultValue=0x00050008
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DummyUsage]
    /// Dummy0005=1
    ///
    /// [1600]
    /// ParameterName=RPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1600sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1600sub1]
    /// DataType=0x0007
    /// DefaultValue=0x00050008
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.2.
    pub(crate) static DUMMY_NOT_ENABLED = {
        code: "PDO008",
        name: "dummy-not-enabled",
        group: Pdo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("PDO001")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos().iter().filter(|pdo| pdo.direction == PdoDirection::Receive) {
        for mapped in pdo.mapped().iter().filter(|mapped| matches!(mapped.target, Target::Dummy)) {
            let flag = dummy::flag(context.sheet, mapped.entry.index());
            if !dummy::is_plain(mapped.entry) || flag.is_some_and(|flag| flag.known() != Some(false)) {
                continue;
            }
            let index = mapped.entry.index();
            let key = format!("Dummy{:04X}", index.0);
            let name =
                mapped.data_type().map_or_else(|| index.to_string(), |data_type| data_type.to_string());
            let message = format!("{pdo} maps {name} as a dummy, but `[DummyUsage]` does not say `{key}=1`");
            let finding = report.add(mapped.value.span(), message);
            finding.here(format!("entry {} of the mapping", mapped.sub_index.0));
            finding.help(format!("write `{key}=1` if the device can do this"));
            if let Some(flag) = flag {
                finding
                    .label(flag.entry.span(), "not allowed here")
                    .unsafe_fix("Allow the dummy", vec![Edit::replace(flag.span(), "1")]);
            } else if let Some(section) = context.sheet.section(SectionKind::DummyUsage) {
                let ending = context.document().line_ending().as_str();
                finding.label(section.span(), "not mentioned here").unsafe_fix(
                    "Allow the dummy",
                    vec![Edit::insert(section.end().start, format!("{ending}{key}=1"))],
                );
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn text(usage: &str, entry: &str) -> String {
        format!(
            "{usage}[1600]\nObjectType=9\n[1600sub0]\nDataType=5\nDefaultValue=1\n[1600sub1]\nDataType=7\nDefaultValue={entry}\n"
        )
    }

    #[test]
    fn the_section_must_allow_it() {
        let expected = "RPDO1 maps UNSIGNED16 as a dummy, but `[DummyUsage]` does not say `Dummy0006=1`";
        let without = findings(&DUMMY_NOT_ENABLED, &text("", "0x00060010"));
        assert_eq!(without, [format!("8:14 warning: {expected}")]);
        let other = text("[DummyUsage]\nDummy0005=1\n", "0x00060010");
        assert_eq!(findings(&DUMMY_NOT_ENABLED, &other), [format!("10:14 warning: {expected}")]);
        let allowed = text("[DummyUsage]\nDummy0005=1\nDummy0006=1\n", "0x00060010");
        assert_eq!(fixed(&DUMMY_NOT_ENABLED, &other), allowed);
        assert!(findings(&DUMMY_NOT_ENABLED, &text("[DummyUsage]\nDummy0006=x\n", "0x00060010")).is_empty());
    }

    #[test]
    fn what_is_no_dummy_at_all_belongs_to_the_next_rule() {
        for entry in ["0x00060110", "0x00060008", "0x00080020"] {
            assert!(findings(&DUMMY_NOT_ENABLED, &text("", entry)).is_empty(), "{entry}");
        }
    }
}
