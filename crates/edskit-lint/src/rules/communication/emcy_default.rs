use crate::evaluate::{effective, node_ids};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_types::{CobId, IdentifierRules, Index};

rule! {
    /// The EMCY message has another CAN-ID than the pre-defined one
    ///
    /// ## What it does
    /// Reports a valid 1014h whose CAN-ID is not 80h plus the node-ID. A COB-ID without `$NODEID` that fits some node-ID or is
    /// the bare 80h is left to COB002 and COB006, a restricted one to COB001.
    ///
    /// ## Why is this bad
    /// Masters, analysers and people look for emergency messages at 80h plus the node-ID. They take a message elsewhere for
    /// something else.
    ///
    /// ## Example
    /// ```eds
    /// [1014]
    /// ParameterName=COB-ID EMCY
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=$NODEID+0x680
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1014]
    /// ParameterName=COB-ID EMCY
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=$NODEID+0x80
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.17.
    pub(crate) static EMCY_DEFAULT = {
        code: "COM009",
        name: "emcy-default",
        group: Communication,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(value) = effective(context.sheet, Index::EMCY_COB_ID, 0) else { return };
    let differs = node_ids(context).find_map(|node_id| {
        let cob_id = value.cob_id_at(node_id)?;
        let expected = 0x80 + u32::from(node_id.get());
        is_another(cob_id, expected, value.depends_on_node_id()).then_some((cob_id.can_id(), expected))
    });
    let Some((can_id, expected)) = differs else { return };
    report
        .add(value.span(), format!("the EMCY message has the CAN-ID {can_id} instead of {expected:03X}h"))
        .help("write `$NODEID+0x80`");
}

/// Whether the CAN-ID is in use, can be used, and is not the expected one.
fn is_another(cob_id: CobId, expected: u32, depends_on_node_id: bool) -> bool {
    if !cob_id.is_valid() || cob_id.has_stray_bits() || cob_id.can_id().raw() == expected {
        return false;
    }
    // A constant in this range is one that lacks `$NODEID`.
    let lacks_node_id = !depends_on_node_id && (0x80..=0xFF).contains(&cob_id.can_id().raw());
    !lacks_node_id && IdentifierRules::CIA_301.restriction(cob_id.can_id()).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in};

    #[test]
    fn only_what_is_left_by_the_cob_rules() {
        let text = |value: &str| {
            format!("[DeviceComissioning]\nNodeID=5\n[1014]\nDataType=7\nDefaultValue={value}\n")
        };
        let found = |value: &str| findings(&EMCY_DEFAULT, &text(value));
        for value in
            ["$NODEID+0x80", "0x80+$NODEID", "0x80", "0x86", "0x80000080", "$NODEID+0x700", "0x1080", ""]
        {
            assert!(found(value).is_empty(), "{value}");
        }
        assert_eq!(
            found("$NODEID+0x81"),
            ["5:14 info: the EMCY message has the CAN-ID 082h instead of 081h"]
        );
        assert_eq!(found("0x200"), ["5:14 info: the EMCY message has the CAN-ID 200h instead of 081h"]);
        let in_dcf = |value: &str| findings_in(&EMCY_DEFAULT, "a.dcf", text(value).as_bytes());
        assert!(in_dcf("0x85").is_empty());
        assert_eq!(in_dcf("0x205"), ["5:14 info: the EMCY message has the CAN-ID 205h instead of 085h"]);
    }
}
