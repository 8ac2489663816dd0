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
    fn lss_counts_from_fast_to_slow() {
        let known: Vec<Bitrate> = (0..=u8::MAX).rev().filter_map(Bitrate::from_lss_index).collect();
        assert_eq!(known, Bitrate::ALL);
        assert_eq!(
            [4, 5, 6, 9].map(Bitrate::from_lss_index),
            [Some(Bitrate::Kbit125), None, Some(Bitrate::Kbit50), None]
        );
    }
}
