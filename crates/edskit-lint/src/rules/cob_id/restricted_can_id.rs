use super::judged::{JudgedCobId, Judgement};
use crate::evaluate::commissioned;
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_types::{Party, PdoDirection, SdoMessage};

rule! {
    /// A CAN-ID is restricted
    ///
    /// ## What it does
    /// Reports a PDO, an EMCY or TIME message or an additional SDO server that is in use with a CAN-ID that CiA 301
    /// keeps free. The COB-IDs of an EDS are evaluated at node-ID 1 and 127; one that is restricted for some node-IDs
    /// only is a warning, and so is a COB-ID of 0, by which many devices mean that nobody has set it up. The SYNC
    /// message is the matter of COM005.
    ///
    /// ## Why is this bad
    /// The range belongs to another service, such as NMT or the default SDO. On the bus the two disturb each other, and
    /// devices refuse the value with abort code 0609 0030h. A plain `0x180` mostly lacks its `$NODEID`.
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
    /// DefaultValue=0x180
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
    /// CiA 301 v4.2, 7.3.5.
    pub(crate) static RESTRICTED_CAN_ID = {
        code: "COB001",
        name: "restricted-can-id",
        group: CobId,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

/// The base of TPDO1, which is restricted itself.
const TPDO1: u32 = 0x180;

fn check(context: &Context<'_>, report: &mut Report) {
    for JudgedCobId { parameter, judgement } in context.cob_ids() {
        let Some(Judgement::Restricted { cob_id, node_id, restriction, always }) = *judgement else {
            continue;
        };
        let (party, value) = (parameter.party, parameter.value);
        let is_unset = cob_id.0 == 0;
        // Of a channel that nobody has set up, one of the two COB-IDs is enough.
        if is_unset && matches!(party, Party::Sdo { message: SdoMessage::Response, .. }) {
            continue;
        }
        let at = match value.depends_on_node_id() && commissioned(context).is_none() {
            true => format!(" at node-ID {node_id}"),
            false => String::new(),
        };
        let message =
            format!("{party} has the CAN-ID {}{at}, which is restricted: {restriction}", cob_id.can_id());
        let finding = report.add(value.span(), message);
        if !always || is_unset {
            finding.severity(Severity::Warning);
        }
        let is_tpdo = matches!(party, Party::Pdo { direction: PdoDirection::Transmit, .. });
        if is_tpdo && !value.depends_on_node_id() && cob_id.can_id().raw() == TPDO1 {
            let right = format!("$NODEID+0x{:X}", cob_id.0);
            finding
                .help(format!("the node-ID is missing: write `{right}`"))
                .unsafe_fix("Add the node-ID", vec![Edit::replace(value.span(), right)]);
        } else if cob_id.can_id().raw() == 0 && party != Party::Time {
            finding.help("set bit 31, as in `0x80000000`, if it is not in use");
        } else {
            finding.help("choose a CAN-ID of 181h to 57Fh, or 680h to 6DFh");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn text(index: &str, value: &str) -> String {
        format!("[{index}]\nObjectType=9\n[{index}sub1]\nDataType=7\nDefaultValue={value}\n")
    }

    #[test]
    fn ranges_of_other_services() {
        let found = |index: &str, value: &str| findings(&RESTRICTED_CAN_ID, &text(index, value)).join("|");
        assert_eq!(
            found("1801", "0x40000180"),
            "5:14 error: TPDO2 has the CAN-ID 180h, which is restricted: 101h to 180h (reserved)"
        );
        assert_eq!(
            fixed(&RESTRICTED_CAN_ID, &text("1801", "0x40000180")),
            text("1801", "$NODEID+0x40000180")
        );
        assert_eq!(
            found("1404", "$NODEID+0x680"),
            "5:14 warning: RPDO5 has the CAN-ID 6FFh at node-ID 127, which is restricted: 6E0h to 6FFh (reserved)"
        );
        assert_eq!(
            found("1404", "$NODEID+0x600"),
            "5:14 error: RPDO5 has the CAN-ID 601h at node-ID 1, which is restricted: 601h to 67Fh (default SDO)"
        );
        assert_eq!(
            found("1800", "0"),
            "5:14 warning: TPDO1 has the CAN-ID 000h, which is restricted: 000h (NMT)"
        );
        for (index, value) in
            [("1800", "0x80000180"), ("1800", "0x181"), ("1280", "0x605"), ("1200", "0x605")]
        {
            assert_eq!(found(index, value), "", "{index} {value}");
        }
        assert!(found("1201", "0").starts_with("5:14 warning: SDO server 2 request has the CAN-ID 000h"));
        assert!(found("1201", "0x605").starts_with("5:14 error: SDO server 2 request has the CAN-ID 605h"));
    }
}
