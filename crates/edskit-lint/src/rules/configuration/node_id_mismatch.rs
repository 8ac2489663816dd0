use crate::evaluate::commissioned;
use crate::rule::rule;
use crate::{Context, Edit, FileKind, Report, Variable};
use edskit_model::{Formula, Value};
use edskit_types::{CobId, DataType, SubIndex};

rule! {
    /// A value belongs to another node than the one that is commissioned
    ///
    /// ## What it does
    /// Reports a constant in a DCF that the default of the object, or the pre-defined connection set, gives to another
    /// node-ID than `NodeID`: the COB-IDs of PDO 1 to 4 and of EMCY, and every value whose default is a formula.
    ///
    /// ## Why is this bad
    /// The file was probably copied from another node, or its node-ID was changed later. Two nodes with the same
    /// COB-IDs disturb each other.
    ///
    /// ## Example
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeID=5
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// ParameterValue=0x186
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [DeviceComissioning]
    /// NodeID=5
    ///
    /// [1800sub1]
    /// ParameterName=COB-ID
    /// DataType=0x0007
    /// DefaultValue=$NODEID+0x180
    /// ParameterValue=0x185
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.3.3. That a value of another node is a slip is engineering judgement: the COB-IDs of PDOs may
    /// be chosen, but hardly so.
    pub(crate) static NODE_ID_MISMATCH = {
        code: "DCF008",
        name: "node-id-mismatch",
        group: Configuration,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    if context.kind != FileKind::Dcf {
        return;
    }
    let Some(field) = variable.parameter_value.or(variable.default_value) else { return };
    let Some(Value::Integer(number)) = field.known() else { return };
    let offset = match variable.default_value.and_then(|field| field.known()) {
        Some(Value::Formula(formula)) => formula_of_node(formula),
        _ => predefined_offset(variable),
    };
    let (Some(offset), Some(value)) = (offset, number.to::<u32>()) else { return };
    // A PDO or EMCY that is off disturbs nobody.
    if variable.standard_type == Some(DataType::Unsigned32) && !CobId(value).is_valid() {
        return;
    }
    let Some(node_id) = commissioned(context).map(|node_id| u32::from(node_id.get())) else { return };
    let value = value & !CobId::BIT_30;
    let Some(other @ 1..=127) = value.checked_sub(offset & !(CobId::BIT_31 | CobId::BIT_30)) else { return };
    if other == node_id {
        return;
    }
    let right = number.to::<u32>().unwrap_or_default() - other + node_id;
    let finding = report
        .add(field.span(), format!("{} is `{}`, the value of node {other}", variable.place(), field.text()));
    if let Some(own) = context.sheet.commissioning().and_then(|section| section.node_id()) {
        finding.label(own.span(), "the node-ID of this device");
    }
    finding.help(format!("write `0x{right:X}`")).unsafe_fix(
        format!("Write the value of node {node_id}"),
        vec![Edit::replace(field.span(), format!("0x{right:X}"))],
    );
}

/// What a formula adds to the node-ID, if that is no node-ID again.
fn formula_of_node(formula: Formula) -> Option<u32> {
    // `$NODEID` alone may be any small number, such as an address that the user gives.
    u32::try_from(formula.offset()).ok().filter(|offset| offset & 0x7FF >= 0x80)
}

/// What the pre-defined connection set adds to the node-ID for a COB-ID.
fn predefined_offset(variable: &Variable<'_>) -> Option<u32> {
    let offset = match (variable.index.0, variable.sub_index) {
        (0x1014, None) => 0x80,
        (index @ 0x1400..=0x1403, Some(SubIndex(1))) => 0x200 + u32::from(index - 0x1400) * 0x100,
        (index @ 0x1800..=0x1803, Some(SubIndex(1))) => 0x180 + u32::from(index - 0x1800) * 0x100,
        _ => return None,
    };
    Some(offset)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings_in, fixed_in};

    fn text(section: &str, entries: &str) -> String {
        format!("[DeviceComissioning]\nNodeID=5\n[{section}]\nDataType=7\n{entries}\n")
    }

    fn found(section: &str, entries: &str) -> String {
        findings_in(&NODE_ID_MISMATCH, "a.dcf", text(section, entries).as_bytes()).join("|")
    }

    #[test]
    fn values_of_another_node() {
        assert_eq!(
            found("2000", "DefaultValue=$NODEID+0x680\nParameterValue=0x686"),
            "6:16 warning: 2000h is `0x686`, the value of node 6"
        );
        assert_eq!(found("1014", "DefaultValue=0x86"), "5:14 warning: 1014h is `0x86`, the value of node 6");
        assert_eq!(
            found("1803sub1", "DefaultValue=0x400004FF"),
            "5:14 warning: 1803h sub-index 01h is `0x400004FF`, the value of node 127"
        );
        assert_eq!(
            fixed_in(&NODE_ID_MISMATCH, "a.dcf", text("1401sub1", "ParameterValue=0x40000301").as_bytes()),
            text("1401sub1", "ParameterValue=0x40000305").as_bytes()
        );
    }

    #[test]
    fn what_is_right_or_chosen() {
        for (section, entries) in [
            ("1800sub1", "DefaultValue=0x185"),
            ("1800sub1", "DefaultValue=0x80000186"),
            ("1400sub1", "DefaultValue=0x186"),
            ("1404sub1", "DefaultValue=0x206"),
            ("1800sub1", "DefaultValue=$NODEID+0x180\nParameterValue=0x685"),
            ("2000", "DefaultValue=$NODEID\nParameterValue=7"),
            ("1800sub1", "DefaultValue=$NODEID+0x180"),
        ] {
            assert_eq!(found(section, entries), "", "{section} {entries}");
        }
        assert!(
            findings_in(&NODE_ID_MISMATCH, "a.eds", text("1014", "DefaultValue=0x86").as_bytes()).is_empty()
        );
    }
}
