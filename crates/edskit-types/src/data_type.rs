//! Types of values.

use crate::Index;
use core::fmt;

/// Declares [`DataType`] and everything that depends on its rows, so that no second list can disagree.
///
/// A row reads: document, index, variant, CiA name, size in bits, kind, Rust type.
macro_rules! data_types {
    ($(
        $(#[doc = $doc:literal])+
        $index:literal $variant:ident $name:literal $bits:expr, $kind:ident $rust_type:literal;
    )+) => {
        /// Data types of the object dictionary (CiA 301; `DataType` in an EDS, CiA 306-1).
        ///
        /// The discriminant is the index of the type: `DataType::Unsigned8 as u16` is `0x0005`. Types of
        /// manufacturers (0040h to 005Fh) and of device profiles (0060h to 025Fh) are not listed.
        ///
        /// ```
        /// use edskit_types::{DataType, Index};
        ///
        /// let data_type = DataType::from_index(Index(0x0010)).unwrap();
        /// assert_eq!(data_type, DataType::Integer24);
        /// assert_eq!(data_type.name(), "INTEGER24");
        /// assert_eq!(data_type.bits(), Some(24));
        /// assert_eq!(data_type.range(), Some((-8_388_608, 8_388_607)));
        /// assert_eq!(data_type.rust_type(), "i32");
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u16)]
        pub enum DataType {
            $( $(#[doc = $doc])+ $variant = $index, )+
        }

        impl DataType {
            /// All data types, by index.
            pub const ALL: &'static [DataType] = &[$( DataType::$variant, )+];

            /// The data type of an index, or `None` if CiA 301 defines none there.
            #[must_use]
            pub const fn from_index(index: Index) -> Option<Self> {
                match index.0 {
                    $( $index => Some(DataType::$variant), )+
                    _ => None,
                }
            }

            // One look-up for each column: a program that needs no names holds none of them.

            /// The name in the standard, such as `UNSIGNED8`.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $( DataType::$variant => $name, )+
                }
            }

            /// The size of a value in bits, 1 to 64, or `None` if the size varies or the type is a record.
            #[must_use]
            pub const fn bits(self) -> Option<u16> {
                match self {
                    $( DataType::$variant => $bits, )+
                }
            }

            /// How values of this type are read and written.
            #[must_use]
            pub const fn kind(self) -> DataTypeKind {
                match self {
                    $( DataType::$variant => DataTypeKind::$kind, )+
                }
            }

            /// The Rust type that holds a value.
            ///
            /// Integers and reals take the smallest Rust number of enough bits. `[u8; N]` and `[u16; N]` leave the
            /// length to the object, `[u8]` stands for a domain, and `struct` for a record, whose members the
            /// sub-objects name.
            #[must_use]
            pub const fn rust_type(self) -> &'static str {
                match self {
                    $( DataType::$variant => $rust_type, )+
                }
            }
        }
    };
}

