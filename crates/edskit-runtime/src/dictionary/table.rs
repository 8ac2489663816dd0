//! What is fixed about a dictionary, and finding an entry in it.

use super::entry::Entry;
use edskit_types::{AbortCode, Index, SubIndex};

/// The fixed part of an object dictionary: on a device in flash.
#[derive(Clone, Copy, Debug)]
pub struct Table<'a> {
    /// Every entry, in ascending order of index and sub-index.
    pub entries: &'a [Entry],
    /// The values that cannot change.
    pub constants: &'a [u8],
    /// What the values are at power-on, as long as the values.
    pub defaults: &'a [u8],
    /// The limits of entries with [`Flags::LIMITED`](crate::Flags::LIMITED), in ascending order of position.
    pub limits: &'a [Limits],
    /// Which data types may fill gaps of RPDOs: bit i stands for the type at index i (`[DummyUsage]` of the EDS).
    pub dummies: u32,
    /// A number that differs between dictionaries of different structure: values that another one has stored are looked
    /// through for what an update has moved.
    pub fingerprint: u32,
}

/// The limits of one entry. The bits are those of the value, sign-extended for signed integers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Limits {
    /// The entry.
    pub position: Position,
    /// The lowest value; the lowest of the data type where the EDS names none.
    pub low: u64,
    /// The highest value; the highest of the data type where the EDS names none.
    pub high: u64,
}

/// The position of an entry in a [`Table`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Position(
    /// Counted from 0.
    pub u16,
);

impl Position {
    /// That of an entry which the device has and no table ([`Application::find`](crate::Application::find)).
    pub(crate) const OF_DEVICE: Self = Self(u16::MAX);
}

impl<'a> Table<'a> {
    /// The position of the entry at `index` and `sub_index`.
    ///
    /// # Errors
    /// [`AbortCode::OBJECT_DOES_NOT_EXIST`] if there is no entry at the index, and
    /// [`AbortCode::SUB_INDEX_DOES_NOT_EXIST`] if there is none at the sub-index.
    pub fn find(&self, index: Index, sub_index: SubIndex) -> Result<Position, AbortCode> {
        let first = self.first_of(index);
        let object = self.entries.get(first..).unwrap_or_default();
        // Sub-indices mostly come without a gap, so the entry is as far behind the first one as its sub-index says.
        let guess = usize::from(sub_index.0);
        let is_it = |entry: &Entry| entry.index == index && entry.sub_index == sub_index;
        if object.get(guess).is_some_and(is_it) {
            return Ok(Position((first + guess) as u16));
        }
        match object.iter().take_while(|entry| entry.index == index).position(is_it) {
            Some(offset) => Ok(Position((first + offset) as u16)),
            None if object.first().is_some_and(|entry| entry.index == index) => {
                Err(AbortCode::SUB_INDEX_DOES_NOT_EXIST)
            }
            None => Err(AbortCode::OBJECT_DOES_NOT_EXIST),
        }
    }

    /// The entry at a position.
    #[must_use]
    pub fn entry(&self, position: Position) -> Option<&'a Entry> {
        self.entries.get(usize::from(position.0))
    }

    /// The entries of an object with their positions, in ascending order of sub-index.
    pub fn entries_of(&self, index: Index) -> impl Iterator<Item = (Position, &'a Entry)> + Clone + use<'a> {
        self.entries_from(index).take_while(move |(_, entry)| entry.index == index)
    }

    /// The entries from an index on with their positions.
    pub(crate) fn entries_from(
        &self,
        index: Index,
    ) -> impl Iterator<Item = (Position, &'a Entry)> + Clone + use<'a> {
        let first = self.first_of(index);
        let entries = self.entries.get(first..).unwrap_or_default();
        entries.iter().enumerate().map(move |(offset, entry)| (Position((first + offset) as u16), entry))
    }

    /// The place of the first entry whose index is not lower.
    #[inline(never)]
    fn first_of(&self, index: Index) -> usize {
        self.entries.partition_point(|entry| entry.index < index)
    }

    /// Every entry with its position.
    pub fn all(&self) -> impl Iterator<Item = (Position, &'a Entry)> + Clone + use<'a> {
        self.entries.iter().enumerate().map(|(position, entry)| (Position(position as u16), entry))
    }

    /// The limits of an entry.
    #[must_use]
    pub fn limits(&self, position: Position) -> Option<&'a Limits> {
        let place = self.limits.binary_search_by_key(&position, |limits| limits.position).ok()?;
        self.limits.get(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dictionary::{Flags, testing::entry, testing::table};
    use proptest::prelude::*;
    use std::collections::BTreeSet;
    use std::vec::Vec;

    #[test]
    fn what_is_missing_says_so() {
        let entries = [entry(0x1000, 0), entry(0x1018, 0), entry(0x1018, 1), entry(0x1018, 4)];
        let table = table(&entries);
        let find = |index, sub_index| table.find(Index(index), SubIndex(sub_index));
        assert_eq!(find(0x1018, 4), Ok(Position(3)));
        assert_eq!(find(0x1000, 0), Ok(Position(0)));
        for (index, sub_index) in [(0x1000, 1), (0x1018, 2), (0x1018, 0xFF)] {
            assert_eq!(find(index, sub_index), Err(AbortCode::SUB_INDEX_DOES_NOT_EXIST));
        }
        for index in [0, 0x0FFF, 0x1001, 0xFFFF] {
            assert_eq!(find(index, 0), Err(AbortCode::OBJECT_DOES_NOT_EXIST));
        }
        let of = |index| table.entries_of(Index(index)).count();
        assert_eq!([of(0x1000), of(0x1018), of(0x1001)], [1, 3, 0]);
    }

    proptest! {
        #[test]
        fn every_entry_is_found_where_it_is(
            runs in proptest::collection::vec((any::<u16>(), any::<u8>(), 0..300_u16), 0..5),
            others in proptest::collection::vec((any::<u16>(), any::<u8>()), 0..40),
        ) {
            let runs = runs.into_iter().flat_map(|(first, sub_index, count)| {
                (first..first.saturating_add(count)).map(move |index| (index, sub_index))
            });
            let places: BTreeSet<(u16, u8)> = runs.chain(others.iter().copied()).collect();
            let entries: Vec<Entry> = places.iter().map(|(index, sub_index)| entry(*index, *sub_index)).collect();
            let table = table(&entries);
            for (place, entry) in entries.iter().enumerate() {
                prop_assert_eq!(table.find(entry.index, entry.sub_index), Ok(Position(place as u16)));
            }
            for (index, sub_index) in others {
                let index = index.wrapping_add(1);
                let place = places.iter().position(|place| *place == (index, sub_index));
                let found = table.find(Index(index), SubIndex(sub_index)).ok();
                prop_assert_eq!(found, place.map(|place| Position(place as u16)));
            }
        }
    }

    #[test]
    fn limits_are_found_by_position() {
        let entries = [entry(0x1000, 0); 5];
        let limits = [1, 3].map(|position| Limits { position: Position(position), low: 0, high: 9 });
        let table = Table { limits: &limits, ..table(&entries) };
        let found = [0, 1, 2, 3, 4].map(|position| table.limits(Position(position)).is_some());
        assert_eq!(found, [false, true, false, true, false]);
        assert!(!Flags::NONE.has(Flags::LIMITED));
    }
}
