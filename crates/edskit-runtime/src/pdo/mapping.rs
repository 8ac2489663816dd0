//! Which values a PDO carries.

use super::{MOST_ENTRIES, Place};
use crate::Application;
use crate::Entry;
use crate::context::Context;
use crate::dictionary::{Flags, Position, unsigned};
use edskit_types::{AbortCode, DataType, Index, MappingEntry, PdoDirection, SubIndex};

/// The most bits of a PDO.
pub(super) const MOST_BITS: u8 = 64;

/// One value in a PDO: the entry, found once when the mapping is made, and its bits.
#[derive(Clone, Copy, Debug)]
pub struct Mapped {
    source: Source,
    bits: u8,
}

/// Where a mapped value is.
#[derive(Clone, Copy, Debug)]
enum Source {
    /// Nowhere: a dummy, which only fills a gap.
    Dummy,
    Dictionary(Position),
    /// With the device, at this place.
    Device(Index, SubIndex),
}

impl Mapped {
    /// A place for a value.
    pub const NEW: Self = Self { source: Source::Dummy, bits: 0 };

    /// The entry of the dictionary.
    pub(crate) fn position(self) -> Option<Position> {
        match self.source {
            Source::Dictionary(position) => Some(position),
            _ => None,
        }
    }
}

/// Where the mapping of a PDO lies among all mapped values of the node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slots {
    /// The first place.
    pub(super) first: u16,
    /// How many places there are.
    pub(super) capacity: u8,
    /// How many are in use.
    pub(super) count: u8,
    /// The bits of all of them.
    pub(super) bits: u8,
}

impl Slots {
    pub(super) const NONE: Self = Self { first: 0, capacity: 0, count: 0, bits: 0 };

    /// The values that are mapped.
    pub(super) fn of(self, mapped: &[Mapped]) -> &[Mapped] {
        let first = usize::from(self.first);
        mapped.get(first..first + usize::from(self.count)).unwrap_or_default()
    }

    /// A bit for each value: those of the PDO are among those whose bits are set.
    pub(super) fn carries(self, mapped: &[Mapped]) -> u32 {
        let positions = self.of(mapped).iter().filter_map(|value| value.position());
        positions.fold(0, |bits, position| bits | bit_of(position))
    }

    /// How many data bytes the PDO has.
    pub(super) fn bytes(self) -> usize {
        usize::from(self.bits.div_ceil(8))
    }
}

/// The bit that stands for an entry, among others that share it.
pub(super) fn bit_of(position: Position) -> u32 {
    1 << (position.0 % 32)
}

