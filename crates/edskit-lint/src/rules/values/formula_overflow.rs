use super::reading::{each_value, fits, name, node_ids};
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::{Field, Formula, Value};
use edskit_types::{DataType, NodeId};

rule! {
    /// A formula exceeds its data type for some node-ID
    ///
    /// ## What it does
    /// Reports a formula whose sum the data type cannot hold for node-ID 127, or for the node-ID of a DCF.
    ///
    /// ## Why is this bad
    /// A device with this node-ID gets a value that is cut off: another COB-ID than the file says, or none.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Address
    /// DataType=0x0005
    /// DefaultValue=$NODEID+0xF0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Address
    /// DataType=0x0006
    /// DefaultValue=$NODEID+0xF0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3; CiA 301 v4.2, 7.1.6.
    pub(crate) static FORMULA_OVERFLOW = {
        code: "VAL007",
        name: "formula-overflow",
        group: Values,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("FRM004"), Dcfchk("underflow"), Dcfchk("overflow")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(data_type) = variable.standard_type.filter(|data_type| data_type.is_integer()) else { return };
    each_value(context, variable, |_, field| {
        if let Some(value @ Value::Formula(formula)) = field.known() {
            // The sum grows with the node-ID, so the highest one decides.
            let [_, node_id] = node_ids(context);
            if !fits(value, data_type, node_id) {
                report_formula(variable, field, formula, data_type, node_id, report);
            }
        }
    });
}

#[cold]
fn report_formula(
    variable: &Variable<'_>,
    field: Field<'_, Value<'_>>,
    formula: Formula,
    data_type: DataType,
    node_id: NodeId,
    report: &mut Report,
) {
    let Some((low, high)) = data_type.range() else { return };
    let sum = match formula.evaluate(node_id) {
        Some(sum) => format!("0x{sum:X}"),
        None => "above 64 bits".to_owned(),
    };
    let message = format!(
        "{} is {sum} for node-ID {node_id}, but {data_type} holds {low} to {high}",
        name(field.entry)
    );
    let largest = high - i128::from(node_id.get());
    let help = if largest >= 0 {
        format!("the largest constant that fits is 0x{largest:X}; or write the wider data type")
    } else {
        "write the wider data type".to_owned()
    };
    let finding = report.add(field.span(), message);
    finding.help(help);
    if let Some(type_field) = variable.data_type {
        finding.label(type_field.span(), format!("the data type is {data_type}"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in};

    fn default(data_type: u16, value: &str) -> String {
        findings(&FORMULA_OVERFLOW, &format!("[2000]\nDataType={data_type}\nDefaultValue={value}\n"))
            .join("|")
    }

    #[test]
    fn the_highest_node_id_decides() {
        assert_eq!(default(5, "$NODEID+0x80"), "");
        assert_eq!(
            default(5, "$NODEID+0x81"),
            "3:14 error: `DefaultValue` is 0x100 for node-ID 127, but UNSIGNED8 holds 0 to 255"
        );
        assert_eq!(default(2, "$NODEID"), "");
        assert_eq!(default(2, "$NODEID+0x80"), "", "two's complement");
        assert_eq!(
            default(2, "$NODEID+1"),
            "3:14 error: `DefaultValue` is 0x80 for node-ID 127, but INTEGER8 holds -128 to 127"
        );
        assert_eq!(default(7, "$NODEID+0x80000300"), "");
        assert_eq!(
            default(0x1B, "$NODEID+0xFFFFFFFFFFFFFFF0"),
            "3:14 error: `DefaultValue` is above 64 bits for node-ID 127, but UNSIGNED64 holds 0 to 18446744073709551615"
        );
    }

    #[test]
    fn a_dcf_has_one_node_id() {
        let text = "[DeviceComissioning]\nNodeID=5\n[2000]\nDataType=5\nParameterValue=$NODEID+0xF0\n[2001]\nDataType=5\nHighLimit=$NODEID+0xFF\n";
        assert_eq!(
            findings_in(&FORMULA_OVERFLOW, "a.dcf", text.as_bytes()),
            ["8:11 error: `HighLimit` is 0x104 for node-ID 5, but UNSIGNED8 holds 0 to 255"]
        );
    }
}
