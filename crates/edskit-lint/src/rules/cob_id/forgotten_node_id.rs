use super::judged::{JudgedCobId, Judgement};
use crate::evaluate::commissioned;
use crate::rule::rule;
use crate::{Context, Edit, FileKind, Report};
use edskit_types::CobId;

rule! {
    /// The node-ID is missing in a COB-ID
    ///
    /// ## What it does
    /// Reports a PDO or EMCY message in use whose COB-ID is the bare base of the pre-defined connection set: 200h, 280h
    /// and so on up to 600h, or 80h of EMCY. 180h is the matter of COB001.
    ///
    /// ## Why is this bad
    /// Every device of the type sends on the same CAN-ID, so two of them in one network disturb each other. Mostly the
    /// author forgot `$NODEID+`.
    ///
    /// ## Example
    /// ```eds
    /// [1400]
    /// ParameterName=RPDO 1 communication parameter
    /// ObjectType=0x9
    ///
    /// [1400sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=0x200
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1400]
    /// ParameterName=RPDO 1 communication parameter
    /// ObjectType=0x9
    ///
    /// [1400sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x200
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.3.3; CiA 306 v1.3, 4.3.
    pub(crate) static FORGOTTEN_NODE_ID = {
        code: "COB002",
        name: "forgotten-node-id",
        group: CobId,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for JudgedCobId { parameter, judgement } in context.cob_ids() {
        let Some(Judgement::Bare(cob_id)) = *judgement else { continue };
        let can_id = cob_id.can_id();
        let finding = report.add(
            parameter.value.span(),
            format!("{} has the CAN-ID {can_id}, which lacks the node-ID", parameter.party),
        );
        // Above the bases of PDOs, a node-ID more would make the CAN-ID a restricted one.
        if parameter.base().is_none_or(|base| base != can_id.raw()) {
            finding.help("add the node-ID, or set bit 31 if the message is not in use");
            continue;
        }
        let right = match commissioned(context).filter(|_| context.kind == FileKind::Dcf) {
            Some(node_id) => format!("0x{:X}", CobId(cob_id.0 + u32::from(node_id.get())).0),
            None => format!("$NODEID+0x{:X}", cob_id.0),
        };
        finding
            .help(format!("write `{right}`"))
            .unsafe_fix("Add the node-ID", vec![Edit::replace(parameter.value.span(), right)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed, fixed_in};

    fn text(index: &str, value: &str) -> String {
        format!("[{index}]\nObjectType=9\n[{index}sub1]\nDataType=7\nDefaultValue={value}\n")
    }

    #[test]
    fn bare_bases() {
        let found = |index: &str, value: &str| findings(&FORGOTTEN_NODE_ID, &text(index, value)).join("|");
        assert_eq!(
            found("1801", "0x280"),
            "5:14 warning: TPDO2 has the CAN-ID 280h, which lacks the node-ID"
        );
        for (index, value) in
            [("1801", "0x281"), ("1801", "0x80000280"), ("1801", "$NODEID+0x280"), ("1800", "0x180")]
        {
            assert_eq!(found(index, value), "", "{index} {value}");
        }
        assert_eq!(
            fixed(&FORGOTTEN_NODE_ID, &text("1401", "0x40000300")),
            text("1401", "$NODEID+0x40000300")
        );
        assert_eq!(fixed(&FORGOTTEN_NODE_ID, &text("1401", "0x380")), text("1401", "0x380"));
        let emcy = "[1014]\nDataType=7\nDefaultValue=128\n";
        assert_eq!(fixed(&FORGOTTEN_NODE_ID, emcy), "[1014]\nDataType=7\nDefaultValue=$NODEID+0x80\n");
    }

    #[test]
    fn a_dcf_gets_its_own_number() {
        let dcf = |value: &str| format!("[DeviceComissioning]\nNodeID=5\n{}", text("1400", value));
        assert_eq!(fixed_in(&FORGOTTEN_NODE_ID, "a.dcf", dcf("0x200").as_bytes()), dcf("0x205").as_bytes());
    }
}
