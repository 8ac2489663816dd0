//! The canonical spelling of values.

use crate::key::{KeyName, Shape};
use crate::section::SectionKind;
use crate::value::{Number, Value};
use edskit_types::{AccessType, DataType, DataTypeKind};
use std::borrow::Cow;

/// How many digits a hexadecimal number has.
#[derive(Clone, Copy)]
enum Width {
    /// As many as the value needs, but at least this many.
    AtLeast(usize),
    /// The same, and none of those written is taken away if there are more: to some readers the digits of a signed
    /// number say how wide it is.
    Keep(usize),
}

/// A value as it should be written. Its bytes change only where that cannot change what it says: hexadecimal numbers
/// get the usual case and width, formulas their order, access types lower case.
pub(super) fn canonical<'a>(
    section: SectionKind,
    name: KeyName,
    data_type: Option<DataType>,
    raw: &'a [u8],
) -> Cow<'a, [u8]> {
    match section.shape_of(name) {
        Shape::Access => match AccessType::parse(raw) {
            Some(access) => Cow::Owned(access.as_str().into()),
            None => Cow::Borrowed(raw),
        },
        Shape::Unsigned(_) | Shape::Flag | Shape::ObjectCode => {
            number(raw, Width::AtLeast(digits(section, name)))
        }
        Shape::Value => data_type.map_or(Cow::Borrowed(raw), |data_type| typed(raw, data_type)),
        Shape::Text(_) | Shape::Edition | Shape::Time | Shape::Date | Shape::Special => Cow::Borrowed(raw),
    }
}

/// The digits of hexadecimal values of keys that are not of an object's data type: as most files have them.
fn digits(kind: SectionKind, name: KeyName) -> usize {
    match name {
        KeyName::VendorNumber
        | KeyName::ProductNumber
        | KeyName::RevisionNumber
        | KeyName::LssSerialNumber => 8,
        KeyName::DataType | KeyName::Type => 4,
        KeyName::Item if kind.lists_indices() => 4,
        KeyName::NodeId
        | KeyName::Nodes
        | KeyName::NodePresent
        | KeyName::CompactPdo
        | KeyName::Granularity => 2,
        _ => 1,
    }
}

/// A value of a data type.
fn typed(raw: &[u8], data_type: DataType) -> Cow<'_, [u8]> {
    let Some(bits) = data_type.bits() else { return Cow::Borrowed(raw) };
    let digits = usize::from(bits.div_ceil(4));
    match (data_type.kind(), Value::parse(data_type, raw)) {
        (_, Ok(Value::Formula(_))) => Cow::Owned(formula(raw)),
        (DataTypeKind::Signed, Ok(Value::Integer(_))) => number(raw, Width::Keep(digits)),
        (DataTypeKind::Unsigned, Ok(Value::Integer(_)))
        | (_, Ok(Value::Boolean(_) | Value::RealBits(_) | Value::Time { .. })) => {
            number(raw, Width::AtLeast(digits))
        }
        _ => Cow::Borrowed(raw),
    }
}

/// A hexadecimal number in canonical case and width; anything else as it is.
fn number(raw: &[u8], width: Width) -> Cow<'_, [u8]> {
    if !matches!(raw, [b'0', b'x' | b'X', ..] | [b'-', b'0', b'x' | b'X', ..]) {
        return Cow::Borrowed(raw);
    }
    let Ok(number) = Number::parse(raw) else { return Cow::Borrowed(raw) };
    let written = usize::from(number.digits());
    let width = match width {
        _ if number.is_negative() => written,
        Width::AtLeast(digits) => digits,
        Width::Keep(digits) => digits.max(written),
    };
    let sign = if number.is_negative() { "-" } else { "" };
    let text = format!("{sign}0x{:0width$X}", number.value().unsigned_abs());
    if text.as_bytes() == raw { Cow::Borrowed(raw) } else { Cow::Owned(text.into_bytes()) }
}

/// A formula that can be read: `$NODEID` first, in capitals and without blanks, each constant as short as it can be.
fn formula(raw: &[u8]) -> Vec<u8> {
    let mut text = b"$NODEID".to_vec();
    for term in raw.split(|&byte| byte == b'+').map(<[u8]>::trim_ascii).filter(|term| !term.starts_with(b"$"))
    {
        text.push(b'+');
        text.extend_from_slice(&number(term, Width::AtLeast(1)));
    }
    text
}
