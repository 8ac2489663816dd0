use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_types::NodeId;

rule! {
    /// A node-ID is not 1 to 127
    ///
    /// ## What it does
    /// Reports a `NodeID` of `[DeviceComissioning]` outside 1 to 127. 0 and 255, by which tools mean a device that has
    /// no node-ID yet, are warnings.
    ///
    /// ## Why is this bad
    /// No device can have such a node-ID, and no COB-ID can be computed from it. Tools refuse the file.
    ///
    /// ## Example
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeID=130
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeID=5
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 5; CiA 305 v2.2 for 255.
    pub(crate) static NODE_ID_RANGE = {
        code: "DCF003",
        name: "node-id-range",
        group: Configuration,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("DCF002"), EdsDcfCheck("LIB003"), Dcfchk("invalid node-ID specified")],
        check: File(check),
    }
}

/// What tools write before a node-ID is assigned, and what CiA 305 calls an unconfigured node-ID.
const UNCONFIGURED: [u8; 2] = [0, 0xFF];

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(field) = context.sheet.commissioning().and_then(|section| section.node_id()) else { return };
    let Some(node_id) = field.known().filter(|&node_id| NodeId::new(node_id).is_err()) else { return };
    let help = "write the node-ID that the device has in its network, 1 to 127";
    if UNCONFIGURED.contains(&node_id) {
        report
            .add(field.span(), format!("NodeID is {node_id}, which stands for a device without a node-ID"))
            .severity(Severity::Warning)
            .help(help);
    } else {
        report.add(field.span(), format!("NodeID is {node_id}, but node-IDs are 1 to 127")).help(help);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(node_id: &str) -> String {
        findings(&NODE_ID_RANGE, &format!("[DeviceComissioning]\nNodeID={node_id}\n")).join("|")
    }

    #[test]
    fn node_ids() {
        for fine in ["1", "0x7F", "", "x", "300"] {
            assert_eq!(found(fine), "", "{fine}");
        }
        assert_eq!(found("0"), "2:8 warning: NodeID is 0, which stands for a device without a node-ID");
        assert_eq!(found("0x80"), "2:8 error: NodeID is 128, but node-IDs are 1 to 127");
        assert_eq!(found("0xFF"), "2:8 warning: NodeID is 255, which stands for a device without a node-ID");
    }
}
