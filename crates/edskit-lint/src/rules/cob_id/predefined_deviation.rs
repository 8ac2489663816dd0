use super::judged::{JudgedCobId, Judgement};
use crate::rule::rule;
use crate::{Context, FileKind, Report};
use edskit_types::{NodeId, Party};

rule! {
    /// A PDO does not begin with the pre-defined connection set
    ///
    /// ## What it does
    /// Reports a PDO 1 to 4 of an EDS that is in use with another CAN-ID than the pre-defined one, and a PDO from 5 on
    /// that is in use at all.
    ///
    /// ## Why is this bad
    /// A device as delivered uses the pre-defined connection set, and nothing else: that is what keeps 127 of them
    /// apart. Device profiles may define other defaults, so this is an information only.
    ///
    /// ## Example
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x280
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1800]
    /// ParameterName=TPDO 1 communication parameter
    /// ObjectType=0x9
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.3.3, 7.5.2.35 and 7.5.2.37.
    pub(crate) static PREDEFINED_DEVIATION = {
        code: "COB007",
        name: "predefined-deviation",
        group: CobId,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    // A DCF holds what somebody chose.
    if context.kind != FileKind::Eds {
        return;
    }
    for JudgedCobId { parameter, judgement } in context.cob_ids() {
        if !matches!(parameter.party, Party::Pdo { .. }) {
            continue;
        }
        let Some(Judgement::Fine(cob_id)) = *judgement else { continue };
        let (party, value) = (parameter.party, parameter.value);
        match party.predefined_can_id(NodeId::MIN) {
            Some(expected) if expected == cob_id.can_id() => {}
            Some(expected) => {
                let base = expected.raw() - u32::from(NodeId::MIN.get());
                report
                    .add(
                        value.span(),
                        format!(
                            "{party} has the COB-ID `{}` instead of `$NODEID+0x{base:X}`",
                            value.entry.text_before_comment()
                        ),
                    )
                    .help(format!(
                        "write `$NODEID+0x{:X}` if the device is delivered so",
                        base | cob_id.0 & 0xE000_0000
                    ));
            }
            None => {
                report
                    .add(
                        value.span(),
                        format!("{party} is in use by default, although it has no pre-defined CAN-ID"),
                    )
                    .help("set bit 31, as in `0x80000000`, so that it is in use only once it is configured");
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in};

    fn text(index: &str, value: &str) -> String {
        format!("[{index}]\nObjectType=9\n[{index}sub1]\nDataType=7\nDefaultValue={value}\n")
    }

    #[test]
    fn what_a_new_device_uses() {
        assert_eq!(
            findings(&PREDEFINED_DEVIATION, &text("1400", "$NODEID+0x300")),
            ["5:14 info: RPDO1 has the COB-ID `$NODEID+0x300` instead of `$NODEID+0x200`"]
        );
        assert_eq!(
            findings(&PREDEFINED_DEVIATION, &text("1804", "0x1A0")),
            ["5:14 info: TPDO5 is in use by default, although it has no pre-defined CAN-ID"]
        );
        for (index, value) in [
            ("1400", "$NODEID+0x40000200"),
            ("1404", "0x80000000"),
            ("1400", "$NODEID+0x80000300"),
            ("1400", "0x205"),
            ("1400", "0x300"),
            ("1800", "0x180"),
        ] {
            assert!(findings(&PREDEFINED_DEVIATION, &text(index, value)).is_empty(), "{index} {value}");
        }
        assert!(findings_in(&PREDEFINED_DEVIATION, "a.dcf", text("1404", "0x1A0").as_bytes()).is_empty());
    }
}
