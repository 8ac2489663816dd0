use crate::evaluate::{effective, node_ids};
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_types::{CobId, Index};

rule! {
    /// The default SDO has other COB-IDs than the pre-defined ones
    ///
    /// ## What it does
    /// Reports a 1200h whose sub-index 01h is not 600h plus the node-ID, or whose sub-index 02h is not 580h plus the node-ID: at
    /// the lowest and the highest node-ID for an EDS, at that of the device for a DCF.
    ///
    /// ## Why is this bad
    /// Every master reaches a device by its default SDO, and knows the two CAN-IDs from the node-ID alone. The device has them
    /// whatever the file says, so the file tells the wrong thing.
    ///
    /// ## Example
    /// ```eds
    /// [1200]
    /// ParameterName=SDO server parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1200sub1]
    /// ParameterName=COB-ID client to server
    /// DataType=0x0007
    /// DefaultValue=0x600
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1200]
    /// ParameterName=SDO server parameter
    /// ObjectType=0x9
    /// SubNumber=3
    ///
    /// [1200sub1]
    /// ParameterName=COB-ID client to server
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x600
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.33.
    pub(crate) static SDO_SERVER_DEFAULT = {
        code: "COM015",
        name: "sdo-server-default",
        group: Communication,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

/// The two CAN-IDs without the node-ID.
const BASES: [(u8, u32); 2] = [(1, 0x600), (2, 0x580)];

fn check(context: &Context<'_>, report: &mut Report) {
    for (sub_index, base) in BASES {
        let Some(value) = effective(context.sheet, Index::SDO_SERVER, sub_index) else { continue };
        let wrong = node_ids(context).find_map(|node_id| {
            let cob_id = value.cob_id_at(node_id)?;
            (cob_id != CobId(base + u32::from(node_id.get()))).then_some((cob_id, node_id))
        });
        let Some((cob_id, node_id)) = wrong else { continue };
        let right = format!("$NODEID+0x{base:X}");
        let message =
            format!("1200h sub-index {sub_index:02X}h is {cob_id} at node-ID {node_id} instead of `{right}`");
        let finding = report.add(value.span(), message);
        finding.help(format!("write `{right}`"));
        // A constant that fits the base has only lost its node-ID.
        if cob_id.0 & !0x7F == base {
            finding.unsafe_fix("Let it follow the node-ID", vec![Edit::replace(value.span(), right)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in, fixed};

    fn text(first: &str, second: &str) -> String {
        format!(
            "[DeviceComissioning]\nNodeID=5\n[1200]\nObjectType=9\n[1200sub1]\nDataType=7\nDefaultValue={first}\n[1200sub2]\nDataType=7\nDefaultValue={second}\n"
        )
    }

    #[test]
    fn both_follow_the_node_id() {
        assert!(findings(&SDO_SERVER_DEFAULT, &text("0x600+$NODEID", "$NODEID+1408")).is_empty());
        assert_eq!(
            findings(&SDO_SERVER_DEFAULT, &text("0x601", "$NODEID+0x80000580")),
            [
                "7:14 warning: 1200h sub-index 01h is 00000601h at node-ID 127 instead of `$NODEID+0x600`",
                "10:14 warning: 1200h sub-index 02h is 80000581h at node-ID 1 instead of `$NODEID+0x580`"
            ]
        );
        assert_eq!(
            fixed(&SDO_SERVER_DEFAULT, &text("0x600", "0x580")),
            text("$NODEID+0x600", "$NODEID+0x580")
        );
    }

    #[test]
    fn a_dcf_may_write_the_sum() {
        assert!(findings_in(&SDO_SERVER_DEFAULT, "a.dcf", text("0x605", "0x585").as_bytes()).is_empty());
        assert_eq!(findings_in(&SDO_SERVER_DEFAULT, "a.dcf", text("0x606", "0x585").as_bytes()).len(), 1);
    }
}
