//! What values mean: numbers, formulas, and texts read by the data type of their object.

mod formula;
mod number;

pub use formula::{Formula, FormulaError, FormulaErrorKind, FormulaStyle};
pub(crate) use number::Byte;
pub use number::{Number, NumberError, NumberErrorKind, Radix};

use crate::Span;
use core::fmt;
use edskit_types::{DataType, DataTypeKind, NodeId};

/// A value as the file writes it, read by its data type.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Value<'a> {
    /// BOOLEAN: `0` or `1`.
    Boolean(bool),
    /// An integer as written. It may lie outside its type; [`Value::integer`] tells.
    Integer(Number),
    /// An integer that depends on the node-ID.
    Formula(Formula),
    /// REAL32 or REAL64, written in decimal.
    Real(f64),
    /// REAL32 or REAL64, written as the hexadecimal IEEE 754 bits.
    RealBits(u64),
    /// VISIBLE_STRING or UNICODE_STRING: the text without quotes or escapes.
    Text(&'a [u8]),
    /// OCTET_STRING or DOMAIN: pairs of hexadecimal digits, checked; [`octets`] decodes them.
    Octets(&'a [u8]),
    /// A string of bits: only `0` and `1`.
    Bits(&'a [u8]),
    /// TIME_OF_DAY or TIME_DIFFERENCE.
    Time {
        /// Days: since 1984-01-01 for TIME_OF_DAY.
        days: u16,
        /// Milliseconds: after midnight for TIME_OF_DAY; 28 bits.
        milliseconds: u32,
    },
}

impl<'a> Value<'a> {
    /// Reads `text`, which has no blanks around it, as a value of `data_type`.
    ///
    /// ```
    /// use edskit_model::Value;
    /// use edskit_types::{DataType, NodeId};
    /// let value = Value::parse(DataType::Integer8, b"0xFE").unwrap();
    /// assert_eq!(value.integer(DataType::Integer8, None), Ok(-2));
    /// let cob_id = Value::parse(DataType::Unsigned32, b"$NODEID+0x180").unwrap();
    /// assert_eq!(cob_id.integer(DataType::Unsigned32, NodeId::new(1).ok()), Ok(0x181));
    /// ```
    ///
    /// # Errors
    /// Why the text is no such value, and which of its bytes.
    pub fn parse(data_type: DataType, text: &'a [u8]) -> Result<Self, ValueError> {
        match data_type.kind() {
            DataTypeKind::Signed | DataTypeKind::Unsigned => parse_integer(text),
            DataTypeKind::Boolean => match parse_integer(text)? {
                Self::Integer(number) if number.value() == 0 => Ok(Self::Boolean(false)),
                Self::Integer(number) if number.value() == 1 => Ok(Self::Boolean(true)),
                _ => Err(ValueError::whole(ValueErrorKind::NotBoolean, text)),
            },
            DataTypeKind::Real => parse_real(data_type, text),
            DataTypeKind::VisibleString | DataTypeKind::UnicodeString => Ok(Self::Text(text)),
            DataTypeKind::OctetString | DataTypeKind::Domain => {
                parse_octets(text).map(|()| Self::Octets(text))
            }
            DataTypeKind::TimeOfDay | DataTypeKind::TimeDifference => parse_time(text),
            DataTypeKind::Record => Err(ValueError::whole(ValueErrorKind::RecordHasNoValue, text)),
        }
    }

    /// Reads `text` as a value of a type that CiA 301 does not define: a number, a formula, or a string of at
    /// least eight bits.
    ///
    /// # Errors
    /// [`ValueErrorKind::UnknownType`] for anything else.
    pub fn parse_untyped(text: &'a [u8]) -> Result<Self, ValueError> {
        if text.len() >= 8 && text.iter().all(|byte| matches!(byte, b'0' | b'1')) {
            return Ok(Self::Bits(text));
        }
        parse_integer(text).map_err(|_| ValueError::whole(ValueErrorKind::UnknownType, text))
    }

    /// The integer that the device gets: hexadecimal literals of signed types are two's complement, a formula is
    /// evaluated.
    ///
    /// # Errors
    /// What is missing or does not fit `data_type`.
    pub fn integer(self, data_type: DataType, node_id: Option<NodeId>) -> Result<i128, EvaluationError> {
        let value = match self {
            Self::Boolean(value) => i128::from(value),
            Self::Integer(number) => match (data_type.is_signed(), data_type.bits()) {
                (true, Some(bits)) => number.twos_complement(bits).unwrap_or(number.value()),
                _ => number.value(),
            },
            Self::Formula(formula) => {
                let node_id = node_id.ok_or(EvaluationError::NodeIdNeeded)?;
                i128::from(formula.evaluate(node_id).ok_or(EvaluationError::Overflow)?)
            }
            _ => return Err(EvaluationError::NotAnInteger),
        };
        match data_type.range() {
            Some((low, high)) if value < low || value > high => Err(EvaluationError::OutOfRange(value)),
            Some(_) => Ok(value),
            None => Err(EvaluationError::NotAnInteger),
        }
    }

    /// The real number that the device gets; REAL32 bits are widened.
    pub fn real(self, data_type: DataType) -> Option<f64> {
        match self {
            Self::Real(value) => Some(value),
            Self::RealBits(bits) if data_type == DataType::Real32 => Some(f32::from_bits(bits as u32).into()),
            Self::RealBits(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }
}

/// Decodes pairs of hexadecimal digits, with whatever [`meant`](crate::meant) allows between them: blanks, `0x` and quotes.
pub fn octets(digits: &[u8]) -> impl Iterator<Item = u8> + '_ {
    let parts = digits.split(|byte| byte.is_ascii_whitespace() || matches!(byte, b'"' | b'\''));
    let bare = parts.map(|part| match part {
        [b'0', b'x' | b'X', digits @ ..] => digits,
        digits => digits,
    });
    let digit = |byte: u8| (byte as char).to_digit(16).unwrap_or_default() as u8;
    bare.flat_map(move |digits| digits.chunks_exact(2).map(move |pair| digit(pair[0]) << 4 | digit(pair[1])))
}

fn parse_integer(text: &[u8]) -> Result<Value<'_>, ValueError> {
    match Number::parse(text) {
        Ok(number) => Ok(Value::Integer(number)),
        Err(_) if Formula::is_meant(text) => match Formula::parse(text) {
            Ok(formula) => Ok(Value::Formula(formula)),
            Err(error) => Err(ValueError { kind: ValueErrorKind::Formula(error.kind), span: error.span }),
        },
        Err(error) => Err(ValueError::number(error, text)),
    }
}

fn parse_real(data_type: DataType, text: &[u8]) -> Result<Value<'_>, ValueError> {
    if let [b'0', b'x' | b'X', ..] = text {
        let number = Number::parse(text).map_err(|error| ValueError::number(error, text))?;
        return match (number.to::<u64>(), data_type) {
            (Some(bits), DataType::Real32) if bits > u64::from(u32::MAX) => {
                Err(ValueError::whole(ValueErrorKind::NotReal, text))
            }
            (Some(bits), _) => Ok(Value::RealBits(bits)),
            (None, _) => Err(ValueError::whole(ValueErrorKind::NotReal, text)),
        };
    }
    let number = std::str::from_utf8(text).ok().and_then(|text| text.parse().ok());
    number.map(Value::Real).ok_or(ValueError::whole(ValueErrorKind::NotReal, text))
}

fn parse_octets(text: &[u8]) -> Result<(), ValueError> {
    if let Some(offset) = text.iter().position(|byte| !byte.is_ascii_hexdigit()) {
        let span = Span::new(offset as u32, offset as u32 + 1);
        return Err(ValueError { kind: ValueErrorKind::NotHex(text[offset]), span });
    }
    if text.len() % 2 == 1 {
        return Err(ValueError::whole(ValueErrorKind::OddDigits, text));
    }
    Ok(())
}

/// The most milliseconds of a time: they have 28 bits.
const MOST_MILLISECONDS: u32 = 0x0FFF_FFFF;

/// A time is 48 bits: 28 bits of milliseconds, 4 reserved, 16 bits of days (CiA 301, 7.1.6.5). CiA 306 gives no form for it:
/// files have days and milliseconds with a blank between them, the 48 bits as one number, or the bytes as they are sent.
fn parse_time(text: &[u8]) -> Result<Value<'_>, ValueError> {
    let error = ValueError::whole(ValueErrorKind::NotTime, text);
    if let Some(blank) = text.iter().position(u8::is_ascii_whitespace) {
        let number = |text: &[u8]| Number::parse(text.trim_ascii()).ok();
        let days = number(&text[..blank]).and_then(Number::to::<u16>).ok_or(error)?;
        let milliseconds = number(&text[blank..]).and_then(Number::to::<u32>);
        let milliseconds = milliseconds.filter(|value| *value <= MOST_MILLISECONDS).ok_or(error)?;
        return Ok(Value::Time { days, milliseconds });
    }
    let is_octets =
        text.len() == 12 && !matches!(text, [b'0', b'x' | b'X', ..]) && parse_octets(text).is_ok();
    let raw = if is_octets {
        octets(text).enumerate().fold(0, |raw, (position, byte)| raw | u64::from(byte) << (8 * position))
    } else {
        Number::parse(text).ok().and_then(Number::to::<u64>).filter(|raw| raw >> 48 == 0).ok_or(error)?
    };
    Ok(Value::Time { days: (raw >> 32) as u16, milliseconds: raw as u32 & MOST_MILLISECONDS })
}

