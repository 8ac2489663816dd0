use super::low_above_high::have_no_reading;
use super::reading::{Readings, Scalar, each_value, name, node_ids};
use crate::rule::rule;
use crate::{Context, Edit, Report, Variable};
use edskit_model::{Entry, Field, KeyName, Value};
use edskit_types::{DataType, NodeId};

rule! {
    /// A hexadecimal value means different numbers to different readers
    ///
    /// ## What it does
    /// Reports hexadecimal values of signed types whose top bit is set, and hexadecimal values of REAL types. One
    /// finding stands for all such values of an object.
    ///
    /// ## Why is this bad
    /// The specification does not say whether such a literal is the bits of the value or a number. Readers differ, and
    /// some read limits one way and defaults the other: `0xFE` of an INTEGER8 is -2 or 254.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Offset
    /// DataType=0x0002
    /// DefaultValue=0xFE
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Offset
    /// DataType=0x0002
    /// DefaultValue=-2
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3. Engineering judgement: the section defines hexadecimal numbers, but no negative ones and no
    /// real ones.
    pub(crate) static HEX_AMBIGUOUS = {
        code: "VAL010",
        name: "hex-ambiguous",
        group: Values,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("VAL007")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let ambiguous =
        |data_type: &DataType| data_type.is_numeric() && (data_type.is_signed() || !data_type.is_integer());
    let Some(data_type) = variable.standard_type.filter(ambiguous) else { return };
    let mut fields = Vec::new();
    each_value(context, variable, |_, field| {
        if let Some(value @ (Value::Integer(_) | Value::RealBits(_))) = field.known()
            && let Some(readings) = Readings::of(value, data_type, NodeId::MIN)
            && readings.is_ambiguous()
            && !(is_limit(field.entry) && limits_are_wrong(context, variable, data_type))
        {
            fields.push((field, readings));
        }
    });
    if !fields.is_empty() {
        fields.sort_by_key(|(field, _)| field.entry.id());
        report_values(&fields, data_type, report);
    }
}

fn is_limit(entry: Entry<'_>) -> bool {
    matches!(entry.key().name, KeyName::LowLimit | KeyName::HighLimit)
}

/// Limits that are wrong under both readings are the matter of VAL003.
#[cold]
fn limits_are_wrong(context: &Context<'_>, variable: &Variable<'_>, data_type: DataType) -> bool {
    let low = variable.low_limit.and_then(Field::known);
    let limits = low.zip(variable.high_limit.and_then(Field::known));
    limits.is_some_and(|(low, high)| have_no_reading(low, high, data_type, node_ids(context)))
}

#[cold]
fn report_values(fields: &[(Field<'_, Value<'_>>, Readings)], data_type: DataType, report: &mut Report) {
    let (first, readings) = fields[0];
    let message = format!(
        "{} of {data_type} is `{}`, which readers take as {} or {}",
        name(first.entry),
        first.text(),
        readings.as_bits,
        as_number(first)
    );
    let finding = report.add(first.span(), message);
    for &(field, readings) in &fields[1..] {
        finding.label(field.span(), format!("{} or {}", readings.as_bits, as_number(field)));
    }
    finding.help(format!("write `{}` if the bits are meant", readings.as_bits));
    let is_number = |readings: &Readings| match readings.as_bits {
        Scalar::Integer(_) => true,
        Scalar::Real(value) => value.is_finite(),
    };
    // An upper limit below 0 is hardly ever meant where the lower one is not written in the same way.
    let has = |key| fields.iter().any(|(field, _)| field.entry.key().name == key);
    let is_likely = !data_type.is_integer() || !has(KeyName::HighLimit) || has(KeyName::LowLimit);
    if is_likely && fields.iter().all(|(_, readings)| is_number(readings)) {
        let edit = |(field, readings): &(Field<'_, Value<'_>>, Readings)| {
            Edit::replace(field.span(), readings.as_bits.to_string())
        };
        finding.unsafe_fix("Write what the bits mean", fields.iter().map(edit).collect());
    }
}

/// The literal as a number, in all its digits.
fn as_number(field: Field<'_, Value<'_>>) -> String {
    match field.known() {
        Some(Value::Integer(number)) => number.value().to_string(),
        Some(Value::RealBits(bits)) => bits.to_string(),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn an_upper_limit_alone_is_not_made_negative() {
        let text = "[2000]\nDataType=3\nLowLimit=-5\nHighLimit=0xFFFF\n";
        assert_eq!(findings(&HEX_AMBIGUOUS, text).len(), 1);
        assert_eq!(fixed(&HEX_AMBIGUOUS, text), text);
        let text = "[2000]\nDataType=3\nLowLimit=0\nHighLimit=0xFFFF\n";
        assert_eq!(findings(&HEX_AMBIGUOUS, text), [""; 0], "VAL003");
        assert_eq!(fixed(&HEX_AMBIGUOUS, text), text);
    }

    #[test]
    fn signed_and_real() {
        let text = "[2000]\nDataType=3\nHighLimit=0x7FFF\nLowLimit=0x8000\nDefaultValue=0xFFFF\n[2001]\nDataType=8\nDefaultValue=0x3DCCCCCD\nLowLimit=0x0\n[2002]\nDataType=7\nDefaultValue=0xFFFFFFFF\n";
        assert_eq!(
            findings(&HEX_AMBIGUOUS, text),
            [
                "4:10 info: `LowLimit` of INTEGER16 is `0x8000`, which readers take as -32768 or 32768",
                "8:14 info: `DefaultValue` of REAL32 is `0x3DCCCCCD`, which readers take as 0.1 or 1036831949"
            ]
        );
        assert_eq!(
            fixed(&HEX_AMBIGUOUS, text),
            "[2000]\nDataType=3\nHighLimit=0x7FFF\nLowLimit=-32768\nDefaultValue=-1\n[2001]\nDataType=8\nDefaultValue=0.1\nLowLimit=0x0\n[2002]\nDataType=7\nDefaultValue=0xFFFFFFFF\n"
        );
    }

    #[test]
    fn what_is_no_number_has_no_fix() {
        let text = "[2000]\nDataType=8\nDefaultValue=0xFFFFFFFF\n";
        assert_eq!(fixed(&HEX_AMBIGUOUS, text), text);
    }
}
