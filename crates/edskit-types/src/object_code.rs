//! Shapes of objects.

use core::fmt;

/// Object code: the shape of an object (CiA 301; `ObjectType` in an EDS, CiA 306-1).
///
/// ```
/// use edskit_types::ObjectCode;
///
/// let code = ObjectCode::from_code(0x8).unwrap();
/// assert_eq!(code.to_string(), "ARRAY");
/// assert!(code.has_sub_objects());
/// assert_eq!(ObjectCode::from_code(4), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum ObjectCode {
    /// 0: an object without data.
    Null = 0,
    /// 2: a large, variable amount of data.
    Domain = 2,
    /// 5: definition of a simple type.
    DefType = 5,
    /// 6: definition of a record type.
    DefStruct = 6,
    /// 7: a single value, in sub-index 00h.
    Var = 7,
    /// 8: elements of one type; sub-index 00h is an UNSIGNED8.
    Array = 8,
    /// 9: elements of any types; sub-index 00h is an UNSIGNED8.
    Record = 9,
}

impl ObjectCode {
    /// All object codes, by number.
    pub const ALL: &'static [ObjectCode] = &[
        ObjectCode::Null,
        ObjectCode::Domain,
        ObjectCode::DefType,
        ObjectCode::DefStruct,
        ObjectCode::Var,
        ObjectCode::Array,
        ObjectCode::Record,
    ];

    /// The object code of a number, or `None` if the number is reserved. Takes the width of a parsed number,
    /// so that nobody has to narrow it first.
    #[must_use]
    pub const fn from_code(code: u64) -> Option<Self> {
        Some(match code {
            0 => ObjectCode::Null,
            2 => ObjectCode::Domain,
            5 => ObjectCode::DefType,
            6 => ObjectCode::DefStruct,
            7 => ObjectCode::Var,
            8 => ObjectCode::Array,
            9 => ObjectCode::Record,
            _ => return None,
        })
    }

    /// The number, 0 to 9.
    #[must_use]
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// The name in the standard, such as `ARRAY`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            ObjectCode::Null => "NULL",
            ObjectCode::Domain => "DOMAIN",
            ObjectCode::DefType => "DEFTYPE",
            ObjectCode::DefStruct => "DEFSTRUCT",
            ObjectCode::Var => "VAR",
            ObjectCode::Array => "ARRAY",
            ObjectCode::Record => "RECORD",
        }
    }

    /// Whether objects of this shape have sub-objects: ARRAY, RECORD and DEFSTRUCT.
    #[must_use]
    pub const fn has_sub_objects(self) -> bool {
        matches!(self, ObjectCode::Array | ObjectCode::Record | ObjectCode::DefStruct)
    }
}

/// The [name](ObjectCode::name).
impl fmt::Display for ObjectCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn numbers_and_codes_agree() {
        let known: Vec<ObjectCode> = (0..=300).filter_map(ObjectCode::from_code).collect();
        assert_eq!(known, ObjectCode::ALL);
        for code in known {
            assert_eq!(ObjectCode::from_code(u64::from(code.code())), Some(code));
        }
    }

    #[test]
    fn wide_numbers_are_not_narrowed() {
        assert_eq!(ObjectCode::from_code(0x107), None);
        assert_eq!(ObjectCode::from_code(u64::MAX), None);
    }

    #[test]
    fn shapes_with_sub_objects() {
        let with: Vec<u8> =
            ObjectCode::ALL.iter().filter(|code| code.has_sub_objects()).map(|code| code.code()).collect();
        assert_eq!(with, [6, 8, 9]);
    }

    #[test]
    fn names_can_be_padded() {
        assert_eq!(std::format!("[{:<6}]", ObjectCode::Var), "[VAR   ]");
    }
}
