use super::dummy;
use crate::pdos::{self, Target};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::PdoDirection;

rule! {
    /// A dummy has no meaning
    ///
    /// ## What it does
    /// Reports a mapping entry that names a data type in a TPDO, with a sub-index other than 00h, with another length
    /// than the type has, or of a type above 0007h that `[DummyUsage]` does not allow either.
    ///
    /// ## Why is this bad
    /// A dummy fills a gap in an RPDO: bits that the device skips. A TPDO has nothing to send for it, and devices
    /// refuse the other forms.
    ///
    /// ## Example
    /// ```eds
    /// [1A00]
    /// ParameterName=TPDO 1 mapping parameter
    /// ObjectType=0x9
    /// SubNumber=2
    ///
    /// [1A00sub0]
    /// DataType=0x0005
    /// DefaultValue=1
    ///
    /// [1A00sub1]
    /// DataType=0x0007
    /// DefaultValue=0x00050008
    /// ```
    ///
    /// ## Use instead
    /// ```eds
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
    /// CiA 301 v4.2, 7.4.1 and 7.5.2.36; CiA 306 v1.3, 4.6.2.
    pub(crate) static DUMMY_INVALID = {
        code: "PDO009",
        name: "dummy-invalid",
        group: Pdo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("74"), EdsDcfCheck("PDO001")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for pdo in context.pdos() {
        for mapped in pdo.mapped().iter().filter(|mapped| matches!(mapped.target, Target::Dummy)) {
            let entry = mapped.entry;
            let is_receive = pdo.direction == PdoDirection::Receive;
            if is_receive && dummy::is_plain(entry) {
                continue;
            }
            let allowed =
                || dummy::flag(context.sheet, entry.index()).and_then(|flag| flag.known()) == Some(true);
            let (message, help) = match mapped.data_type() {
                _ if !is_receive => (
                    format!(
                        "{pdo} maps the data type {} as a dummy, but a TPDO has nothing to send for it",
                        entry.index()
                    ),
                    "map an object of the same length".to_owned(),
                ),
                Some(data_type) if data_type.can_be_dummy() || allowed() => match data_type.bits() {
                    _ if entry.sub_index().0 != 0 => (
                        format!("{pdo} maps sub-index {} of the data type {data_type}", entry.sub_index()),
                        format!("write `0x{:04X}00{:02X}`", entry.index().0, entry.bits()),
                    ),
                    Some(bits) if bits != u16::from(entry.bits()) => (
                        format!(
                            "{pdo} maps {} of the data type {data_type}, which has {bits}",
                            pdos::bits(entry.bits())
                        ),
                        format!("write `0x{:04X}00{bits:02X}`", entry.index().0),
                    ),
                    _ => continue,
                },
                _ => (
                    format!(
                        "{pdo} maps the data type {} as a dummy, but only 0001h to 0007h can be dummies",
                        entry.index()
                    ),
                    "fill the gap with dummies of 0005h to 0007h, UNSIGNED8 to UNSIGNED32".to_owned(),
                ),
            };
            report
                .add(mapped.value.span(), message)
                .here(format!("entry {} of the mapping", mapped.sub_index.0))
                .help(help);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(mapping: &str, entry: &str) -> String {
        let text = format!(
            "[{mapping}]\nObjectType=9\n[{mapping}sub0]\nDataType=5\nDefaultValue=1\n[{mapping}sub1]\nDataType=7\nDefaultValue={entry}\n[DummyUsage]\nDummy0010=1\n"
        );
        findings(&DUMMY_INVALID, &text).join("|")
    }

    #[test]
    fn forms_of_dummies() {
        assert_eq!(found("1600", "0x00070020"), "");
        assert_eq!(found("1600", "0x00100018"), "");
        assert_eq!(found("1600", "0x60000008"), "");
        assert_eq!(
            found("1A00", "0x00070020"),
            "8:14 warning: TPDO1 maps the data type 0007h as a dummy, but a TPDO has nothing to send for it"
        );
        assert_eq!(
            found("1600", "0x00070120"),
            "8:14 warning: RPDO1 maps sub-index 01h of the data type UNSIGNED32"
        );
        assert_eq!(
            found("1600", "0x00070008"),
            "8:14 warning: RPDO1 maps 8 bits of the data type UNSIGNED32, which has 32"
        );
        assert_eq!(
            found("1600", "0x00080020"),
            "8:14 warning: RPDO1 maps the data type 0008h as a dummy, but only 0001h to 0007h can be dummies"
        );
    }
}
