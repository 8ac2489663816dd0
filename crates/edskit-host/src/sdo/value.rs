//! What was read.

use edskit_types::{DataType, DataTypeKind};
use std::ops::Deref;

/// What an entry holds: its bytes as they came, low byte first for numbers, and whether the server has said where they
/// end.
///
/// CiA 301 v4.2, 7.2.4.3 lets a server leave the length unsaid: in an expedited answer (s = 0), and where a transfer in
/// segments begins without a length and its last segment has none either (n = 0). Then the bytes at the end may be
/// filling, and the type of the entry says how many count; [`of_type`](Self::of_type) knows that. A slice of it
/// (`Deref`) is all bytes.
///
/// ```
/// use edskit_host::sdo::SdoValue;
/// use edskit_types::DataType;
///
/// // 42h: expedited, without a length.
/// let value = SdoValue { bytes: vec![0x2C, 0x01, 0, 0], unsure: 3 };
/// assert!(!value.is_length_said());
/// assert_eq!(value.of_type(DataType::Unsigned16), [0x2C, 0x01]);
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct SdoValue {
    /// All bytes that came.
    pub bytes: Vec<u8>,
    /// How many of the last bytes may be filling: 0 where the length was said, else up to 3 of an expedited answer and
    /// up to 6 of a last segment.
    pub unsure: usize,
}

impl SdoValue {
    /// A value of this length exactly.
    #[must_use]
    pub fn new(bytes: Vec<u8>) -> Self {
        Self { bytes, unsure: 0 }
    }

    /// Whether the server has said how many bytes the value has.
    #[must_use]
    pub fn is_length_said(&self) -> bool {
        self.unsure == 0
    }

    /// Whether a value of this type has a certain length: the server has said it, or the size of the type is one that the
    /// value can have, or zeros end a text.
    #[must_use]
    pub fn is_settled_by(&self, data_type: DataType) -> bool {
        use DataTypeKind::{UnicodeString, VisibleString};
        let is_text = matches!(data_type.kind(), VisibleString | UnicodeString);
        self.is_length_said() || is_text || size(data_type).is_some_and(|size| self.can_have(size))
    }

    /// The bytes that count in a value of this type. Where the server has said the length, all do, and where it is not
    /// that of the type either; else as many as the type has, and of a text those before the zeros that fill it.
    #[must_use]
    pub fn of_type(&self, data_type: DataType) -> &[u8] {
        let length = match size(data_type) {
            Some(size) if self.can_have(size) => size,
            Some(_) => self.bytes.len(),
            None => match data_type.kind() {
                DataTypeKind::VisibleString => self.without_zeros(1),
                DataTypeKind::UnicodeString => self.without_zeros(2),
                _ => self.bytes.len(),
            },
        };
        &self.bytes[..length]
    }

    fn can_have(&self, size: usize) -> bool {
        (self.bytes.len().saturating_sub(self.unsure)..=self.bytes.len()).contains(&size)
    }

    /// The length without characters of `width` bytes that are zero, as far as they may be filling.
    fn without_zeros(&self, width: usize) -> usize {
        let least = self.bytes.len().saturating_sub(self.unsure);
        let text = self.bytes.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
        text.next_multiple_of(width).clamp(least, self.bytes.len())
    }
}

fn size(data_type: DataType) -> Option<usize> {
    data_type.bits().map(|bits| usize::from(bits.div_ceil(8)))
}

impl Deref for SdoValue {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.bytes
    }
}

impl PartialEq<Vec<u8>> for SdoValue {
    fn eq(&self, bytes: &Vec<u8>) -> bool {
        self.bytes == *bytes
    }
}

impl<const N: usize> PartialEq<[u8; N]> for SdoValue {
    fn eq(&self, bytes: &[u8; N]) -> bool {
        self.bytes == bytes
    }
}

impl From<SdoValue> for Vec<u8> {
    fn from(value: SdoValue) -> Self {
        value.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_settles_what_its_size_can_be() {
        for &data_type in DataType::ALL {
            for (length, unsure) in [(4, 3), (7, 6), (14, 6), (4, 0), (8, 0)] {
                let value = SdoValue { bytes: vec![1; length], unsure };
                let counted = value.of_type(data_type).len();
                match size(data_type) {
                    Some(size) if (length - unsure..=length).contains(&size) => assert_eq!(counted, size),
                    _ => assert_eq!(counted, length, "{data_type:?} in {length} bytes, {unsure} unsure"),
                }
            }
        }
    }

    #[test]
    fn zeros_fill_a_text_only_where_the_length_is_not_said() {
        let text = |bytes: &[u8], unsure, data_type| {
            SdoValue { bytes: bytes.to_vec(), unsure }.of_type(data_type).to_vec()
        };
        assert_eq!(text(b"AB\0\0", 3, DataType::VisibleString), b"AB");
        assert_eq!(text(b"AB\0\0", 0, DataType::VisibleString), b"AB\0\0");
        assert_eq!(text(b"A\0\0\0\0\0\0\0", 3, DataType::VisibleString), b"A\0\0\0\0");
        assert_eq!(text(b"\0\x01\0\0\0\0\0", 6, DataType::UnicodeString), [0, 1]);
        assert_eq!(text(b"a\0b\0\0\0\0", 6, DataType::UnicodeString), b"a\0b\0");
        assert_eq!(text(b"AB\0\0", 3, DataType::OctetString), b"AB\0\0");
    }
}