/// Why a text is not the value that it should be, and where in it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct ValueError {
    /// What is wrong.
    pub kind: ValueErrorKind,
    /// The bytes of the value that are wrong, counted from its first byte.
    pub span: Span,
}

impl ValueError {
    pub(crate) fn whole(kind: ValueErrorKind, text: &[u8]) -> Self {
        Self { kind, span: Span::new(0, text.len() as u32) }
    }

    pub(crate) fn number(error: NumberError, text: &[u8]) -> Self {
        Self { kind: ValueErrorKind::Number(error.kind), span: Span::new(error.offset, text.len() as u32) }
    }
}

/// What keeps a text from being the value that it should be.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum ValueErrorKind {
    /// The entry has no value, which CiA 306 v1.3, 4.2 makes equal to a missing entry.
    Empty,
    /// Not a number.
    Number(NumberErrorKind),
    /// Meant as a formula, but not one.
    Formula(FormulaErrorKind),
    /// A number that does not fit the entry: the largest value is given.
    AboveMaximum(u64),
    /// A BOOLEAN or a flag other than `0` and `1`.
    NotBoolean,
    /// Not a real number.
    NotReal,
    /// A byte that is no hexadecimal digit, in a string of octets.
    NotHex(u8),
    /// An odd number of hexadecimal digits.
    OddDigits,
    /// Not 48 bits of time.
    NotTime,
    /// None of the access types.
    NotAccess,
    /// None of the object codes.
    NotObjectCode,
    /// The data type is a record, which has no value of its own.
    RecordHasNoValue,
    /// The data type is missing or not one of CiA 301, so the text cannot be read.
    UnknownType,
}