data_types! {
    /// One bit: 0 is false, 1 is true. It takes one bit in a PDO.
    0x0001 Boolean "BOOLEAN" Some(1), Boolean "bool";
    /// Signed, 8 bits.
    0x0002 Integer8 "INTEGER8" Some(8), Signed "i8";
    /// Signed, 16 bits.
    0x0003 Integer16 "INTEGER16" Some(16), Signed "i16";
    /// Signed, 32 bits.
    0x0004 Integer32 "INTEGER32" Some(32), Signed "i32";
    /// Unsigned, 8 bits.
    0x0005 Unsigned8 "UNSIGNED8" Some(8), Unsigned "u8";
    /// Unsigned, 16 bits.
    0x0006 Unsigned16 "UNSIGNED16" Some(16), Unsigned "u16";
    /// Unsigned, 32 bits.
    0x0007 Unsigned32 "UNSIGNED32" Some(32), Unsigned "u32";
    /// Floating point, 32 bits (IEEE 754 single precision).
    0x0008 Real32 "REAL32" Some(32), Real "f32";
    /// Text of printable ASCII characters, of any length.
    0x0009 VisibleString "VISIBLE_STRING" None, VisibleString "[u8; N]";
    /// Bytes, of any length.
    0x000A OctetString "OCTET_STRING" None, OctetString "[u8; N]";
    /// Text of 16-bit units, of any length.
    0x000B UnicodeString "UNICODE_STRING" None, UnicodeString "[u16; N]";
    /// Date and time: 28 bits of ms after midnight, 4 reserved bits, 16 bits of days since 1984-01-01.
    0x000C TimeOfDay "TIME_OF_DAY" Some(48), TimeOfDay "[u8; 6]";
    /// Duration: 28 bits of ms, 4 reserved bits, 16 bits of days.
    0x000D TimeDifference "TIME_DIFFERENCE" Some(48), TimeDifference "[u8; 6]";
    /// A block of application data, of any length.
    0x000F Domain "DOMAIN" None, Domain "[u8]";
    /// Signed, 24 bits.
    0x0010 Integer24 "INTEGER24" Some(24), Signed "i32";
    /// Floating point, 64 bits (IEEE 754 double precision).
    0x0011 Real64 "REAL64" Some(64), Real "f64";
    /// Signed, 40 bits.
    0x0012 Integer40 "INTEGER40" Some(40), Signed "i64";
    /// Signed, 48 bits.
    0x0013 Integer48 "INTEGER48" Some(48), Signed "i64";
    /// Signed, 56 bits.
    0x0014 Integer56 "INTEGER56" Some(56), Signed "i64";
    /// Signed, 64 bits.
    0x0015 Integer64 "INTEGER64" Some(64), Signed "i64";
    /// Unsigned, 24 bits.
    0x0016 Unsigned24 "UNSIGNED24" Some(24), Unsigned "u32";
    /// Unsigned, 40 bits.
    0x0018 Unsigned40 "UNSIGNED40" Some(40), Unsigned "u64";
    /// Unsigned, 48 bits.
    0x0019 Unsigned48 "UNSIGNED48" Some(48), Unsigned "u64";
    /// Unsigned, 56 bits.
    0x001A Unsigned56 "UNSIGNED56" Some(56), Unsigned "u64";
    /// Unsigned, 64 bits.
    0x001B Unsigned64 "UNSIGNED64" Some(64), Unsigned "u64";
    /// Record of 1400h to 15FFh and 1800h to 19FFh: COB-ID, transmission type, times of a PDO.
    0x0020 PdoCommunicationParameter "PDO_COMMUNICATION_PARAMETER" None, Record "struct";
    /// Record of 1600h to 17FFh and 1A00h to 1BFFh: up to 64 UNSIGNED32 entries that fill a PDO.
    0x0021 PdoMapping "PDO_MAPPING" None, Record "struct";
    /// Record of 1200h to 12FFh: two COB-IDs and the node-ID of the other side.
    0x0022 SdoParameter "SDO_PARAMETER" None, Record "struct";
    /// Record of 1018h: vendor-ID, product code, revision number, serial number.
    0x0023 Identity "IDENTITY" None, Record "struct";
}

impl DataType {
    /// The index of the type, 0001h to 0023h.
    #[must_use]
    pub const fn index(self) -> Index {
        Index(self as u16)
    }

    /// Whether the type is one of INTEGERn and UNSIGNEDn; BOOLEAN is not.
    #[must_use]
    pub const fn is_integer(self) -> bool {
        matches!(self.kind(), DataTypeKind::Signed | DataTypeKind::Unsigned)
    }

    /// Whether the type is one of INTEGERn; reals are not counted.
    #[must_use]
    pub const fn is_signed(self) -> bool {
        matches!(self.kind(), DataTypeKind::Signed)
    }

    /// Whether the type is an integer or a real; BOOLEAN is not.
    #[must_use]
    pub const fn is_numeric(self) -> bool {
        self.is_integer() || matches!(self.kind(), DataTypeKind::Real)
    }

    /// Whether the type is VISIBLE_STRING, OCTET_STRING or UNICODE_STRING; DOMAIN is not.
    #[must_use]
    #[inline]
    pub const fn is_string(self) -> bool {
        matches!(self, Self::VisibleString | Self::OctetString | Self::UnicodeString)
    }

    /// The lowest and the highest value of an integer, or of BOOLEAN (0 and 1); `None` for other types.
    #[must_use]
    pub const fn range(self) -> Option<(i128, i128)> {
        match (self.kind(), self.bits()) {
            (DataTypeKind::Boolean | DataTypeKind::Unsigned, Some(bits)) => Some((0, (1 << bits) - 1)),
            (DataTypeKind::Signed, Some(bits)) => Some((-(1 << (bits - 1)), (1 << (bits - 1)) - 1)),
            _ => None,
        }
    }

    /// Whether a mapping entry may name the type itself, to fill a gap of its size in a PDO: 0001h to 0007h
    /// (the `Dummy` keys of `[DummyUsage]` in an EDS).
    #[must_use]
    pub const fn can_be_dummy(self) -> bool {
        matches!(self.index().0, 0x0001..=0x0007)
    }

