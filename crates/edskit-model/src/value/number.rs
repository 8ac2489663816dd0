//! The one number parser of the workspace.

use core::fmt;

/// How an integer is written.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Radix {
    /// `10`
    Decimal,
    /// `0x0A`
    Hexadecimal,
    /// `012`: a leading zero, as in C
    Octal,
}

/// An integer as the file writes it: decimal, `0x` hexadecimal, or octal with a leading `0` (CiA 306 v1.3, 4.3).
///
/// A leading minus is accepted although the specification does not describe one; real files use it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Number {
    magnitude: u64,
    negative: bool,
    radix: Radix,
    digits: u8,
}

impl Number {
    /// Reads a whole text as one number.
    ///
    /// ```
    /// use edskit_model::{Number, Radix};
    /// let number = Number::parse(b"0x1B59").unwrap();
    /// assert_eq!((number.value(), number.radix(), number.digits()), (7001, Radix::Hexadecimal, 4));
    /// assert_eq!(Number::parse(b"0x0x1B59").unwrap_err().offset, 3);
    /// ```
    ///
    /// # Errors
    /// What is wrong, and at which byte.
    pub fn parse(text: &[u8]) -> Result<Self, NumberError> {
        let (negative, unsigned) = match text.first() {
            Some(b'-') => (true, &text[1..]),
            Some(b'+') => (false, &text[1..]),
            _ => (false, text),
        };
        let sign = text.len() - unsigned.len();
        let (radix, prefix) = match unsigned {
            [b'0', b'x' | b'X', ..] => (Radix::Hexadecimal, 2),
            [b'0', _, ..] => (Radix::Octal, 1),
            _ => (Radix::Decimal, 0),
        };
        let digits = &unsigned[prefix..];
        let error = |kind, offset: usize| Err(NumberError { kind, offset: (sign + prefix + offset) as u32 });
        if digits.is_empty() {
            let kind = if text.is_empty() { NumberErrorKind::Empty } else { NumberErrorKind::NoDigits };
            return error(kind, 0);
        }
        let mut magnitude = 0u64;
        let mut overflow = false;
        let base = match radix {
            Radix::Decimal => 10,
            Radix::Hexadecimal => 16,
            Radix::Octal => 8,
        };
        for (offset, &byte) in digits.iter().enumerate() {
            let digit = match byte {
                b'0'..=b'9' => u64::from(byte - b'0'),
                b'a'..=b'f' if radix == Radix::Hexadecimal => u64::from(byte - b'a') + 10,
                b'A'..=b'F' if radix == Radix::Hexadecimal => u64::from(byte - b'A') + 10,
                _ => return error(NumberErrorKind::Digit(byte), offset),
            };
            if digit >= base {
                return error(NumberErrorKind::OctalDigit(byte), offset);
            }
            match magnitude.checked_mul(base).and_then(|m| m.checked_add(digit)) {
                Some(next) => magnitude = next,
                None => overflow = true,
            }
        }
        if overflow {
            return error(NumberErrorKind::TooLarge, 0);
        }
        Ok(Self { magnitude, negative, radix, digits: digits.len().min(255) as u8 })
    }

    /// The number `value` as decimal digits would give it.
    pub(crate) const fn decimal(value: u64) -> Self {
        Self { magnitude: value, negative: false, radix: Radix::Decimal, digits: 1 }
    }

    /// The value as written; a hexadecimal literal is never negative by itself.
    #[inline]
    pub fn value(self) -> i128 {
        let magnitude = i128::from(self.magnitude);
        if self.negative { -magnitude } else { magnitude }
    }

    /// The value if it is not negative and fits `T`.
    #[inline]
    pub fn to<T: TryFrom<u64>>(self) -> Option<T> {
        if self.negative && self.magnitude != 0 { None } else { T::try_from(self.magnitude).ok() }
    }

    /// The value when a hexadecimal literal is read as the two's complement of an integer of `bits` bits, where
    /// that differs from [`Number::value`]: the literal fits the width and its top bit is set.
    ///
    /// ```
    /// use edskit_model::Number;
    /// assert_eq!(Number::parse(b"0xFE").unwrap().twos_complement(8), Some(-2));
    /// assert_eq!(Number::parse(b"0x7E").unwrap().twos_complement(8), None);
    /// ```
    pub fn twos_complement(self, bits: u16) -> Option<i128> {
        let hex = self.radix == Radix::Hexadecimal && !self.negative;
        let value = self.value();
        (hex && bits <= 64 && value >> bits == 0 && value >> (bits - 1) == 1).then(|| value - (1 << bits))
    }

    /// How it is written.
    pub fn radix(self) -> Radix {
        self.radix
    }

