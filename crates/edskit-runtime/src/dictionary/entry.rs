//! One entry of an object dictionary, as it lies in flash.

use super::handle::{Key, Readable};
use edskit_types::{DataType, Index, SubIndex};

/// What is fixed about one entry: where it is, of what type, who may do what with it, and where its value lies.
///
/// The value lies in the constants of the [`Table`](crate::Table) or, where it can change, in the values of the
/// dictionary. A text (VISIBLE_STRING, OCTET_STRING, UNICODE_STRING) that can change takes two bytes more than its
/// capacity: its present length, low byte first. A DOMAIN lies nowhere; the [`Application`](crate::Application) has it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Entry {
    /// The index.
    pub index: Index,
    /// The sub-index; 00h for a VAR.
    pub sub_index: SubIndex,
    /// The data type.
    pub data_type: DataType,
    /// Rights and storage.
    pub flags: Flags,
    /// Where the value begins, in the constants or in the values.
    pub offset: u16,
    /// How many bytes the value has; the capacity for a text that can change.
    pub size: u16,
}

impl Entry {
    /// Its index and sub-index: what generated constants can be matched with.
    #[must_use]
    pub const fn key(&self) -> Key {
        Key { index: self.index, sub_index: self.sub_index }
    }

    /// Whether it is the entry of a handle.
    #[must_use]
    pub fn is(&self, handle: impl Readable) -> bool {
        self.key() == handle.entry_key()
    }

    /// The place of its handle among these, counted from 0.
    #[must_use]
    pub fn place_in(&self, handles: &[impl Readable]) -> Option<usize> {
        handles.iter().position(|handle| self.is(*handle))
    }

    /// An entry that no table holds: what a device tells of a value that it has itself
    /// ([`Application::find`](crate::Application::find)).
    ///
    /// `size` is its length in bytes; for texts and octets the most that it can have.
    #[must_use]
    pub const fn of_device(
        index: Index,
        sub_index: SubIndex,
        data_type: DataType,
        flags: Flags,
        size: u16,
    ) -> Self {
        Self { index, sub_index, data_type, flags, offset: 0, size }
    }

    /// Whether the value has its present length in front: a text that can change.
    pub(crate) const fn has_length(&self) -> bool {
        self.data_type.is_string() && self.flags.has(Flags::VARIABLE)
    }
}

/// Rights on an entry and how it is stored: a set of bits.
///
/// ```
/// use edskit_runtime::Flags;
///
/// let flags = Flags::READ.and(Flags::WRITE).and(Flags::VARIABLE);
/// assert!(flags.has(Flags::WRITE) && !flags.has(Flags::TPDO));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Flags(u16);

impl Flags {
    /// Nothing.
    pub const NONE: Self = Self(0);
    /// SDO clients may read it.
    pub const READ: Self = Self(1);
    /// SDO clients may write it.
    pub const WRITE: Self = Self(1 << 1);
    /// It may be mapped into a TPDO.
    pub const TPDO: Self = Self(1 << 2);
    /// It may be mapped into an RPDO.
    pub const RPDO: Self = Self(1 << 3);
    /// Its value can change, so it lies in the values and not in the constants.
    pub const VARIABLE: Self = Self(1 << 4);
    /// Its default holds an offset to which the node-ID is added (`$NODEID` in the EDS).
    pub const NODE_RELATIVE: Self = Self(1 << 5);
    /// It has an entry in the limits.
    pub const LIMITED: Self = Self(1 << 6);
    /// It exists only where the application says so.
    pub const OPTIONAL: Self = Self(1 << 7);
    /// The device is given its value at start, from one-time memory, say: no reset changes it.
    pub const GIVEN: Self = Self(1 << 15);

    const GROUP_SHIFT: u16 = 8;
    const GROUP_MASK: u16 = 0x7F;

    /// The flags of both.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether all of `other` are set.
    #[must_use]
    pub const fn has(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The same, stored in this group.
    #[must_use]
    pub const fn stored_in(self, group: StorageGroup) -> Self {
        let group = group.0 as u16 & Self::GROUP_MASK;
        Self(self.0 & !(Self::GROUP_MASK << Self::GROUP_SHIFT) | group << Self::GROUP_SHIFT)
    }

    /// The group in which the value is stored over power-off; `None` where it is not.
    #[must_use]
    pub const fn group(self) -> Option<StorageGroup> {
        match (self.0 >> Self::GROUP_SHIFT & Self::GROUP_MASK) as u8 {
            0 => None,
            group => Some(StorageGroup(group)),
        }
    }

    /// Whether a reset gives the value of power-on.
    pub(crate) const fn is_restored(self) -> bool {
        self.0 & (Self::VARIABLE.0 | Self::GIVEN.0) == Self::VARIABLE.0
    }
}

/// A group of values that are stored together: the sub-index of 1010h and 1011h that is theirs
/// (CiA 301 v4.2, 7.5.2.13). Sub-index 01h stands for all groups and is none itself.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct StorageGroup(
    /// The sub-index, 02h to 7Fh.
    pub u8,
);

impl StorageGroup {
    /// 02h: the communication parameters, 1000h to 1FFFh.
    pub const COMMUNICATION: Self = Self(2);
    /// 03h: the application parameters, 6000h to 9FFFh.
    pub const APPLICATION: Self = Self(3);
    /// 04h: the first group of the manufacturer.
    pub const MANUFACTURER: Self = Self(4);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_takes_twelve_bytes() {
        assert_eq!(size_of::<Entry>(), 12);
    }

    #[test]
    fn groups_and_rights_do_not_touch() {
        let flags = Flags::READ.and(Flags::OPTIONAL).stored_in(StorageGroup(0x7F));
        assert!(!flags.has(Flags::GIVEN) && flags.and(Flags::GIVEN).group() == Some(StorageGroup(0x7F)));
        assert_eq!(Flags::GIVEN.group(), None);
        assert_eq!(flags.group(), Some(StorageGroup(0x7F)));
        assert!(flags.has(Flags::READ.and(Flags::OPTIONAL)) && !flags.has(Flags::WRITE));
        assert_eq!(flags.stored_in(StorageGroup::COMMUNICATION).group(), Some(StorageGroup::COMMUNICATION));
        assert_eq!(Flags::NONE.group(), None);
    }
}
