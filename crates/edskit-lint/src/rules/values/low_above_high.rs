use super::reading::{Readings, Scalar, fits, node_ids, shown};
use crate::rule::rule;
use crate::{Context, Report, Severity, Variable};
use edskit_model::{Field, Value};
use edskit_types::{DataType, NodeId};

rule! {
    /// The lower limit is above the upper one
    ///
    /// ## What it does
    /// Reports a `LowLimit` that is greater than the `HighLimit`. Hexadecimal limits of signed types are read as
    /// written and as two's complement; only where both readings contradict themselves is there a finding.
    ///
    /// ## Why is this bad
    /// No value lies between the limits, so a tool that checks them refuses every value.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// DataType=0x0005
    /// LowLimit=5
    /// HighLimit=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// DataType=0x0005
    /// LowLimit=1
    /// HighLimit=5
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.3.2.
    pub(crate) static LOW_ABOVE_HIGH = {
        code: "VAL003",
        name: "low-above-high",
        group: Values,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("VAL002")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let (Some(low), Some(high), Some(data_type)) =
        (variable.low_limit, variable.high_limit, variable.standard_type)
    else {
        return;
    };
    let (Some(low_value), Some(high_value)) = (low.known(), high.known()) else { return };
    let node_ids = node_ids(context);
    if contradict(low_value, high_value, data_type, node_ids) {
        report_limits(low, high, data_type, node_ids, report);
    } else if have_no_reading(low_value, high_value, data_type, node_ids) {
        report_unreadable(low, high, data_type, report);
    }
}

/// Whether limits of a signed type are wrong however they are read, although each of them can be read: as the numbers
/// that are written one leaves the type, and as bits the lower one is above the upper one.
pub(super) fn have_no_reading(
    low: Value<'_>,
    high: Value<'_>,
    data_type: DataType,
    node_ids: [NodeId; 2],
) -> bool {
    let Some((least, most)) = data_type.range().filter(|_| data_type.is_signed()) else { return false };
    let is_in_type = |value: Scalar| Scalar::Integer(least) <= value && value <= Scalar::Integer(most);
    node_ids.into_iter().all(|node_id| {
        let readings = |value| Readings::of(value, data_type, node_id);
        let (Some(lows), Some(highs)) = (readings(low), readings(high)) else { return false };
        fits(low, data_type, node_id)
            && fits(high, data_type, node_id)
            && lows
                .all()
                .into_iter()
                .zip(highs.all())
                .all(|(low, high)| low > high || !is_in_type(low) || !is_in_type(high))
    })
}

/// Whether the lower limit is above the upper one whatever they mean, and both fit the data type (VAL002 looks at
/// those that do not).
pub(super) fn contradict(
    low: Value<'_>,
    high: Value<'_>,
    data_type: DataType,
    node_ids: [NodeId; 2],
) -> bool {
    node_ids.into_iter().all(|node_id| {
        let readings = |value| Readings::of(value, data_type, node_id);
        let (Some(lows), Some(highs)) = (readings(low), readings(high)) else { return false };
        lows.all().iter().zip(&highs.all()).all(|(low, high)| low > high)
            && fits(low, data_type, node_id)
            && fits(high, data_type, node_id)
    })
}

#[cold]
fn report_unreadable(
    low: Field<'_, Value<'_>>,
    high: Field<'_, Value<'_>>,
    data_type: DataType,
    report: &mut Report,
) {
    let message = format!(
        "`LowLimit` `{}` and `HighLimit` `{}` are no range of {data_type}, however they are read",
        low.text(),
        high.text()
    );
    let unsigned = DataType::ALL
        .iter()
        .find(|other| other.is_integer() && !other.is_signed() && other.bits() == data_type.bits());
    let help = match unsigned {
        Some(unsigned) => format!(
            "write numbers that {data_type} holds, or its type `DataType=0x{:04X}` ({unsigned}) if that is meant",
            unsigned.index()
        ),
        None => format!("write numbers that {data_type} holds"),
    };
    report
        .add(high.span(), message)
        .severity(Severity::Warning)
        .here("beyond the type as a number, negative as bits")
        .label(low.span(), "the lower limit")
        .help(help);
}

#[cold]
fn report_limits(
    low: Field<'_, Value<'_>>,
    high: Field<'_, Value<'_>>,
    data_type: DataType,
    [node_id, _]: [NodeId; 2],
    report: &mut Report,
) {
    let show = |field: Field<'_, Value<'_>>| {
        let readings = field.known().and_then(|value| Readings::of(value, data_type, node_id));
        readings.map_or_else(String::new, |readings| shown(field.entry, readings.as_bits))
    };
    let help = match negative(low, data_type) {
        Some(value) => format!("write `{value}` if a negative number is meant"),
        None => "exchange the two, or correct the one that is wrong".to_owned(),
    };
    report
        .add(low.span(), format!("`LowLimit` {} is above `HighLimit` {}", show(low), show(high)))
        .here("the lower limit")
        .label(high.span(), "the upper limit")
        .help(help);
}

/// What a lower limit says whose digits are the bits of a negative number, but too few for its signed type.
fn negative(low: Field<'_, Value<'_>>, data_type: DataType) -> Option<i128> {
    let Some(Value::Integer(number)) = low.known() else { return None };
    let bits = u16::from(number.digits()) * 4;
    data_type.bits().filter(|&of_type| data_type.is_signed() && bits < of_type)?;
    number.twos_complement(bits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in, lint};
    use edskit_model::Datasheet;

    fn limits(data_type: u16, low: &str, high: &str) -> String {
        let text = format!("[2000]\nDataType={data_type}\nLowLimit={low}\nHighLimit={high}\n");
        findings(&LOW_ABOVE_HIGH, &text).join("|")
    }

    #[test]
    fn readings_of_one_kind_are_compared() {
        assert_eq!(
            limits(3, "0x7FFF", "0x10"),
            "3:10 error: `LowLimit` `0x7FFF` (32767) is above `HighLimit` `0x10` (16)"
        );
        assert_eq!(limits(3, "0x8000", "0x7FFF"), "");
        assert_eq!(
            limits(3, "0xFFFF", "0xFFFE"),
            "3:10 error: `LowLimit` `0xFFFF` (-1) is above `HighLimit` `0xFFFE` (-2)"
        );
        assert_eq!(limits(3, "-5", "5"), "");
        assert_eq!(limits(0x10, "0xFFFFFF", "0"), "");
    }

    #[test]
    fn limits_that_fit_no_reading_are_wrong() {
        for (data_type, bits, name) in [
            (2, 8, "INTEGER8"),
            (3, 16, "INTEGER16"),
            (0x10, 24, "INTEGER24"),
            (4, 32, "INTEGER32"),
            (0x15, 64, "INTEGER64"),
        ] {
            let all = format!("0x{}", "F".repeat(bits / 4));
            assert_eq!(
                limits(data_type, "0x00", &all),
                format!(
                    "4:11 warning: `LowLimit` `0x00` and `HighLimit` `{all}` are no range of {name}, however they are read"
                )
            );
            let (half, less) =
                (format!("0x8{}", "0".repeat(bits / 4 - 1)), format!("0x7{}", "F".repeat(bits / 4 - 1)));
            assert_eq!(limits(data_type, &half, &less), "");
            assert_eq!(limits(data_type, &half, &all), "", "both are negative");
        }
        assert_eq!(limits(5, "0x00", "0xFF"), "");
    }

    #[test]
    fn too_few_digits_for_a_negative_number_are_explained() {
        let sheet = Datasheet::parse(b"[2000]\nDataType=4\nLowLimit=0x8001\nHighLimit=0x7FFF\n");
        let finding = lint(&LOW_ABOVE_HIGH, "a.eds", &sheet).remove(0);
        assert_eq!(finding.help.as_deref(), Some("write `-32767` if a negative number is meant"));
    }

    #[test]
    fn reals_may_be_bits_or_numbers() {
        assert_eq!(limits(8, "1.5", "0.5"), "3:10 error: `LowLimit` `1.5` is above `HighLimit` `0.5`");
        assert_eq!(limits(8, "0", "0x64"), "");
        assert_eq!(limits(8, "10", "0x64"), "");
        assert_eq!(
            limits(8, "0x461C4000", "0x3F800000"),
            "3:10 error: `LowLimit` `0x461C4000` (10000) is above `HighLimit` `0x3F800000` (1)"
        );
        assert_eq!(limits(8, "0", "0xFFFFFFFF"), "");
    }

    #[test]
    fn formulas_are_tried_at_both_ends() {
        assert_eq!(limits(7, "$NODEID", "0x10"), "");
        assert_eq!(
            limits(7, "$NODEID+0x10", "0x10"),
            "3:10 error: `LowLimit` `$NODEID+0x10` is above `HighLimit` `0x10` (16)"
        );
        let dcf = "[DeviceComissioning]\nNodeID=100\n[2000]\nDataType=7\nLowLimit=$NODEID\nHighLimit=0x10\n";
        assert_eq!(findings_in(&LOW_ABOVE_HIGH, "a.dcf", dcf.as_bytes()).len(), 1);
        assert_eq!(findings_in(&LOW_ABOVE_HIGH, "a.eds", dcf.as_bytes()).len(), 0);
    }

    #[test]
    fn what_other_rules_report_is_left_to_them() {
        assert_eq!(limits(5, "300", "1"), "");
        assert_eq!(limits(5, "x", "1"), "");
        assert_eq!(limits(5, "7", ""), "");
        assert_eq!(limits(9, "7", "5"), "");
        assert_eq!(limits(0x40, "3", "1"), "");
    }
}
