//! Storing parameters over power-off: 1010h, 1011h, and what LSS configures.

use crate::context::Context;
use crate::crc::Crc;
use crate::dictionary::{Entry, Flags, Position, StorageGroup, Table};
use crate::emcy::Error;
use edskit_types::{AbortCode, Index, SubIndex};

/// Memory that keeps its content without power. It holds one record for each group of values.
///
/// A record is written by [`begin`](Storage::begin), any number of [`write`](Storage::write) and one
/// [`commit`](Storage::commit). Until the commit the old record should stay; where power fails in between or the memory
/// tears the record, its checksum tells, and the defaults are used.
pub trait Storage {
    /// Reads from a record into `buffer` and says how many bytes; 0 at its end, or where there is none.
    ///
    /// # Errors
    /// [`StorageError`] if the memory does not answer.
    fn read(&mut self, record: Record, offset: u32, buffer: &mut [u8]) -> Result<usize, StorageError>;

    /// Begins a new record.
    ///
    /// # Errors
    /// [`StorageError`] if it cannot be written.
    fn begin(&mut self, record: Record) -> Result<(), StorageError>;

    /// Appends to the record that was begun.
    ///
    /// # Errors
    /// [`StorageError`] if it cannot be written.
    fn write(&mut self, record: Record, data: &[u8]) -> Result<(), StorageError>;

    /// Puts the new record in the place of the old one.
    ///
    /// # Errors
    /// [`StorageError`] if it cannot be written.
    fn commit(&mut self, record: Record) -> Result<(), StorageError>;

    /// Removes a record.
    ///
    /// # Errors
    /// [`StorageError`] if that fails.
    fn erase(&mut self, record: Record) -> Result<(), StorageError>;
}

impl<T: Storage + ?Sized> Storage for &mut T {
    fn read(&mut self, record: Record, offset: u32, buffer: &mut [u8]) -> Result<usize, StorageError> {
        (**self).read(record, offset, buffer)
    }

    fn begin(&mut self, record: Record) -> Result<(), StorageError> {
        (**self).begin(record)
    }

    fn write(&mut self, record: Record, data: &[u8]) -> Result<(), StorageError> {
        (**self).write(record, data)
    }

    fn commit(&mut self, record: Record) -> Result<(), StorageError> {
        (**self).commit(record)
    }

    fn erase(&mut self, record: Record) -> Result<(), StorageError> {
        (**self).erase(record)
    }
}

/// The memory did not do what it should.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct StorageError;

/// What a record holds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Record {
    /// What LSS has configured: node-ID and bit rate.
    Lss,
    /// The values of a group.
    Values(StorageGroup),
    /// What a device keeps besides its dictionary, by a number of its own. The node knows nothing of it.
    Device(u8),
}

/// A device without such memory: nothing is ever stored, and saving fails.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct NoStorage;

impl Storage for NoStorage {
    fn read(&mut self, _: Record, _: u32, _: &mut [u8]) -> Result<usize, StorageError> {
        Ok(0)
    }

    fn begin(&mut self, _: Record) -> Result<(), StorageError> {
        Err(StorageError)
    }

    fn write(&mut self, _: Record, _: &[u8]) -> Result<(), StorageError> {
        Err(StorageError)
    }

    fn commit(&mut self, _: Record) -> Result<(), StorageError> {
        Err(StorageError)
    }

    fn erase(&mut self, _: Record) -> Result<(), StorageError> {
        Ok(())
    }
}

/// "save", as 1010h wants it.
const SAVE: [u8; 4] = *b"save";
/// "load", as 1011h wants it.
const LOAD: [u8; 4] = *b"load";
/// Sub-index 01h: all groups.
const ALL_GROUPS: u8 = 1;

/// A record begins with this, then the fingerprint of the dictionary and the length of what follows, and ends with a
/// checksum over all of that.
const MAGIC: [u8; 4] = *b"EDS1";
const HEADER: usize = 12;
/// Before each value: its index, sub-index and length.
const HEAD: usize = 5;
/// How much is read at once.
const CHUNK: usize = 16;

