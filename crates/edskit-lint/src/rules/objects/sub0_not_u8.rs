use crate::rule::rule;
use crate::{Context, Edit, Report, Variable};
use edskit_model::{Field, Value};
use edskit_types::{DataType, Index, SubIndex};

rule! {
    /// Sub-index 00h is not UNSIGNED8
    ///
    /// ## What it does
    /// Reports a sub-index 00h, which holds the highest sub-index of an ARRAY or RECORD, with another data type than
    /// UNSIGNED8 (0005h). That of 1004h, which old editions define with 32 bits, is left to COM019.
    ///
    /// ## Why is this bad
    /// The structure of an ARRAY and a RECORD fixes the type. A master that reads sub-index 00h expects one byte.
    ///
    /// ## Example
    /// ```eds
    /// [1018sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0007
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1018sub0]
    /// ParameterName=Highest sub-index
    /// DataType=0x0005
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.4.5.2; CiA 306 v1.3, 4.6.3.2.
    pub(crate) static SUB0_NOT_U8 = {
        code: "OBJ013",
        name: "sub0-not-u8",
        group: Objects,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [Dcfchk("DataType should be UNSIGNED8")],
        check: Variable(check),
    }
}

fn check(_: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    // Sub-index 00h of 1004h, which old editions have, holds two numbers of PDOs in 32 bits; see COM019.
    if variable.sub_index != Some(SubIndex(0)) || variable.index == Index(0x1004) {
        return;
    }
    let Some(field) = variable.data_type else { return };
    if field.known().is_none_or(|data_type| data_type == DataType::Unsigned8.index().0) {
        return;
    }
    let name =
        variable.standard_type.map_or_else(|| field.text().into_owned(), |known| known.name().to_owned());
    let finding = report
        .add(field.span(), format!("sub-index 00h of {} is {name} instead of UNSIGNED8", variable.index));
    finding.help("write `DataType=0x0005`");
    let values = [variable.default_value, variable.parameter_value].into_iter().flatten();
    // A value that is no count shows that more is wrong than the type.
    let is_count = |value: Value<'_>| matches!(value, Value::Integer(number) if number.to::<u8>().is_some());
    if values.filter_map(Field::known).all(is_count) {
        finding.unsafe_fix("Make it UNSIGNED8", vec![Edit::replace(field.span(), "0x0005")]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn other_types_are_named() {
        let text = "[2000sub0]\nDataType=0x0002\n[2001sub0]\nDataType=0x40\n[2002sub0]\nDataType=x\n";
        assert_eq!(
            findings(&SUB0_NOT_U8, text),
            [
                "2:10 error: sub-index 00h of 2000h is INTEGER8 instead of UNSIGNED8",
                "4:10 error: sub-index 00h of 2001h is 0x40 instead of UNSIGNED8"
            ]
        );
        assert!(findings(&SUB0_NOT_U8, "[1004sub0]\nDataType=7\n").is_empty());
        assert_eq!(fixed(&SUB0_NOT_U8, "[2000sub0]\nDataType=2\n"), "[2000sub0]\nDataType=0x0005\n");
    }

    #[test]
    fn a_value_that_is_no_count_is_not_made_one() {
        let text = "[2000sub0]\nDataType=7\nDefaultValue=0x96A\n";
        assert_eq!(fixed(&SUB0_NOT_U8, text), text);
    }
}
