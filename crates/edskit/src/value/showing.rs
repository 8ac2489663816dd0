//! Bytes, as people and programs read them.

use super::calendar::time_of_day;
use super::size;
use crate::printable;
use edskit_host::sdo::SdoValue;
use edskit_runtime::Value as _;
use edskit_types::{DataType, DataTypeKind};
use serde_json::{Value as Json, json};

/// A value of a type for people. Bytes that cannot be one are shown with the reason.
pub(crate) fn text(data_type: DataType, bytes: &[u8]) -> String {
    if size(data_type).is_some_and(|size| size != bytes.len()) {
        let size = size(data_type).unwrap_or_default();
        return format!("{} ({} bytes, but {} has {size})", hex(bytes), bytes.len(), data_type.name());
    }
    match data_type.kind() {
        DataTypeKind::Boolean => match bytes {
            [0] => "0 (false)".to_owned(),
            [1] => "1 (true)".to_owned(),
            _ => format!("{} (neither 0 nor 1)", hex(bytes)),
        },
        DataTypeKind::Unsigned => {
            let value = u64::from_bytes(bytes);
            format!("{value} ({})", in_hex(value, bytes.len()))
        }
        DataTypeKind::Signed => match i64::from_bytes(bytes) {
            value if value < 0 => format!("{value} (-{})", in_hex(value.unsigned_abs(), bytes.len())),
            value => format!("{value} ({})", in_hex(value.unsigned_abs(), bytes.len())),
        },
        DataTypeKind::Real => real(bytes),
        DataTypeKind::VisibleString => {
            // Some devices fill what is left of a text with zeros.
            let end = bytes.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
            format!("\"{}\"", printable::line(&String::from_utf8_lossy(&bytes[..end])))
        }
        DataTypeKind::UnicodeString => format!("\"{}\"", printable::line(&utf16(bytes))),
        DataTypeKind::TimeOfDay => {
            let (days, milliseconds) = time(bytes);
            time_of_day(days, milliseconds)
        }
        DataTypeKind::TimeDifference => {
            let (days, milliseconds) = time(bytes);
            let plural = if days == 1 { "" } else { "s" };
            format!("{days} day{plural} and {milliseconds} ms")
        }
        DataTypeKind::OctetString | DataTypeKind::Domain | DataTypeKind::Record => hex(bytes),
    }
}

/// A value of a type for programs: a number, a text, or bytes as hexadecimal digits. Numbers beyond 53 bits are exact.
pub(crate) fn json(data_type: DataType, bytes: &[u8]) -> Json {
    if size(data_type).is_some_and(|size| size != bytes.len()) {
        return json!(digits(bytes));
    }
    match data_type.kind() {
        DataTypeKind::Boolean => match bytes {
            [0] => json!(false),
            [1] => json!(true),
            _ => json!(digits(bytes)),
        },
        DataTypeKind::Unsigned => json!(u64::from_bytes(bytes)),
        DataTypeKind::Signed => json!(i64::from_bytes(bytes)),
        DataTypeKind::Real => {
            let text = real(bytes);
            // By its notation, so that 0.1 does not become 0.10000000149; JSON has neither infinities nor NaN.
            match text.parse::<f64>() {
                Ok(value) if value.is_finite() => json!(value),
                _ => json!(text),
            }
        }
        DataTypeKind::VisibleString => json!(String::from_utf8_lossy(bytes).trim_end_matches('\0')),
        DataTypeKind::UnicodeString => json!(utf16(bytes)),
        DataTypeKind::TimeOfDay | DataTypeKind::TimeDifference => json!(text(data_type, bytes)),
        DataTypeKind::OctetString | DataTypeKind::Domain | DataTypeKind::Record => json!(digits(bytes)),
    }
}

/// What a server says its entry holds, for people. Where neither it nor the type says how many of the bytes count, all are
/// shown, and that it is not said.
pub(crate) fn said(data_type: Option<DataType>, value: &SdoValue) -> String {
    let bytes = counted(data_type, value);
    let shown = data_type.map_or_else(|| untyped(bytes), |data_type| text(data_type, bytes));
    if is_settled(data_type, value) { shown } else { shown + NOT_SAID }
}

/// What stands behind bytes of which nobody says how many count.
pub(crate) const NOT_SAID: &str = " (the length is not said)";

/// The bytes that count, as far as that is known.
pub(crate) fn counted(data_type: Option<DataType>, value: &SdoValue) -> &[u8] {
    data_type.map_or(&value.bytes, |data_type| value.of_type(data_type))
}

/// Whether it is known how many bytes count.
pub(crate) fn is_settled(data_type: Option<DataType>, value: &SdoValue) -> bool {
    data_type.map_or(value.is_length_said(), |data_type| value.is_settled_by(data_type))
}

/// Bytes of which nothing is known: as they are, and as the unsigned number that they could be.
pub(crate) fn untyped(bytes: &[u8]) -> String {
    match bytes.len() {
        0 => "(no bytes)".to_owned(),
        1 | 2 | 4 | 8 => format!("{} ({})", hex(bytes), u64::from_bytes(bytes)),
        _ => hex(bytes),
    }
}

/// `0A 0B`
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}

/// `0A0B`
pub(crate) fn digits(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect()
}

/// `03E8h`
fn in_hex(value: u64, length: usize) -> String {
    format!("{value:0width$X}h", width = 2 * length)
}

/// The shortest notation of four or eight bytes that reads as the same number again.
fn real(bytes: &[u8]) -> String {
    match bytes.len() {
        4 => f32::from_bytes(bytes).to_string(),
        _ => f64::from_bytes(bytes).to_string(),
    }
}

fn utf16(bytes: &[u8]) -> String {
    let units: Vec<u16> = bytes.chunks(2).map(u16::from_bytes).collect();
    String::from_utf16_lossy(&units).trim_end_matches('\0').to_owned()
}

/// Days and milliseconds.
fn time(bytes: &[u8]) -> (u16, u32) {
    let raw = u64::from_bytes(bytes);
    ((raw >> 32) as u16, raw as u32 & 0x0FFF_FFFF)
}
