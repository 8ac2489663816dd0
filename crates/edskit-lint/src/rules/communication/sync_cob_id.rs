use crate::evaluate::{Effective, effective, node_ids};
use crate::rule::rule;
use crate::{Context, Finding, Report, Severity};
use edskit_types::{CobId, IdentifierRules, Index};

rule! {
    /// The COB-ID of the SYNC message cannot be used
    ///
    /// ## What it does
    /// Reports a 1005h with bits between 11 and 28 although bit 29 says that the CAN-ID has 11 bits, and one whose CAN-ID
    /// CiA 301 restricts.
    ///
    /// ## Why is this bad
    /// With stray bits the device takes another CAN-ID than the one that was meant. On a restricted CAN-ID the SYNC message
    /// collides with a service of the network.
    ///
    /// ## Example
    /// ```eds
    /// [1005]
    /// ParameterName=COB-ID SYNC
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=0x00008000
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1005]
    /// ParameterName=COB-ID SYNC
    /// DataType=0x0007
    /// AccessType=rw
    /// DefaultValue=0x00000080
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.3.5 and 7.5.2.5.
    pub(crate) static SYNC_COB_ID = {
        code: "COM005",
        name: "sync-cob-id",
        group: Communication,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(value) = effective(context.sheet, Index::SYNC_COB_ID, 0) else { return };
    let problem = node_ids(context).find_map(|node_id| problem(value.cob_id_at(node_id)?));
    if let Some(problem) = problem {
        let finding = complain(value, problem, report);
        if value.constant::<u32>() == Some(0) {
            finding.severity(Severity::Warning);
        }
    }
}

/// What is wrong with a COB-ID.
fn problem(cob_id: CobId) -> Option<String> {
    if cob_id.has_stray_bits() {
        let stray = cob_id.0 & CobId::STRAY_MASK;
        return Some(format!("1005h is {cob_id}, whose bits {stray:08X}h belong to no 11-bit CAN-ID"));
    }
    let can_id = cob_id.can_id();
    let restriction = IdentifierRules::CIA_301.restriction(can_id)?;
    Some(format!("the SYNC message has the CAN-ID {can_id}, but {restriction} cannot be used for it"))
}

fn complain<'a>(value: Effective<'_>, problem: String, report: &'a mut Report) -> &'a mut Finding {
    report
        .add(value.span(), problem)
        .help("write `0x80`, or `0x40000080` for a device that produces the SYNC message")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn stray_bits_and_restricted_can_ids() {
        let found =
            |value: &str| findings(&SYNC_COB_ID, &format!("[1005]\nDataType=7\nDefaultValue={value}\n"));
        for value in ["0x80", "128", "0x40000080", "0x80000081", "0x20012345", "0x6DF", ""] {
            assert!(found(value).is_empty(), "{value}");
        }
        assert_eq!(
            found("0x8000"),
            ["3:14 error: 1005h is 00008000h, whose bits 00008000h belong to no 11-bit CAN-ID"]
        );
        assert_eq!(
            found("$NODEID+0x600"),
            [
                "3:14 error: the SYNC message has the CAN-ID 601h, but 601h to 67Fh (default SDO) cannot be used for it"
            ]
        );
        assert_eq!(found("0x40000000").len(), 1);
    }
}