    /// Whether a minus stands before it.
    pub fn is_negative(self) -> bool {
        self.negative
    }

    /// How many digits are written, without sign and prefix (at most 255).
    pub fn digits(self) -> u8 {
        self.digits
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.negative { "-" } else { "" };
        let width = self.digits as usize;
        match self.radix {
            Radix::Decimal => write!(f, "{sign}{:0width$}", self.magnitude),
            Radix::Hexadecimal => write!(f, "{sign}0x{:0width$X}", self.magnitude),
            Radix::Octal => write!(f, "{sign}0{:0width$o}", self.magnitude),
        }
    }
}

/// Why a text is not a number, and where.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct NumberError {
    /// What is wrong.
    pub kind: NumberErrorKind,
    /// Byte offset in the text.
    pub offset: u32,
}

/// What keeps a text from being a number.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum NumberErrorKind {
    /// There is no text.
    Empty,
    /// A sign or a `0x` without digits.
    NoDigits,
    /// A byte that is no digit.
    Digit(u8),
    /// `8` or `9` in a number that begins with `0` and so is octal.
    OctalDigit(u8),
    /// More than 64 bits.
    TooLarge,
}

impl fmt::Display for NumberError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind {
            NumberErrorKind::Empty => f.write_str("no value"),
            NumberErrorKind::NoDigits => f.write_str("digits are missing"),
            NumberErrorKind::Digit(byte) => write!(f, "{} is not a digit", Byte(byte)),
            NumberErrorKind::OctalDigit(byte) => {
                write!(f, "a leading 0 makes the number octal, and {} is not an octal digit", Byte(byte))
            }
            NumberErrorKind::TooLarge => f.write_str("the number has more than 64 bits"),
        }
    }
}

impl core::error::Error for NumberError {}

/// A byte as messages show it.
pub(crate) struct Byte(pub(crate) u8);

impl fmt::Display for Byte {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            b' ' => f.write_str("a blank"),
            b'\t' => f.write_str("a tab"),
            byte if byte.is_ascii_graphic() => write!(f, "`{}`", byte as char),
            byte => write!(f, "byte {byte:02X}h"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn value(text: &str) -> i128 {
        Number::parse(text.as_bytes()).unwrap().value()
    }

    fn error(text: &str) -> (NumberErrorKind, u32) {
        let error = Number::parse(text.as_bytes()).unwrap_err();
        (error.kind, error.offset)
    }

    #[test]
    fn the_three_radices() {
        assert_eq!(value("10"), 10);
        assert_eq!(value("0x0A"), 10);
        assert_eq!(value("0X0a"), 10);
        assert_eq!(value("012"), 10);
        assert_eq!(value("0"), 0);
        assert_eq!(value("00"), 0);
        assert_eq!(value("-0x80"), -128);
        assert_eq!(value("-1"), -1);
        assert_eq!(value("0xFFFFFFFFFFFFFFFF"), i128::from(u64::MAX));
    }

    #[test]
    fn errors_say_where() {
        assert_eq!(error(""), (NumberErrorKind::Empty, 0));
        assert_eq!(error("0x"), (NumberErrorKind::NoDigits, 2));
        assert_eq!(error("-"), (NumberErrorKind::NoDigits, 1));
        assert_eq!(error("08"), (NumberErrorKind::OctalDigit(b'8'), 1));
        assert_eq!(error("1,5"), (NumberErrorKind::Digit(b','), 1));
        assert_eq!(error("0x0x00001B59"), (NumberErrorKind::Digit(b'x'), 3));
        assert_eq!(error("18446744073709551616"), (NumberErrorKind::TooLarge, 0));
    }

    #[test]
    fn twos_complement_needs_hex_of_the_exact_width() {
        let read = |text: &str, bits| Number::parse(text.as_bytes()).unwrap().twos_complement(bits);
        assert_eq!(read("0x8000", 16), Some(-32768));
        assert_eq!(read("0xFFFFFFFFFFFFFFFF", 64), Some(-1));
        assert_eq!(read("0x18000", 16), None);
        assert_eq!(read("32768", 16), None);
    }

    proptest! {
        #[test]
        fn never_panics(text in proptest::collection::vec(any::<u8>(), 0..40)) {
            let _ = Number::parse(&text);
        }

        #[test]
        fn what_is_displayed_reads_back(value in any::<u64>(), form in 0..3) {
            let text = match form { 0 => format!("{value}"), 1 => format!("0x{value:X}"), _ => format!("0{value:o}") };
            let number = Number::parse(text.as_bytes()).unwrap();
            prop_assert_eq!(number.value(), i128::from(value));
            prop_assert_eq!(number.to_string(), text);
        }
    }
}
