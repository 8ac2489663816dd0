//! Speeds of the bus.

use core::fmt;

/// Bit rates of CANopen (CiA 301; `BaudRate_10` to `BaudRate_1000` in an EDS, CiA 306-1).
///
/// ```
/// use edskit_types::Bitrate;
///
/// let bitrate = Bitrate::from_kbit_per_s(125).unwrap();
/// assert_eq!(bitrate.to_string(), "125 kbit/s");
/// assert_eq!(Bitrate::from_kbit_per_s(100), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u16)]
pub enum Bitrate {
    /// 10 kbit/s.
    Kbit10 = 10,
    /// 20 kbit/s.
    Kbit20 = 20,
    /// 50 kbit/s.
    Kbit50 = 50,
    /// 125 kbit/s.
    Kbit125 = 125,
    /// 250 kbit/s.
    Kbit250 = 250,
    /// 500 kbit/s.
    Kbit500 = 500,
    /// 800 kbit/s.
    Kbit800 = 800,
    /// 1000 kbit/s.
    Kbit1000 = 1000,
}

impl Bitrate {
    /// All bit rates, from slow to fast.
    pub const ALL: &'static [Bitrate] = &[
        Bitrate::Kbit10,
        Bitrate::Kbit20,
        Bitrate::Kbit50,
        Bitrate::Kbit125,
        Bitrate::Kbit250,
        Bitrate::Kbit500,
        Bitrate::Kbit800,
        Bitrate::Kbit1000,
    ];

    /// The bit rate in kbit/s (1 kbit is 1000 bits), 10 to 1000.
    #[must_use]
    pub const fn kbit_per_s(self) -> u16 {
        self as u16
    }

    /// The bit rate of a number of kbit/s, or `None` if CANopen has no such bit rate.
    #[must_use]
    pub const fn from_kbit_per_s(kbit_per_s: u64) -> Option<Self> {
        Some(match kbit_per_s {
            10 => Bitrate::Kbit10,
            20 => Bitrate::Kbit20,
            50 => Bitrate::Kbit50,
            125 => Bitrate::Kbit125,
            250 => Bitrate::Kbit250,
            500 => Bitrate::Kbit500,
            800 => Bitrate::Kbit800,
            1000 => Bitrate::Kbit1000,
            _ => return None,
        })
    }

    /// The bit rate that stands at this index of the standard table, by which LSS configures it (CiA 305 v2.2, configure
    /// bit timing parameters with table selector 0): 0 is 1000 kbit/s, 8 is 10 kbit/s. `None` for 5, which is reserved,
    /// for 9, automatic detection, and for what the table does not have.
    #[must_use]
    pub const fn from_lss_index(table_index: u8) -> Option<Self> {
        Some(match table_index {
            0 => Bitrate::Kbit1000,
            1 => Bitrate::Kbit800,
            2 => Bitrate::Kbit500,
            3 => Bitrate::Kbit250,
            4 => Bitrate::Kbit125,
            6 => Bitrate::Kbit50,
            7 => Bitrate::Kbit20,
            8 => Bitrate::Kbit10,
            _ => return None,
        })
    }
}

/// A set of bit rates: those that a device supports.
///
/// ```
/// use edskit_types::{BitRates, Bitrate};
///
/// let bit_rates = BitRates::NONE.and(Bitrate::Kbit125).and(Bitrate::Kbit500);
/// assert!(bit_rates.has(Bitrate::Kbit500) && !bit_rates.has(Bitrate::Kbit10));
/// assert!(Bitrate::ALL.iter().all(|bit_rate| BitRates::ALL.has(*bit_rate)));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct BitRates(u8);

impl BitRates {
    /// No bit rate.
    pub const NONE: Self = Self(0);
    /// Every bit rate.
    pub const ALL: Self = Self(u8::MAX);

    /// The same and another one.
    #[must_use]
    pub const fn and(self, bit_rate: Bitrate) -> Self {
        Self(self.0 | Self::bit(bit_rate))
    }

    /// Whether a bit rate is among them.
    #[must_use]
    pub const fn has(self, bit_rate: Bitrate) -> bool {
        self.0 & Self::bit(bit_rate) != 0
    }

    const fn bit(bit_rate: Bitrate) -> u8 {
        match bit_rate {
            Bitrate::Kbit10 => 1,
            Bitrate::Kbit20 => 1 << 1,
            Bitrate::Kbit50 => 1 << 2,
            Bitrate::Kbit125 => 1 << 3,
            Bitrate::Kbit250 => 1 << 4,
            Bitrate::Kbit500 => 1 << 5,
            Bitrate::Kbit800 => 1 << 6,
            Bitrate::Kbit1000 => 1 << 7,
        }
    }
}

impl fmt::Display for Bitrate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} kbit/s", self.kbit_per_s())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn numbers_and_bit_rates_agree() {
        let known: Vec<Bitrate> = (0..=2000).filter_map(Bitrate::from_kbit_per_s).collect();
        assert_eq!(known, Bitrate::ALL);
        let numbers: Vec<u16> = known.iter().map(|bitrate| bitrate.kbit_per_s()).collect();
        assert_eq!(numbers, [10, 20, 50, 125, 250, 500, 800, 1000]);
        assert_eq!(Bitrate::from_kbit_per_s(0x1_0000 + 10), None);
    }

    #[test]
    fn a_set_has_what_was_put_in() {
        for one in Bitrate::ALL {
            let set = BitRates::NONE.and(*one);
            assert!(Bitrate::ALL.iter().all(|other| set.has(*other) == (one == other)), "{one}");
        }
        assert_eq!(Bitrate::ALL.iter().fold(BitRates::NONE, |set, one| set.and(*one)), BitRates::ALL);
    }

    #[test]
    fn lss_counts_from_fast_to_slow() {
        let known: Vec<Bitrate> = (0..=u8::MAX).rev().filter_map(Bitrate::from_lss_index).collect();
        assert_eq!(known, Bitrate::ALL);
        assert_eq!(
            [4, 5, 6, 9].map(Bitrate::from_lss_index),
            [Some(Bitrate::Kbit125), None, Some(Bitrate::Kbit50), None]
        );
    }
}
