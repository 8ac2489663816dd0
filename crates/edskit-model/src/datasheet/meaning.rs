//! What the values of entries mean, where the section decides it.

use super::{Description, Section};
use crate::key::{KeyName, Shape};
use crate::section::{ModuleSection, SectionKind};
use crate::value::{Number, Value};
use edskit_types::{AccessType, DataType};

impl SectionKind {
    /// What the values of a key are in a section of this kind: items of lists are indices and numbers, names, or
    /// values.
    #[inline]
    pub fn shape_of(self, name: KeyName) -> Shape {
        match (name, self) {
            (KeyName::Item, Self::CompactNames(_) | Self::CompactDenotations(_)) => Shape::Text(0),
            (KeyName::Item, Self::CompactValues(_)) => Shape::Value,
            (KeyName::Item, _) => Shape::Unsigned(16),
            _ => name.shape(),
        }
    }

    /// Whether the items of the list are indices of objects.
    pub(crate) fn lists_indices(self) -> bool {
        self.is_object_list()
            || matches!(
                self,
                Self::ObjectLinks(_)
                    | Self::Module(_, ModuleSection::FixedObjects | ModuleSection::SubExtends)
            )
    }
}

impl Section<'_> {
    /// The data type of the values in this section: its own, or in `[xxxxValue]` the object's. `None` where there is
    /// none or it is not one of CiA 301.
    pub fn value_type(self) -> Option<DataType> {
        match self.kind() {
            SectionKind::CompactValues(index) => self.sheet().object(index)?.standard_type(),
            kind if kind.is_description() => Description { section: self }.standard_type(),
            _ => None,
        }
    }
}

/// What a value says, whatever its spelling. Two values that are equal are so for every reader that follows either
/// reading of hexadecimal literals.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Meaning<'a> {
    /// A number: as written, and as the two's complement of a signed type.
    Number(i128, i128),
    /// A formula, by the sum of its constants.
    Formula(u64),
    /// A real number written in decimal, by its bits.
    Real(u64),
    /// A real number written as its bits.
    RealBits(u64),
    /// A time.
    Time(u16, u32),
    /// An access type.
    Access(AccessType),
    /// A text, or something that has no meaning.
    Text(&'a [u8]),
}

impl<'a> Meaning<'a> {
    /// What `raw` says as a value of `shape`, of `data_type` where the shape is that of typed values.
    pub(crate) fn of(raw: &'a [u8], shape: Shape, data_type: Option<DataType>) -> Self {
        let known = match shape {
            Shape::Unsigned(_) | Shape::Flag | Shape::ObjectCode => {
                Number::parse(raw).ok().map(|number| Self::Number(number.value(), number.value()))
            }
            Shape::Access => AccessType::parse(raw).map(Self::Access),
            Shape::Value => data_type.and_then(|data_type| Self::typed(raw, data_type)),
            Shape::Text(_) | Shape::Edition | Shape::Time | Shape::Date | Shape::Special => None,
        };
        known.unwrap_or(Self::Text(raw))
    }

    fn typed(raw: &'a [u8], data_type: DataType) -> Option<Self> {
        Some(match Value::parse(data_type, raw).ok()? {
            Value::Boolean(value) => Self::Number(value.into(), value.into()),
            Value::Integer(number) => {
                let bits = data_type.bits().filter(|_| data_type.is_signed());
                let value = number.value();
                Self::Number(value, bits.and_then(|bits| number.twos_complement(bits)).unwrap_or(value))
            }
            Value::Formula(formula) => Self::Formula(formula.offset()),
            Value::Real(value) => Self::Real(value.to_bits()),
            Value::RealBits(bits) => Self::RealBits(bits),
            Value::Time { days, milliseconds } => Self::Time(days, milliseconds),
            Value::Text(text) | Value::Octets(text) | Value::Bits(text) => Self::Text(text),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Datasheet;

    fn of(data_type: DataType, raw: &str) -> Meaning<'_> {
        Meaning::of(raw.as_bytes(), Shape::Value, Some(data_type))
    }

    #[test]
    fn items_depend_on_their_list() {
        let sheet =
            Datasheet::parse(b"[2000]\nDataType=3\n[2000Value]\n1=0\n[2000Name]\n1=a\n[OptionalObjects]\n");
        let sections: Vec<_> = sheet.sections().collect();
        let shapes: Vec<_> = sections.iter().map(|section| section.kind().shape_of(KeyName::Item)).collect();
        assert_eq!(shapes[1..], [Shape::Value, Shape::Text(0), Shape::Unsigned(16)]);
        let types: Vec<_> = sections.iter().map(|section| section.value_type()).collect();
        assert_eq!(types, [Some(DataType::Integer16), Some(DataType::Integer16), None, None]);
    }

    #[test]
    fn spellings_of_one_value_mean_the_same() {
        assert_eq!(of(DataType::Unsigned16, "0x0010"), of(DataType::Unsigned16, "16"));
        assert_eq!(of(DataType::Integer16, "0xff9c"), of(DataType::Integer16, "0xFF9C"));
        assert_eq!(of(DataType::Unsigned32, "0x180 + $nodeid"), of(DataType::Unsigned32, "$NODEID+0x180"));
        assert_eq!(of(DataType::Real32, "1.50"), of(DataType::Real32, "1.5"));
        assert_eq!(of(DataType::TimeOfDay, "0x1"), of(DataType::TimeOfDay, "1"));
        assert_eq!(Meaning::of(b"RW", Shape::Access, None), Meaning::of(b"rw", Shape::Access, None));
    }

    #[test]
    fn what_some_reader_takes_differently_does_not() {
        assert_ne!(of(DataType::Integer16, "0xFF9C"), of(DataType::Integer16, "-100"));
        assert_ne!(of(DataType::Integer16, "0xFF9C"), of(DataType::Integer16, "65436"));
        assert_ne!(of(DataType::Real32, "0x3F800000"), of(DataType::Real32, "1"));
        assert_ne!(of(DataType::OctetString, "ab"), of(DataType::OctetString, "AB"));
        assert_ne!(Meaning::of(b"0x10", Shape::Value, None), Meaning::of(b"16", Shape::Value, None));
    }
}
