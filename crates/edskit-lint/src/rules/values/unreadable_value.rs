use super::reading::{each_value, is_owned_elsewhere, name};
use crate::rule::rule;
use crate::{Context, Edit, Report, Variable};
use edskit_model::meant::{Slip, Wanted};
use edskit_model::{Field, Value};
use edskit_types::{DataType, DataTypeKind};

rule! {
    /// A real number or a time cannot be read
    ///
    /// ## What it does
    /// Reports a value or a limit of a REAL32, REAL64, TIME_OF_DAY or TIME_DIFFERENCE that is no such value.
    ///
    /// ## Why is this bad
    /// Readers stop at the value, or leave the object without one. A comma in the place of the decimal point comes
    /// from a tool that ran with the settings of a country that writes it so.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Gain
    /// DataType=0x0008
    /// DefaultValue=1,5
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Gain
    /// DataType=0x0008
    /// DefaultValue=1.5
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3; CiA 301 v4.2, 7.1.6. Engineering judgement: the specification gives no form for these types;
    /// what no reader in use takes is reported.
    pub(crate) static UNREADABLE_VALUE = {
        code: "VAL013",
        name: "unreadable-value",
        group: Values,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            EdsDcfCheck("VAL001"), Dcfchk("invalid DefaultValue, ParameterValue, LowLimit or HighLimit"),
        ],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let may_fail =
        |kind| matches!(kind, DataTypeKind::Real | DataTypeKind::TimeOfDay | DataTypeKind::TimeDifference);
    let Some(data_type) = variable.standard_type.filter(|data_type| may_fail(data_type.kind())) else {
        return;
    };
    each_value(context, variable, |_, field| {
        if field.value.is_err() && !is_owned_elsewhere(field.entry.raw()) {
            report_value(field, data_type, report);
        }
    });
}

#[cold]
fn report_value(field: Field<'_, Value<'_>>, data_type: DataType, report: &mut Report) {
    let raw = field.entry.raw();
    let message = format!("{} is `{}`, which is no {data_type}", name(field.entry), field.text());
    let finding = report.add(field.span(), message);
    if data_type.kind() != DataTypeKind::Real {
        finding.help(
            "write the days and the milliseconds, such as `365 43200000`, or the 48 bits as one number",
        );
    } else if matches!(raw, [b'0', b'x' | b'X', ..]) {
        let digits = data_type.bits().unwrap_or(64) / 4;
        finding.help(format!(
            "write a decimal number, or the bits of the value as at most {digits} hexadecimal digits"
        ));
    } else if let Some(Slip { text, .. }) = field.entry.slip(Wanted::Value(Some(data_type))) {
        finding.help(format!("write `{text}`"));
        finding.unsafe_fix(format!("Write {text}"), vec![Edit::replace(field.span(), text)]);
    } else {
        finding.help("write a decimal number such as `0.5` or `5e-1`");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn default(data_type: u16, value: &str) -> String {
        findings(&UNREADABLE_VALUE, &format!("[2000]\nDataType={data_type}\nDefaultValue={value}\n"))
            .join("|")
    }

    #[test]
    fn what_is_no_number() {
        assert_eq!(default(8, "1,5"), "3:14 error: `DefaultValue` is `1,5`, which is no REAL32");
        assert_eq!(
            default(8, "0x3FF0000000000000"),
            "3:14 error: `DefaultValue` is `0x3FF0000000000000`, which is no REAL32"
        );
        assert_eq!(default(0xC, "12:00"), "3:14 error: `DefaultValue` is `12:00`, which is no TIME_OF_DAY");
        for (data_type, value) in
            [(8, "-1.5e-3"), (0x11, "0x3FF0000000000000"), (0xD, "0"), (8, "$NODEID"), (8, "1 ; x"), (4, "x")]
        {
            assert_eq!(default(data_type, value), "");
        }
    }

    #[test]
    fn a_comma_becomes_a_point_and_a_suffix_falls() {
        assert_eq!(
            fixed(
                &UNREADABLE_VALUE,
                "[2000]\nDataType=8\nDefaultValue=1,5\nLowLimit=1.000,5\nHighLimit=2.0f\n"
            ),
            "[2000]\nDataType=8\nDefaultValue=1.5\nLowLimit=1.000,5\nHighLimit=2.0\n"
        );
    }
}