    /// Whether a value fits into a PDO: its size is fixed and at most 64 bits. Records do not fit; their
    /// sub-objects may.
    #[must_use]
    pub const fn is_mappable(self) -> bool {
        matches!(self.bits(), Some(1..=64)) && !matches!(self.kind(), DataTypeKind::Record)
    }
}

/// The [name](DataType::name).
impl fmt::Display for DataType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// How the values of a [`DataType`] are read and written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DataTypeKind {
    /// 0 or 1.
    Boolean,
    /// Two's complement integer.
    Signed,
    /// Integer from 0.
    Unsigned,
    /// IEEE 754 floating point.
    Real,
    /// Printable ASCII text.
    VisibleString,
    /// Bytes.
    OctetString,
    /// Text of 16-bit units.
    UnicodeString,
    /// Date and time, 48 bits.
    TimeOfDay,
    /// Duration, 48 bits.
    TimeDifference,
    /// Application data of any size.
    Domain,
    /// Several members, each a sub-object of its own.
    Record,
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;
    use std::string::String;
    use std::vec::Vec;

    fn indices(holds: fn(DataType) -> bool) -> Vec<u16> {
        DataType::ALL.iter().filter(|&&data_type| holds(data_type)).map(|d| d.index().0).collect()
    }

    #[test]
    fn indices_and_types_agree() {
        let known: Vec<DataType> =
            (0..=u16::MAX).filter_map(|index| DataType::from_index(Index(index))).collect();
        assert_eq!(known, DataType::ALL);
        for data_type in known {
            assert_eq!(DataType::from_index(data_type.index()), Some(data_type));
        }
        for reserved in [0x0000, 0x000E, 0x0017, 0x001C, 0x001F, 0x0024, 0x0040] {
            assert_eq!(DataType::from_index(Index(reserved)), None, "{reserved:04X}h");
        }
    }

    #[test]
    fn rows_agree_with_the_variant_and_with_the_name() {
        for &data_type in DataType::ALL {
            let letters = |s: &str| s.chars().filter(|&c| c != '_').collect::<String>().to_ascii_uppercase();
            assert_eq!(letters(&format!("{data_type:?}")), letters(data_type.name()));
            if data_type.is_numeric() {
                let digits: String = data_type.name().chars().filter(char::is_ascii_digit).collect();
                assert_eq!(digits.parse().ok(), data_type.bits(), "{data_type}");
                let sign = match data_type.kind() {
                    DataTypeKind::Signed => "i",
                    DataTypeKind::Unsigned => "u",
                    _ => "f",
                };
                let width = data_type.bits().map(|bits| bits.next_power_of_two().max(8));
                assert_eq!(Some(data_type.rust_type()), width.map(|w| format!("{sign}{w}")).as_deref());
            }
        }
    }

    #[test]
    fn ranges() {
        assert_eq!(DataType::Boolean.range(), Some((0, 1)));
        assert_eq!(DataType::Integer8.range(), Some((i8::MIN.into(), i8::MAX.into())));
        assert_eq!(DataType::Integer64.range(), Some((i64::MIN.into(), i64::MAX.into())));
        assert_eq!(DataType::Unsigned24.range(), Some((0, 0xFF_FFFF)));
        assert_eq!(DataType::Unsigned64.range(), Some((0, u64::MAX.into())));
        for &data_type in DataType::ALL {
            let expected = data_type.is_integer() || data_type == DataType::Boolean;
            assert_eq!(data_type.range().is_some(), expected, "{data_type}");
        }
    }

    #[test]
    fn classes() {
        assert_eq!(indices(DataType::is_signed), [2, 3, 4, 0x10, 0x12, 0x13, 0x14, 0x15]);
        assert_eq!(indices(|d| d.is_integer() && !d.is_signed()), [5, 6, 7, 0x16, 0x18, 0x19, 0x1A, 0x1B]);
        assert_eq!(indices(|d| d.is_numeric() && !d.is_integer()), [8, 0x11]);
        assert_eq!(indices(DataType::is_string), [9, 0xA, 0xB]);
        assert_eq!(indices(DataType::can_be_dummy), [1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(
            indices(|d| !d.is_mappable()),
            [9, 0xA, 0xB, 0xF, 0x20, 0x21, 0x22, 0x23],
            "variable sizes and records"
        );
    }

    #[test]
    fn every_type_lies_in_a_data_type_area() {
        use crate::ObjectArea::{ComplexDataType, StaticDataType};
        for &data_type in DataType::ALL {
            let expected =
                if data_type.kind() == DataTypeKind::Record { ComplexDataType } else { StaticDataType };
            assert_eq!(data_type.index().area(), expected, "{data_type}");
        }
    }
}