impl Context<'_> {
    /// 1010h is written: stores a group, or all.
    pub(crate) fn store_parameters(&mut self, sub_index: SubIndex, data: &[u8]) -> Result<(), AbortCode> {
        if data != SAVE {
            return Err(AbortCode::CANNOT_TRANSFER);
        }
        self.for_groups(sub_index, true)
    }

    /// 1011h is written: forgets what is stored of a group, or all. The values change with the next reset.
    pub(crate) fn restore_parameters(&mut self, sub_index: SubIndex, data: &[u8]) -> Result<(), AbortCode> {
        if data != LOAD {
            return Err(AbortCode::CANNOT_TRANSFER);
        }
        self.for_groups(sub_index, false)
    }

    /// Saves the groups that a sub-index of 1010h or 1011h stands for, or forgets what is stored of them.
    fn for_groups(&mut self, sub_index: SubIndex, saves: bool) -> Result<(), AbortCode> {
        for group in groups(self.objects.table) {
            if ![ALL_GROUPS, group.0].contains(&sub_index.0) {
                continue;
            }
            let done = if saves { self.save_group(group) } else { self.storage.erase(Record::Values(group)) };
            done.map_err(|StorageError| AbortCode::HARDWARE_ERROR)?;
        }
        Ok(())
    }

    fn save_group(&mut self, group: StorageGroup) -> Result<(), StorageError> {
        let record = Record::Values(group);
        let table = self.objects.table;
        let length = |(position, _)| HEAD + self.objects.bytes(position).len();
        let length = members(table, group).map(length).sum::<usize>() as u32;
        let mut writer = Writer { storage: self.storage, record, crc: Crc::new() };
        writer.storage.begin(record)?;
        for part in [MAGIC, table.fingerprint.to_le_bytes(), length.to_le_bytes()] {
            writer.write(&part)?;
        }
        for (position, entry) in members(table, group) {
            let bytes = self.objects.bytes(position);
            let [index_low, index_high] = entry.index.0.to_le_bytes();
            let [size_low, size_high] = (bytes.len() as u16).to_le_bytes();
            writer.write(&[index_low, index_high, entry.sub_index.0, size_low, size_high])?;
            writer.write(bytes)?;
        }
        let crc = writer.crc.value().to_le_bytes();
        writer.storage.write(record, &crc)?;
        writer.storage.commit(record)
    }

    /// Loads the stored values of the groups that `is_chosen` chooses entries of, over the defaults. What is torn or
    /// belongs to another dictionary is left, and that is an error of the device.
    pub(crate) fn load_parameters(&mut self, is_chosen: impl Fn(&Entry) -> bool) {
        for group in groups(self.objects.table) {
            match self.check_record(Record::Values(group)) {
                Ok(Some(length)) => self.load_group(group, length, &is_chosen),
                Ok(None) => {}
                Err(StorageError) => {
                    self.raise(Error::LOST_PARAMETERS, u16::from(group.0), [group.0, 0, 0, 0, 0])
                }
            }
        }
    }

    /// The length of the values in a record; `None` where there is no record.
    fn check_record(&mut self, record: Record) -> Result<Option<u32>, StorageError> {
        let mut reader = Reader::new(self.storage, record);
        let mut crc = Crc::new();
        let mut header = [0; HEADER];
        match reader.read(&mut header)? {
            0 => return Ok(None),
            HEADER => crc.update(&header),
            _ => return Err(StorageError),
        }
        let [m0, m1, m2, m3, f0, f1, f2, f3, l0, l1, l2, l3] = header;
        let fingerprint = u32::from_le_bytes([f0, f1, f2, f3]);
        if [m0, m1, m2, m3] != MAGIC || fingerprint != self.objects.table.fingerprint {
            return Err(StorageError);
        }
        let length = u32::from_le_bytes([l0, l1, l2, l3]);
        let mut left = length;
        while left > 0 {
            let mut chunk = [0; CHUNK];
            let wanted = chunk.get_mut(..left.min(CHUNK as u32) as usize).unwrap_or_default();
            if reader.read(wanted)? < wanted.len() {
                return Err(StorageError);
            }
            crc.update(wanted);
            left -= wanted.len() as u32;
        }
        let mut stored = [0; 2];
        let is_right = reader.read(&mut stored)? == 2 && u16::from_le_bytes(stored) == crc.value();
        if is_right { Ok(Some(length)) } else { Err(StorageError) }
    }

    /// Takes over the values of a record that has been checked.
    fn load_group(&mut self, group: StorageGroup, length: u32, is_chosen: &impl Fn(&Entry) -> bool) {
        let mut offset = HEADER as u32;
        let end = offset + length;
        while offset < end {
            let mut reader = Reader { storage: self.storage, record: Record::Values(group), offset };
            let mut head = [0; HEAD];
            if reader.read(&mut head) != Ok(HEAD) {
                return;
            }
            let [index_low, index_high, sub_index, size_low, size_high] = head;
            let index = Index(u16::from_le_bytes([index_low, index_high]));
            let size = u16::from_le_bytes([size_low, size_high]);
            let position = self.objects.table.find(index, SubIndex(sub_index)).ok();
            let entry = position.and_then(|position| Some((position, self.objects.table.entry(position)?)));
            if let Some((position, entry)) = entry.filter(|(_, entry)| is_chosen(entry)) {
                let start = usize::from(entry.offset) + if entry.has_length() { 2 } else { 0 };
                let fits = size == entry.size || (entry.has_length() && size < entry.size);
                let place = self.objects.values.get_mut(start..start + usize::from(size)).filter(|_| fits);
                if let Some(place) = place {
                    let _ = reader.read(place);
                    self.objects.set_length(position, size);
                }
            }
            offset += HEAD as u32 + u32::from(size);
        }
    }
}

