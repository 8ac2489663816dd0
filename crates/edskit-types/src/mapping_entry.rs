//! One entry of a PDO mapping.

use crate::{Index, SubIndex};
use core::fmt;

/// One entry of a PDO mapping record: which dictionary entry, and how many of its bits (CiA 301, 1600h and 1A00h).
///
/// ```
/// use edskit_types::{Index, MappingEntry, SubIndex};
/// let entry = MappingEntry(0x6040_0010);
/// assert_eq!((entry.index(), entry.sub_index(), entry.bits()), (Index(0x6040), SubIndex(0), 16));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct MappingEntry(
    /// Bits 31..16 the index, 15..8 the sub-index, 7..0 the length in bits.
    pub u32,
);

impl MappingEntry {
    /// The index of the mapped object; that of a data type (0001h..0007h) for a dummy.
    pub const fn index(self) -> Index {
        Index((self.0 >> 16) as u16)
    }

    /// The sub-index of the mapped entry.
    pub const fn sub_index(self) -> SubIndex {
        SubIndex((self.0 >> 8) as u8)
    }

    /// How many bits the entry takes in the PDO.
    pub const fn bits(self) -> u8 {
        self.0 as u8
    }

    /// Whether the entry is a dummy: it names a data type and only fills a gap.
    pub const fn is_dummy(self) -> bool {
        matches!(self.index().0, 0x0001..=0x001F)
    }
}

impl fmt::Display for MappingEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:08X}h", self.0)
    }
}
