use super::judged::{JudgedCobId, Judgement};
use crate::rule::rule;
use crate::{Context, Edit, FileKind, Report};

rule! {
    /// A COB-ID of an EDS holds one node's number
    ///
    /// ## What it does
    /// Reports a PDO 1 to 4 or an EMCY message of an EDS whose COB-ID is the pre-defined one of a certain node, written
    /// as a constant.
    ///
    /// ## Why is this bad
    /// An EDS describes every device of a type, whatever its node-ID is. On any other node the value is wrong, and two
    /// such devices in one network disturb each other.
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
    /// DefaultValue=0x185
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
    /// CiA 301 v4.2, 7.3.3; CiA 306 v1.3, 4.3.
    pub(crate) static HARD_CODED_NODE_ID = {
        code: "COB006",
        name: "hard-coded-node-id",
        group: CobId,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    // In a DCF that is as it should be, and DCF008 compares it with the node-ID.
    if context.kind != FileKind::Eds {
        return;
    }
    for JudgedCobId { parameter, judgement } in context.cob_ids() {
        let Some(Judgement::OfNode { cob_id, node }) = *judgement else { continue };
        let right = format!("$NODEID+0x{:X}", cob_id.0 - node);
        report
            .add(
                parameter.value.span(),
                format!("{} has the CAN-ID {} of node {node}", parameter.party, cob_id.can_id()),
            )
            .help(format!("write `{right}`"))
            .unsafe_fix("Let it follow the node-ID", vec![Edit::replace(parameter.value.span(), right)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in, fixed};

    fn text(index: &str, value: &str) -> String {
        format!("[{index}]\nObjectType=9\n[{index}sub1]\nDataType=7\nDefaultValue={value}\n")
    }

    #[test]
    fn constants_of_the_predefined_set() {
        assert_eq!(
            findings(&HARD_CODED_NODE_ID, &text("1401", "0x40000305")),
            ["5:14 warning: RPDO2 has the CAN-ID 305h of node 5"]
        );
        assert_eq!(
            fixed(&HARD_CODED_NODE_ID, &text("1401", "0x40000305")),
            text("1401", "$NODEID+0x40000300")
        );
        for (index, value) in
            [("1400", "0x305"), ("1404", "0x205"), ("1400", "0x80000205"), ("1400", "$NODEID+0x200")]
        {
            assert!(findings(&HARD_CODED_NODE_ID, &text(index, value)).is_empty(), "{index} {value}");
        }
        assert!(findings_in(&HARD_CODED_NODE_ID, "a.dcf", text("1400", "0x205").as_bytes()).is_empty());
        assert_eq!(
            findings(&HARD_CODED_NODE_ID, "[1014]\nDataType=7\nDefaultValue=0x86\n"),
            ["3:14 warning: EMCY has the CAN-ID 086h of node 6"]
        );
    }
}