/// The groups that have members, in ascending order.
fn groups<'a>(table: &Table<'a>) -> impl Iterator<Item = StorageGroup> + use<'a> {
    let entries = table.entries;
    let next = move |last: &StorageGroup| next_group(entries, *last);
    core::iter::successors(next_group(entries, StorageGroup(0)), next)
}

/// The lowest group above `last` that has a member.
#[inline(never)]
fn next_group(entries: &[Entry], last: StorageGroup) -> Option<StorageGroup> {
    let variable = entries.iter().filter(|entry| entry.flags.has(Flags::VARIABLE));
    variable.filter_map(|entry| entry.flags.group()).filter(|group| *group > last).min()
}

/// The entries of a group with their positions.
fn members<'a>(
    table: &Table<'a>,
    group: StorageGroup,
) -> impl Iterator<Item = (Position, &'a Entry)> + Clone + use<'a> {
    let is_member = move |flags: Flags| flags.has(Flags::VARIABLE) && flags.group() == Some(group);
    table.all().filter(move |(_, entry)| is_member(entry.flags))
}

struct Writer<'a> {
    storage: &'a mut dyn Storage,
    record: Record,
    crc: Crc,
}

impl Writer<'_> {
    fn write(&mut self, data: &[u8]) -> Result<(), StorageError> {
        self.crc.update(data);
        self.storage.write(self.record, data)
    }
}

pub(crate) struct Reader<'a> {
    storage: &'a mut dyn Storage,
    record: Record,
    offset: u32,
}

impl<'a> Reader<'a> {
    /// Reads a record from its beginning.
    pub(crate) fn new(storage: &'a mut dyn Storage, record: Record) -> Self {
        Self { storage, record, offset: 0 }
    }

    /// Fills the buffer as far as the record goes.
    pub(crate) fn read(&mut self, buffer: &mut [u8]) -> Result<usize, StorageError> {
        let mut done = 0;
        while let Some(rest) = buffer.get_mut(done..).filter(|rest| !rest.is_empty()) {
            match self.storage.read(self.record, self.offset, rest)? {
                0 => break,
                count => {
                    let count = count.min(rest.len());
                    done += count;
                    self.offset += count as u32;
                }
            }
        }
        Ok(done)
    }
}
