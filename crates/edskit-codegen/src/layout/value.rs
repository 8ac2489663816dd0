//! Values as the bytes that a device has in its memory.

use super::fixed_size;
use edskit_model::{EvaluationError, Field, Value, octets};
use edskit_types::DataType;

/// The bytes of a value, low byte first.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Bytes {
    pub(super) bytes: Vec<u8>,
    /// The node-ID is to be added.
    pub(super) is_node_relative: bool,
}

impl Bytes {
    pub(super) fn fixed(bytes: impl Into<Vec<u8>>) -> Self {
        Self { bytes: bytes.into(), is_node_relative: false }
    }

    /// The value of an entry of the file, which was read by this type. A DOMAIN has none in a dictionary.
    pub(super) fn of_field(field: Field<'_, Value<'_>>, data_type: DataType) -> Result<Self, String> {
        let text = field.text();
        match (field.known(), field.value) {
            (Some(value), _) => Self::of(value, data_type, &text),
            (None, Err(error)) => Err(error.to_string()),
            (None, Ok(value)) => Self::of(value, data_type, &text),
        }
    }

    /// The value that a text stands for.
    pub(super) fn of_text(text: &str, data_type: DataType) -> Result<Self, String> {
        let value = Value::parse(data_type, text.as_bytes()).map_err(|error| error.to_string())?;
        Self::of(value, data_type, text)
    }

    fn of(value: Value<'_>, data_type: DataType, text: &str) -> Result<Self, String> {
        let size = fixed_size(data_type).unwrap_or_default().into();
        let cut = |bytes: &[u8]| Self::fixed(&bytes[..size]);
        Ok(match value {
            Value::Formula(formula) => {
                let offset = i128::from(formula.offset());
                if data_type.range().is_none_or(|(_, highest)| offset > highest) {
                    return Err(EvaluationError::OutOfRange(offset).to_string());
                }
                Self { is_node_relative: true, ..cut(&offset.to_le_bytes()) }
            }
            Value::Boolean(_) | Value::Integer(_) => {
                let integer = value.integer(data_type, None).map_err(|error| error.to_string())?;
                cut(&integer.to_le_bytes())
            }
            Value::Real(_) | Value::RealBits(_) => {
                let real = value.real(data_type).unwrap_or_default();
                match data_type {
                    DataType::Real32 => Self::fixed((real as f32).to_le_bytes()),
                    _ => Self::fixed(real.to_le_bytes()),
                }
            }
            Value::Text(_) if data_type == DataType::UnicodeString => {
                Self::fixed(text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<_>>())
            }
            Value::Text(bytes) => Self::fixed(bytes),
            Value::Octets(digits) if data_type.is_string() => Self::fixed(octets(digits).collect::<Vec<_>>()),
            Value::Octets(_) | Value::Bits(_) => Self::fixed([]),
            Value::Time { days, milliseconds } => {
                Self::fixed([&milliseconds.to_le_bytes()[..], &days.to_le_bytes()].concat())
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(data_type: DataType, text: &str) -> Vec<u8> {
        Bytes::of_text(text, data_type).unwrap().bytes
    }

    #[test]
    fn every_type_has_its_bytes() {
        assert_eq!(bytes(DataType::Boolean, "1"), [1]);
        assert_eq!(bytes(DataType::Integer8, "-2"), [0xFE]);
        assert_eq!(bytes(DataType::Integer24, "0xFFFFFE"), [0xFE, 0xFF, 0xFF]);
        assert_eq!(bytes(DataType::Unsigned24, "0x010203"), [3, 2, 1]);
        assert_eq!(bytes(DataType::Integer40, "-1"), [0xFF; 5]);
        assert_eq!(bytes(DataType::Unsigned48, "1"), [1, 0, 0, 0, 0, 0]);
        assert_eq!(bytes(DataType::Integer56, "-2"), [0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF]);
        assert_eq!(bytes(DataType::Unsigned64, "0xFFFFFFFFFFFFFFFF"), [0xFF; 8]);
        assert_eq!(bytes(DataType::Real32, "1.5"), 1.5_f32.to_le_bytes());
        assert_eq!(bytes(DataType::Real32, "0x3FC00000"), 1.5_f32.to_le_bytes());
        assert_eq!(bytes(DataType::Real64, "-0.1"), (-0.1_f64).to_le_bytes());
        assert_eq!(bytes(DataType::VisibleString, "a b"), *b"a b");
        assert_eq!(bytes(DataType::OctetString, "0aFF"), [0x0A, 0xFF]);
        assert_eq!(bytes(DataType::UnicodeString, "\u{e4}\u{1F600}"), [0xE4, 0, 0x3D, 0xD8, 0, 0xDE]);
        assert_eq!(bytes(DataType::TimeOfDay, "0x000200000001"), [1, 0, 0, 0, 2, 0]);
        assert_eq!(bytes(DataType::TimeDifference, "010000000200"), [1, 0, 0, 0, 2, 0]);
        assert_eq!(bytes(DataType::Domain, "0102"), []);
    }

    #[test]
    fn formulas_give_their_offset() {
        let formula = Bytes::of_text("$NODEID+0x180", DataType::Unsigned32).unwrap();
        assert_eq!(formula, Bytes { bytes: vec![0x80, 1, 0, 0], is_node_relative: true });
        assert_eq!(
            Bytes::of_text("$NODEID+0x100", DataType::Unsigned8).unwrap_err(),
            "256 is outside the data type"
        );
        assert_eq!(Bytes::of_text("300", DataType::Unsigned8).unwrap_err(), "300 is outside the data type");
    }
}
