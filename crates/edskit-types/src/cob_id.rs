//! Identifiers on the bus and the objects that configure them.

use core::fmt;
use core::num::NonZeroU32;

/// Identifier of a CAN frame: 11 bits (base format) or 29 bits (extended format).
///
/// The same number in the two formats is two different identifiers.
///
/// ```
/// use edskit_types::CanId;
///
/// assert_eq!(CanId::standard(0x181).unwrap().to_string(), "181h");
/// assert_eq!(CanId::extended(0x181).unwrap().to_string(), "00000181h");
/// assert_eq!(CanId::standard(0x800), None);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CanId(
    /// The number, [`CobId::FRAME`] for 29 bits, and always [`CanId::MARK`]: so `Option<CanId>` needs no further word.
    NonZeroU32,
);

impl CanId {
    /// 000h: network management commands.
    pub const NMT: CanId = Self::of(0);

    const MARK: u32 = 1 << 31;

    const fn of(bits: u32) -> Self {
        match NonZeroU32::new(bits | Self::MARK) {
            Some(bits) => Self(bits),
            None => Self(NonZeroU32::MIN),
        }
    }

    /// An 11-bit identifier, or `None` above 7FFh.
    #[must_use]
    pub const fn standard(id: u16) -> Option<CanId> {
        if id <= 0x7FF { Some(Self::of(id as u32)) } else { None }
    }

    /// A 29-bit identifier, or `None` above 1FFFFFFFh.
    #[must_use]
    pub const fn extended(id: u32) -> Option<CanId> {
        if id <= CobId::EXTENDED_MASK { Some(Self::of(id | CobId::FRAME)) } else { None }
    }

    /// The number without the format: at most 7FFh or 1FFFFFFFh.
    #[must_use]
    pub const fn raw(self) -> u32 {
        self.0.get() & CobId::EXTENDED_MASK
    }

    /// Whether the identifier has 29 bits.
    #[must_use]
    pub const fn is_extended(self) -> bool {
        self.0.get() & CobId::FRAME != 0
    }
}

/// Three digits and `h`, or eight digits and `h` for 29 bits.
impl fmt::Display for CanId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let id = self.raw();
        if self.is_extended() { write!(f, "{id:08X}h") } else { write!(f, "{id:03X}h") }
    }
}

/// `CanId(181h)`: the bits are unreadable in decimal.
impl fmt::Debug for CanId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "CanId({self})")
    }
}

/// Value of an object that configures a COB-ID: a CAN identifier and three bits of service-specific meaning
/// (CiA 301, descriptions of the objects named below).
///
/// | service | object | bit 31 | bit 30 | bit 29 |
/// |---|---|---|---|---|
/// | PDO | 1400h to 15FFh, 1800h to 19FFh, sub 01h | 1: PDO does not exist (not valid) | TPDO 1: no RTR; RPDO: reserved | frame |
/// | SDO | 1201h to 12FFh, subs 01h and 02h | 1: SDO not valid | 1: assigned dynamically | frame |
/// | EMCY | 1014h | 1: EMCY does not exist | reserved, 0 | frame |
/// | EMCY consumer | 1028h, subs 01h to 7Fh | 1: not valid | – | frame |
/// | SYNC | 1005h | do not care | 1: device generates SYNC | frame |
/// | TIME | 1012h | 1: device consumes TIME | 1: device produces TIME | frame |
///
/// Frame 0 stands for an 11-bit identifier in bits 10 to 0, with bits 28 to 11 zero; frame 1 for a 29-bit
/// identifier in bits 28 to 0.
///
/// Every `u32` is a `CobId`: a file may hold any number, and rules judge it.
///
/// ```
/// use edskit_types::{CanId, CobId};
///
/// let disabled_tpdo = CobId(0x8000_0181);
/// assert!(!disabled_tpdo.is_valid());
/// assert_eq!(disabled_tpdo.can_id(), CanId::standard(0x181).unwrap());
/// assert_eq!(disabled_tpdo.to_string(), "80000181h");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CobId(pub u32);

impl CobId {
    /// Bit 31: not valid (PDO, SDO, EMCY), consumer (TIME), without meaning (SYNC).
    pub const BIT_31: u32 = 1 << 31;
    /// Bit 30: no RTR (TPDO), dynamic (SDO), generate (SYNC), producer (TIME), reserved (RPDO, EMCY).
    pub const BIT_30: u32 = 1 << 30;
    /// Bit 29, frame: 1 for a 29-bit identifier.
    pub const FRAME: u32 = 1 << 29;
    /// Bits 10 to 0: an 11-bit identifier.
    pub const STANDARD_MASK: u32 = 0x0000_07FF;
    /// Bits 28 to 0: a 29-bit identifier.
    pub const EXTENDED_MASK: u32 = 0x1FFF_FFFF;
    /// Bits 28 to 11: zero unless the identifier has 29 bits.
    pub const STRAY_MASK: u32 = Self::EXTENDED_MASK & !Self::STANDARD_MASK;

