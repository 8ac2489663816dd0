//! What people write, as bytes.

use super::calendar::parse_time_of_day;
use super::size;
use edskit_model::{EvaluationError, Value, octets};
use edskit_types::{DataType, DataTypeKind, NodeId};

/// The bytes of a value that is written as an EDS has it, low byte first. Besides, octets may have blanks between them or
/// `0x` before them, BOOLEAN may be `true` or `false`, and a time may be a date. `$NODEID` is that of `node_id`.
pub(crate) fn bytes_of(data_type: DataType, text: &str, node_id: NodeId) -> Result<Vec<u8>, String> {
    let wrong = |reason: &dyn std::fmt::Display| format!("`{text}` is no {}: {reason}", data_type.name());
    let text = match data_type.kind() {
        DataTypeKind::VisibleString | DataTypeKind::UnicodeString => text,
        DataTypeKind::OctetString | DataTypeKind::Domain => return octets_of(text),
        DataTypeKind::TimeOfDay if text.contains('-') => {
            let (days, milliseconds) = parse_time_of_day(text).ok_or_else(|| {
                wrong(&"expected a date from 1984-01-01 to 2163-06-06 as in 2026-11-22 07:30:00.000")
            })?;
            return Ok(time(days, milliseconds));
        }
        DataTypeKind::Boolean if text.eq_ignore_ascii_case("true") => "1",
        DataTypeKind::Boolean if text.eq_ignore_ascii_case("false") => "0",
        _ => text.trim(),
    };
    let value = Value::parse(data_type, text.as_bytes()).map_err(|error| wrong(&error))?;
    let cut = |bytes: [u8; 16]| bytes[..size(data_type).unwrap_or_default().min(16)].to_vec();
    Ok(match value {
        Value::Boolean(_) | Value::Integer(_) | Value::Formula(_) => {
            let integer = value.integer(data_type, Some(node_id));
            let integer = integer.map_err(|error| match (error, data_type.range()) {
                (EvaluationError::OutOfRange(value), Some((low, high))) => {
                    wrong(&format!("{value} is not in {low}..{high}"))
                }
                _ => wrong(&error),
            })?;
            cut(integer.to_le_bytes())
        }
        Value::Real(_) | Value::RealBits(_) => {
            let real = value.real(data_type).unwrap_or_default();
            match data_type {
                DataType::Real32 => (real as f32).to_le_bytes().to_vec(),
                _ => real.to_le_bytes().to_vec(),
            }
        }
        Value::Text(_) if data_type == DataType::UnicodeString => {
            text.encode_utf16().flat_map(u16::to_le_bytes).collect()
        }
        Value::Text(bytes) => bytes.to_vec(),
        Value::Octets(digits) | Value::Bits(digits) => octets(digits).collect(),
        Value::Time { days, milliseconds } => time(days, milliseconds),
    })
}

/// Bytes in hexadecimal digits, with or without blanks.
fn octets_of(text: &str) -> Result<Vec<u8>, String> {
    let digits: String = text.chars().filter(|character| !character.is_whitespace()).collect();
    let digits = digits.strip_prefix("0x").or(digits.strip_prefix("0X")).unwrap_or(&digits);
    match Value::parse(DataType::OctetString, digits.as_bytes()) {
        Ok(_) => Ok(octets(digits.as_bytes()).collect()),
        Err(error) => Err(format!("`{text}` is no row of bytes: {error}")),
    }
}

fn time(days: u16, milliseconds: u32) -> Vec<u8> {
    [&milliseconds.to_le_bytes()[..], &days.to_le_bytes()].concat()
}
