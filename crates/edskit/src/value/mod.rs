//! Values of the object dictionary between their bytes on the bus and what people read and write.

mod calendar;
mod reading;
mod showing;

pub(crate) use calendar::clock;
pub(crate) use reading::bytes_of;
pub(crate) use showing::{NOT_SAID, counted, digits, hex, is_settled, json, said, text, untyped};

use edskit_types::DataType;
use std::str::FromStr;

/// A data type as people name it on the command line.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct ValueType(pub(crate) DataType);

/// Short names besides those of CiA 301.
const SHORT_NAMES: [(&str, DataType); 25] = [
    ("bool", DataType::Boolean),
    ("u8", DataType::Unsigned8),
    ("u16", DataType::Unsigned16),
    ("u24", DataType::Unsigned24),
    ("u32", DataType::Unsigned32),
    ("u40", DataType::Unsigned40),
    ("u48", DataType::Unsigned48),
    ("u56", DataType::Unsigned56),
    ("u64", DataType::Unsigned64),
    ("i8", DataType::Integer8),
    ("i16", DataType::Integer16),
    ("i24", DataType::Integer24),
    ("i32", DataType::Integer32),
    ("i40", DataType::Integer40),
    ("i48", DataType::Integer48),
    ("i56", DataType::Integer56),
    ("i64", DataType::Integer64),
    ("f32", DataType::Real32),
    ("f64", DataType::Real64),
    ("string", DataType::VisibleString),
    ("unicode", DataType::UnicodeString),
    ("hex", DataType::OctetString),
    ("domain", DataType::Domain),
    ("time", DataType::TimeOfDay),
    ("duration", DataType::TimeDifference),
];

impl FromStr for ValueType {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let short = SHORT_NAMES.iter().find(|(name, _)| name.eq_ignore_ascii_case(text));
        let types = SHORT_NAMES.iter().map(|(_, data_type)| *data_type);
        let long = || types.into_iter().find(|data_type| data_type.name().eq_ignore_ascii_case(text));
        short.map(|(_, data_type)| *data_type).or_else(long).map(Self).ok_or_else(|| {
            "expected u8, u16, u24, u32, u40, u48, u56, u64, the same with i, f32, f64, bool, string, unicode, hex, \
             time, duration, or a name of CiA 301 like UNSIGNED16"
                .to_owned()
        })
    }
}

/// How many bytes a value has; `None` where that differs from value to value.
pub(crate) fn size(data_type: DataType) -> Option<usize> {
    data_type.bits().map(|bits| usize::from(bits.div_ceil(8)))
}

#[cfg(test)]
mod tests;