impl fmt::Display for ValueError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind {
            ValueErrorKind::Empty => f.write_str("there is no value"),
            ValueErrorKind::Number(kind) => NumberError { kind, offset: 0 }.fmt(f),
            ValueErrorKind::Formula(kind) => FormulaError { kind, span: self.span }.fmt(f),
            ValueErrorKind::AboveMaximum(maximum) => write!(f, "the number is not in 0..{maximum}"),
            ValueErrorKind::NotBoolean => f.write_str("only 0 and 1 are allowed"),
            ValueErrorKind::NotReal => f.write_str("this is not a real number"),
            ValueErrorKind::NotHex(byte) => write!(f, "{} is not a hexadecimal digit", Byte(byte)),
            ValueErrorKind::OddDigits => f.write_str("every octet needs two hexadecimal digits"),
            ValueErrorKind::NotTime => f.write_str("this is not a time of 48 bits"),
            ValueErrorKind::NotAccess => f.write_str("the access types are ro, wo, rw, rwr, rww and const"),
            ValueErrorKind::NotObjectCode => f.write_str("the object codes are 0, 2, 5, 6, 7, 8 and 9"),
            ValueErrorKind::RecordHasNoValue => f.write_str("a record has no value of its own"),
            ValueErrorKind::UnknownType => {
                f.write_str("the data type is not known, so the value cannot be read")
            }
        }
    }
}

impl core::error::Error for ValueError {}

/// Why a value has no integer for a device.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum EvaluationError {
    /// The value or the data type is not an integer.
    NotAnInteger,
    /// The value depends on the node-ID, and none was given.
    NodeIdNeeded,
    /// The sum has more than 64 bits.
    Overflow,
    /// The value does not fit the data type.
    OutOfRange(i128),
}

impl fmt::Display for EvaluationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAnInteger => f.write_str("not an integer"),
            Self::NodeIdNeeded => f.write_str("the value depends on the node-ID"),
            Self::Overflow => f.write_str("the sum does not fit 64 bits"),
            Self::OutOfRange(value) => write!(f, "{value} is outside the data type"),
        }
    }
}

impl core::error::Error for EvaluationError {}

#[cfg(test)]
mod tests;
