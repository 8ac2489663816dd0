//! Rust types of values.

use crate::TimeOfDay;

/// A type that values of entries can have: `bool`, the integers, `f32`, `f64`, [`TimeOfDay`] and [`TimeDifference`].
///
/// Integers of 24, 40, 48 and 56 bits are held by the next larger type.
pub trait Value: Copy + sealed::Sealed {
    /// The value of bytes in the order of the bus, low byte first. Missing bytes count as 0, or as 1 bits behind a
    /// negative number.
    fn from_bytes(bytes: &[u8]) -> Self;

    /// Writes the value into all of `bytes`, low byte first; what does not fit is cut off.
    fn to_bytes(self, bytes: &mut [u8]);
}

mod sealed {
    pub trait Sealed {}
}

macro_rules! integers {
    ($($integer:ident $is_signed:literal),*) => {
        $(
            impl sealed::Sealed for $integer {}

            impl Value for $integer {
                fn from_bytes(bytes: &[u8]) -> Self {
                    raw(bytes, $is_signed) as $integer
                }

                fn to_bytes(self, bytes: &mut [u8]) {
                    write_raw(self as u64, bytes);
                }
            }
        )*
    };
}

integers!(u8 false, u16 false, u32 false, u64 false, i8 true, i16 true, i32 true, i64 true);

impl sealed::Sealed for bool {}

impl Value for bool {
    fn from_bytes(bytes: &[u8]) -> Self {
        bytes.first().is_some_and(|byte| *byte != 0)
    }

    fn to_bytes(self, bytes: &mut [u8]) {
        write_raw(self.into(), bytes);
    }
}

impl sealed::Sealed for f32 {}

impl Value for f32 {
    fn from_bytes(bytes: &[u8]) -> Self {
        Self::from_bits(raw(bytes, false) as u32)
    }

    fn to_bytes(self, bytes: &mut [u8]) {
        write_raw(self.to_bits().into(), bytes);
    }
}

impl sealed::Sealed for f64 {}

impl Value for f64 {
    fn from_bytes(bytes: &[u8]) -> Self {
        Self::from_bits(raw(bytes, false))
    }

    fn to_bytes(self, bytes: &mut [u8]) {
        write_raw(self.to_bits(), bytes);
    }
}

/// A span of time (CiA 301 v4.2, 7.1.6.6).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct TimeDifference {
    /// Milliseconds, in 28 bits.
    pub milliseconds: u32,
    /// Days.
    pub days: u16,
}

/// Four bits behind the milliseconds have no meaning.
const MILLISECONDS: u32 = 0x0FFF_FFFF;

macro_rules! times {
    ($($time:ident),*) => {
        $(
            impl sealed::Sealed for $time {}

            impl Value for $time {
                fn from_bytes(bytes: &[u8]) -> Self {
                    let bits = raw(bytes, false);
                    Self { milliseconds: bits as u32 & MILLISECONDS, days: (bits >> 32) as u16 }
                }

                fn to_bytes(self, bytes: &mut [u8]) {
                    write_raw(u64::from(self.days) << 32 | u64::from(self.milliseconds & MILLISECONDS), bytes);
                }
            }
        )*
    };
}

times!(TimeOfDay, TimeDifference);

/// The bits of at most eight bytes, low byte first, sign-extended where asked for.
#[inline(never)]
pub(crate) fn raw(bytes: &[u8], is_signed: bool) -> u64 {
    let is_negative = is_signed && bytes.last().is_some_and(|byte| byte & 0x80 != 0);
    bits(bytes, if is_negative { u64::MAX } else { 0 })
}

/// The bits of at most eight bytes, low byte first. Unlike [`raw`] it is no call, for what is done with every value of a PDO.
#[inline(always)]
pub(crate) fn unsigned(bytes: &[u8]) -> u64 {
    bits(bytes, 0)
}

/// The same, with the bits of `above` above them.
#[inline(always)]
fn bits(bytes: &[u8], above: u64) -> u64 {
    // Almost every value is shorter than eight bytes: a call that copies them costs more than these steps.
    bytes.iter().take(size_of::<u64>()).rev().fold(above, |bits, byte| bits << 8 | u64::from(*byte))
}

#[inline(never)]
fn write_raw(mut bits: u64, bytes: &mut [u8]) {
    for byte in bytes.iter_mut().take(size_of::<u64>()) {
        *byte = bits as u8;
        bits >>= 8;
    }
}

/// Copies as many bytes as both have. Unlike `copy_from_slice` it cannot panic.
#[inline(never)]
pub(crate) fn copy(to: &mut [u8], from: &[u8]) {
    if from.len() <= size_of::<u64>() {
        // Almost every value is so short that a call that copies memory takes longer than these steps.
        let mut bits = unsigned(from);
        for place in to.iter_mut().take(from.len()) {
            *place = bits as u8;
            bits >>= 8;
        }
        return;
    }
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn short_integers_keep_their_sign() {
        assert_eq!(i32::from_bytes(&[0xFE, 0xFF, 0xFF]), -2);
        assert_eq!(u32::from_bytes(&[0xFE, 0xFF, 0xFF]), 0x00FF_FFFE);
        assert_eq!(i64::from_bytes(&[0, 0, 0, 0, 0, 0, 0x80]), -(1 << 55));
        let mut bytes = [0; 3];
        (-2_i32).to_bytes(&mut bytes);
        assert_eq!(bytes, [0xFE, 0xFF, 0xFF]);
    }

    #[test]
    fn reals_are_bits() {
        let mut bytes = [0; 8];
        1.5_f64.to_bytes(&mut bytes);
        assert_eq!(f64::from_bytes(&bytes), 1.5);
        assert_eq!(f32::from_bytes(&[0, 0, 0xC0, 0x3F]), 1.5);
        assert!(bool::from_bytes(&[2]) && !bool::from_bytes(&[]));
    }

    #[test]
    fn times_have_six_bytes() {
        let mut bytes = [0; 6];
        TimeOfDay { milliseconds: 0x1234_5678, days: 9000 }.to_bytes(&mut bytes);
        assert_eq!(bytes, [0x78, 0x56, 0x34, 2, 0x28, 0x23]);
        let read = TimeDifference::from_bytes(&[1, 0, 0, 0xF0, 2, 0]);
        assert_eq!(read, TimeDifference { milliseconds: 1, days: 2 });
    }

    proptest! {
        #[test]
        fn there_and_back(value: i64, other: u16) {
            let mut bytes = [0; 8];
            value.to_bytes(&mut bytes);
            prop_assert_eq!(i64::from_bytes(&bytes), value);
            other.to_bytes(&mut bytes[..2]);
            prop_assert_eq!(u16::from_bytes(&bytes[..2]), other);
        }
    }
}
