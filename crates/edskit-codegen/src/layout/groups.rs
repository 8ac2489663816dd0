//! Which entries are stored over power-off, where the side-file says nothing.

use super::gather::Item;
use crate::SideFile;
use edskit_runtime::{Entry, Flags, StorageGroup};
use edskit_types::{AccessType, Index, MappingEntry, SubIndex};

/// Sub-index 01h of 1010h: all groups.
const ALL: SubIndex = SubIndex(1);

/// What the device can store at all.
pub(super) struct Groups {
    /// The sub-indices of 1010h from 01h on.
    saved: Vec<SubIndex>,
    /// What the RPDOs carry at power-on: process data, which nobody wants back after it.
    received: Vec<(Index, SubIndex)>,
}

impl Groups {
    pub(super) fn of(items: &[Item]) -> Self {
        let saved = items.iter().filter(|item| item.index == Index::STORE_PARAMETERS && item.sub_index.0 > 0);
        let mapped = items.iter().filter(|item| item.index.is_rpdo_mapping() && item.sub_index.0 > 0);
        let target = |item: &Item| {
            let bytes = item.default.as_ref()?.bytes.first_chunk()?;
            let entry = MappingEntry(u32::from_le_bytes(*bytes));
            Some((entry.index(), entry.sub_index()))
        };
        let mut received: Vec<_> = mapped.filter_map(target).collect();
        received.sort_unstable();
        Self { saved: saved.map(|item| item.sub_index).collect(), received }
    }

    /// The group of an entry.
    pub(super) fn group(&self, item: &Item, entry: &Entry, side_file: &SideFile) -> Option<StorageGroup> {
        if !entry.flags.has(Flags::VARIABLE) || entry.flags.has(Flags::GIVEN) {
            return None;
        }
        if let Some(said) = side_file.storage(item.index, item.sub_index) {
            return said;
        }
        if !item.access.is_writable() {
            return None;
        }
        let is_parameter = || {
            item.access == AccessType::Rw
                && self.received.binary_search(&(item.index, item.sub_index)).is_err()
        };
        let group = match item.index.0 {
            // Histories, commands, the time of day, and programs are no parameters.
            0x1003 | 0x1010 | 0x1011 | 0x1013 | 0x1023..=0x1026 | 0x1F50..=0x1F5F | 0x1F82 | 0x1F83 => None,
            0x1000..=0x1FFF => Some(StorageGroup::COMMUNICATION),
            0x2000..=0x5FFF if is_parameter() => Some(StorageGroup::MANUFACTURER),
            0x6000..=0x9FFF if is_parameter() => Some(StorageGroup::APPLICATION),
            _ => None,
        };
        group.filter(|group| self.saved.contains(&SubIndex(group.0)) || self.saved == [ALL])
    }
}