/// The lowest `bits` bits, 1 to 64: no mapped value has fewer, and no PDO more, so nothing is shifted too far.
fn mask(bits: u8) -> u64 {
    u64::MAX.wrapping_shr(u32::from(MOST_BITS.wrapping_sub(bits)))
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// The data of a PDO: the present values one behind the other, the first one in the lowest bits.
    pub(super) fn gather_values(&mut self, slots: Slots) -> u64 {
        let mut data = 0;
        let mut offset = 0;
        for place in 0..slots.count {
            let place = usize::from(slots.first) + usize::from(place);
            let Some(value) = self.node.mapped.get(place).copied() else { continue };
            let bits = match value.source {
                Source::Dictionary(position) => unsigned(self.node.objects.bytes(position)),
                Source::Device(index, sub_index) => self.value_of_device(index, sub_index),
                Source::Dummy => 0,
            };
            data |= (bits & mask(value.bits)).wrapping_shl(offset);
            offset += u32::from(value.bits);
        }
        data
    }

    /// The present value of an entry that the device has itself.
    #[inline(never)]
    fn value_of_device(&mut self, index: Index, sub_index: SubIndex) -> u64 {
        let mut buffer = [0; 8];
        let read = match self.open(index, sub_index) {
            Ok((_, entry)) => self.app.read_value(&mut self.node, &entry, &mut buffer),
            Err(code) => Err(code),
        };
        // A PDO goes on whatever becomes of one of its values.
        buffer.get(..read.unwrap_or(0)).map_or(0, unsigned)
    }

    /// Puts the data of the RPDO with this number from 1 into the dictionary, by the rules that hold for clients: limits,
    /// those of the communication profile, and those of the device. A value that is refused is left out and told.
    pub(super) fn scatter(&mut self, number: u16, slots: Slots, mut data: u64) {
        for place in 0..slots.count {
            let place = usize::from(slots.first) + usize::from(place);
            let Some(value) = self.node.mapped.get(place).copied() else { continue };
            let bits = data & mask(value.bits);
            data = data.wrapping_shr(value.bits.into());
            let (position, entry) = match value.source {
                Source::Dummy => continue,
                Source::Dictionary(position) => match self.node.objects.table.entry(position) {
                    Some(entry) => (position, *entry),
                    None => continue,
                },
                Source::Device(index, sub_index) => match self.open(index, sub_index) {
                    Ok(found) => found,
                    Err(code) => {
                        let size = value.bits.div_ceil(8).into();
                        let data_type = DataType::OctetString;
                        let entry = Entry::of_device(index, sub_index, data_type, Flags::RPDO, size);
                        self.value_refused(number, &entry, code);
                        continue;
                    }
                },
            };
            let entry = &entry;
            let bytes = bits.to_le_bytes();
            let size = usize::from(value.bits.div_ceil(8));
            let bytes = bytes.get(..size).unwrap_or_default();
            if let Err(code) = self.bring(position, entry, bytes) {
                self.value_refused(number, entry, code);
            }
        }
    }

    fn value_refused(&mut self, number: u16, entry: &Entry, code: AbortCode) {
        self.node.core.refused_values = self.node.core.refused_values.saturating_add(1);
        self.app.rpdo_value_refused(&mut self.node, number, entry, code);
    }

    /// Whether a mapping entry can be carried in a direction, and what it stands for.
    pub(super) fn check_entry(
        &mut self,
        direction: PdoDirection,
        mapping: MappingEntry,
    ) -> Result<Mapped, AbortCode> {
        let bits = mapping.bits();
        let granularity = self.node.core.settings.granularity;
        if granularity > 1 && !bits.is_multiple_of(granularity) {
            return Err(AbortCode::NOT_MAPPABLE);
        }
        if mapping.is_dummy() {
            return self.check_dummy(direction, mapping);
        }
        let (position, entry) = self.open(mapping.index(), mapping.sub_index())?;
        let right = match direction {
            PdoDirection::Receive => Flags::RPDO,
            PdoDirection::Transmit => Flags::TPDO,
        };
        if !entry.flags.has(right) {
            return Err(AbortCode::NOT_MAPPABLE);
        }
        if !may_have(&entry, bits) {
            return Err(AbortCode::LENGTH_MISMATCH);
        }
        let source = match position {
            Position::OF_DEVICE => Source::Device(entry.index, entry.sub_index),
            position => Source::Dictionary(position),
        };
        Ok(Mapped { source, bits })
    }

    /// A dummy fills a gap of an RPDO with a data type that the device allows for that.
    fn check_dummy(&self, direction: PdoDirection, mapping: MappingEntry) -> Result<Mapped, AbortCode> {
        let index = mapping.index();
        let is_allowed =
            self.node.objects.table.dummies.checked_shr(index.0.into()).is_some_and(|bit| bit & 1 == 1);
        let length = DataType::from_index(index).and_then(DataType::bits);
        if direction == PdoDirection::Transmit || !is_allowed || mapping.sub_index().0 != 0 {
            return Err(AbortCode::NOT_MAPPABLE);
        }
        if length != Some(mapping.bits().into()) {
            return Err(AbortCode::LENGTH_MISMATCH);
        }
        Ok(Mapped { source: Source::Dummy, bits: mapping.bits() })
    }

    /// Whether an entry exists in the present configuration.
    pub(crate) fn exists(&mut self, entry: &Entry) -> bool {
        !entry.flags.has(Flags::OPTIONAL) || self.app.is_present(&self.node, entry)
    }

    /// What the first `count` entries of a mapping parameter make up; with `takes` each gets its place.
    ///
    /// # Errors
    /// What is wrong with one of them, or [`AbortCode::PDO_LENGTH_EXCEEDED`] where there are more than the PDO has places
    /// for, or more than 64 bits.
    pub(super) fn map(
        &mut self,
        place: Place,
        slots: Slots,
        count: u8,
        takes: bool,
    ) -> Result<Slots, AbortCode> {
        if count > slots.capacity || count > MOST_ENTRIES {
            return Err(AbortCode::PDO_LENGTH_EXCEEDED);
        }
        let mut bits: u8 = 0;
        for number in 0..count {
            let entry = self.node.objects.value(place.mapping(), number + 1).map(MappingEntry);
            let entry = entry.ok_or(AbortCode::SUB_INDEX_DOES_NOT_EXIST)?;
            let mapped = self.check_entry(place.direction, entry)?;
            bits = bits.saturating_add(mapped.bits);
            if bits > MOST_BITS {
                return Err(AbortCode::PDO_LENGTH_EXCEEDED);
            }
            let slot = self.node.mapped.get_mut(usize::from(slots.first) + usize::from(number));
            if let Some(slot) = slot.filter(|_| takes) {
                *slot = mapped;
            }
        }
        Ok(Slots { count, bits, ..slots })
    }
}

/// Whether an entry can be mapped with so many bits: the length of its type; of a text any number of whole bytes.
fn may_have(entry: &Entry, bits: u8) -> bool {
    match entry.data_type {
        DataType::Boolean => bits == 1 || bits == 8,
        data_type if data_type.is_string() => {
            bits > 0 && bits.is_multiple_of(8) && u16::from(bits / 8) <= entry.size && bits <= MOST_BITS
        }
        data_type => data_type.bits() == Some(bits.into()) && bits <= MOST_BITS,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks() {
        assert_eq!([mask(1), mask(8), mask(63), mask(64)], [1, 0xFF, u64::MAX >> 1, u64::MAX]);
    }
}
