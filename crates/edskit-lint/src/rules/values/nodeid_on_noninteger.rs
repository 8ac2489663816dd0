use super::reading::{each_value, is_formula, name};
use crate::rule::rule;
use crate::{Context, Report, Variable};
use edskit_model::meant::value_length;
use edskit_model::{Formula, Value};
use edskit_types::{DataType, DataTypeKind};

rule! {
    /// A formula stands on a type that is no integer
    ///
    /// ## What it does
    /// Reports a value with `$NODEID` whose data type is no integer: a BOOLEAN, a REAL, a string, a DOMAIN, a time. Of
    /// a text only a formula from the first to the last character is reported.
    ///
    /// ## Why is this bad
    /// Formulas are defined for integers alone. Tools refuse the value or take it as a text.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Gain
    /// DataType=0x0008
    /// DefaultValue=$NODEID+1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Gain
    /// DataType=0x0007
    /// DefaultValue=$NODEID+1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3.
    pub(crate) static NODEID_ON_NONINTEGER = {
        code: "VAL006",
        name: "nodeid-on-noninteger",
        group: Values,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("FRM003")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    // A record type on a single value is the matter of VAL001.
    let is_other = |data_type: &DataType| !data_type.is_integer() && data_type.kind() != DataTypeKind::Record;
    let Some(data_type) = variable.standard_type.filter(is_other) else { return };
    each_value(context, variable, |_, field| {
        let raw = field.entry.raw();
        if !is_formula(raw) {
            return;
        }
        // A text may speak of the node-ID; of what cannot be one, an inline comment is the first defect.
        let is_other = match field.value {
            Ok(Value::Text(_)) => Formula::parse(raw).is_err(),
            _ => value_length(raw).is_some(),
        };
        if is_other {
            return;
        }
        let message =
            format!("{} is the formula `{}`, but {data_type} is no integer", name(field.entry), field.text());
        let finding = report.add(field.span(), message);
        finding.help(
            "write a plain value, or make the data type an integer such as `DataType=0x0007` (UNSIGNED32)",
        );
        if let Some(type_field) = variable.data_type {
            finding.label(type_field.span(), format!("the data type is {data_type}"));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn default(data_type: u16, value: &str) -> String {
        findings(&NODEID_ON_NONINTEGER, &format!("[2000]\nDataType={data_type}\nDefaultValue={value}\n"))
            .join("|")
    }

    #[test]
    fn every_type_but_integers() {
        for (data_type, name) in [
            (1, "BOOLEAN"),
            (8, "REAL32"),
            (9, "VISIBLE_STRING"),
            (0xA, "OCTET_STRING"),
            (0xC, "TIME_OF_DAY"),
            (0xF, "DOMAIN"),
        ] {
            assert_eq!(
                default(data_type, "$NODEID"),
                format!("3:14 error: `DefaultValue` is the formula `$NODEID`, but {name} is no integer")
            );
        }
        assert_eq!(default(7, "$NODEID"), "");
        assert_eq!(default(0x21, "$NODEID"), "", "VAL001");
    }

    #[test]
    fn other_texts_are_no_formulas() {
        for (data_type, value) in [(9, "Axis $NODEID"), (9, "5 $"), (8, "$NODEID ; x"), (0xA, "$1A")] {
            assert_eq!(default(data_type, value), "");
        }
    }
}
