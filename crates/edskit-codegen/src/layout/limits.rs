//! Limits as bits, where they are tighter than the data type.

use edskit_model::{Entry, Value};
use edskit_types::{DataType, DataTypeKind};

/// What the limits of an entry are.
pub(super) struct Read<'a> {
    /// The lowest and the highest value as bits, where one of them is tighter than the type.
    pub(super) limits: Option<(u64, u64)>,
    /// Limits that depend on the node-ID: the table cannot hold those.
    pub(super) formulas: Vec<Entry<'a>>,
}

/// The limits of a value of this type; what cannot be read counts as no limit, which the linter reports.
pub(super) fn read<'a>(data_type: DataType, low: Option<Entry<'a>>, high: Option<Entry<'a>>) -> Read<'a> {
    let value = |entry: Option<Entry<'a>>| entry.and_then(|entry| entry.value(Some(data_type)).known());
    let is_formula = |entry: &Entry<'a>| matches!(value(Some(*entry)), Some(Value::Formula(_)));
    let formulas = [low, high].into_iter().flatten().filter(is_formula).collect();
    let limits = match data_type.kind() {
        DataTypeKind::Real => real(data_type, value(low), value(high)),
        _ => integer(data_type, value(low), value(high)),
    };
    Read { limits, formulas }
}

fn integer(data_type: DataType, low: Option<Value<'_>>, high: Option<Value<'_>>) -> Option<(u64, u64)> {
    let (lowest, highest) = data_type.range()?;
    let within = |value: Option<Value<'_>>| value.and_then(|value| value.integer(data_type, None).ok());
    let (low, high) = (within(low).unwrap_or(lowest), within(high).unwrap_or(highest));
    ((low, high) != (lowest, highest)).then_some((low as u64, high as u64))
}

fn real(data_type: DataType, low: Option<Value<'_>>, high: Option<Value<'_>>) -> Option<(u64, u64)> {
    let number =
        |value: Option<Value<'_>>| value.and_then(|value| value.real(data_type)).filter(|r| !r.is_nan());
    let low = number(low).unwrap_or(f64::NEG_INFINITY);
    let high = number(high).unwrap_or(f64::INFINITY);
    let bits = |real: f64| match data_type {
        DataType::Real32 => u64::from((real as f32).to_bits()),
        _ => real.to_bits(),
    };
    (low > f64::NEG_INFINITY || high < f64::INFINITY).then_some((bits(low), bits(high)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_model::{Datasheet, KeyName};

    fn limits(data_type: DataType, low: &str, high: &str) -> Option<(u64, u64)> {
        let text = format!("[2000]\nLowLimit={low}\nHighLimit={high}\n");
        let sheet = Datasheet::parse(text.as_bytes());
        let section = sheet.sections().next().unwrap();
        read(data_type, section.filled(KeyName::LowLimit), section.filled(KeyName::HighLimit)).limits
    }

    #[test]
    fn only_tighter_limits_count() {
        assert_eq!(limits(DataType::Unsigned8, "0", "255"), None);
        assert_eq!(limits(DataType::Unsigned8, "", ""), None);
        assert_eq!(limits(DataType::Unsigned8, "0", "0x100"), None, "beyond the type");
        assert_eq!(limits(DataType::Unsigned8, "1", ""), Some((1, 255)));
        assert_eq!(limits(DataType::Integer16, "-5", ""), Some((-5_i64 as u64, 0x7FFF)));
        assert_eq!(limits(DataType::Integer8, "0x80", "0x7F"), None);
        assert_eq!(limits(DataType::Integer64, "", "-1"), Some((i64::MIN as u64, u64::MAX)));
        assert_eq!(limits(DataType::Real32, "0", ""), Some((0, f32::INFINITY.to_bits().into())));
        assert_eq!(
            limits(DataType::Real64, "", "1.5"),
            Some((f64::NEG_INFINITY.to_bits(), 1.5_f64.to_bits()))
        );
        assert_eq!(limits(DataType::VisibleString, "1", "2"), None);
        assert_eq!(limits(DataType::Unsigned8, "$NODEID", "9"), Some((0, 9)));
    }
}