    /// Whether bit 31 is 0: the PDO, SDO or EMCY exists. Says nothing about SYNC and TIME.
    #[must_use]
    pub const fn is_valid(self) -> bool {
        self.0 & Self::BIT_31 == 0
    }

    /// Whether bit 30 is 1; its meaning depends on the service, see [`CobId`].
    #[must_use]
    pub const fn bit30(self) -> bool {
        self.0 & Self::BIT_30 != 0
    }

    /// Whether the frame bit (29) is 1: the identifier has 29 bits.
    #[must_use]
    pub const fn is_extended(self) -> bool {
        self.0 & Self::FRAME != 0
    }

    /// The CAN identifier, of the width that the frame bit names. Stray bits are ignored.
    #[must_use]
    pub const fn can_id(self) -> CanId {
        let width = if self.is_extended() { Self::FRAME | Self::EXTENDED_MASK } else { Self::STANDARD_MASK };
        CanId::of(self.0 & width)
    }

    /// Whether the frame bit is 0 and yet one of the bits 28 to 11 is 1: such a value is wrong, or lacks the
    /// frame bit.
    #[must_use]
    pub const fn has_stray_bits(self) -> bool {
        !self.is_extended() && self.0 & Self::STRAY_MASK != 0
    }
}

impl From<u32> for CobId {
    fn from(value: u32) -> Self {
        CobId(value)
    }
}

/// All 32 bits: eight upper-case digits and `h`.
impl fmt::Display for CobId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:08X}h", self.0)
    }
}

/// `CobId(80000181h)`: the bits are unreadable in decimal.
impl fmt::Debug for CobId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "CobId({self})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    #[test]
    fn widths_are_checked() {
        assert_eq!(CanId::standard(0x7FF).map(CanId::raw), Some(0x7FF));
        assert_eq!(CanId::standard(0x800), None);
        assert_eq!(CanId::extended(0x1FFF_FFFF).map(CanId::raw), Some(0x1FFF_FFFF));
        assert_eq!(CanId::extended(0x2000_0000), None);
        assert_ne!(CanId::standard(5), CanId::extended(5));
    }

    #[test]
    fn frame_bit_chooses_the_width() {
        let standard = CobId(0xC000_0705);
        assert!(!standard.is_extended());
        assert_eq!(Some(standard.can_id()), CanId::standard(0x705));
        let extended = CobId(0x3FFF_FFFF);
        assert!(extended.is_extended() && extended.can_id().is_extended());
        assert_eq!(Some(extended.can_id()), CanId::extended(0x1FFF_FFFF));
    }

    #[test]
    fn the_masks_cover_every_bit_once() {
        let masks = [CobId::BIT_31, CobId::BIT_30, CobId::FRAME, CobId::STRAY_MASK, CobId::STANDARD_MASK];
        assert_eq!(masks.iter().fold(0, |all, mask| all | mask), u32::MAX);
        assert_eq!(masks.iter().map(|mask| mask.count_ones()).sum::<u32>(), 32);
    }

    #[test]
    fn single_bits() {
        for bit in 0..32 {
            let cob_id = CobId(1 << bit);
            assert_eq!(cob_id.is_valid(), bit != 31, "{bit}");
            assert_eq!(cob_id.bit30(), bit == 30, "{bit}");
            assert_eq!(cob_id.is_extended(), bit == 29, "{bit}");
            assert_eq!(cob_id.has_stray_bits(), (11..=28).contains(&bit), "{bit}");
            let with_frame = CobId(1 << bit | CobId::FRAME);
            assert!(!with_frame.has_stray_bits(), "{bit}");
        }
    }

    #[test]
    fn stray_bits_do_not_reach_the_can_id() {
        assert_eq!(Some(CobId(0x0001_0981).can_id()), CanId::standard(0x181));
    }

    #[test]
    fn notation() {
        assert_eq!(format!("{} {:?}", CobId(0x80), CobId(0x80)), "00000080h CobId(00000080h)");
        assert_eq!(format!("{}", CobId(0x81).can_id()), "081h");
        assert_eq!(CobId::from(7), CobId(7));
    }
}
