//! Storing parameters over power-off: 1010h and 1011h.

use crate::Application;
use crate::access::is_communication;
use crate::context::Context;
use crate::crc::Crc;
use crate::dictionary::{Entry, Flags, Position, StorageGroup, Table};
use crate::emcy::EmcyError;
use crate::records::{Reader, Record, StorageError, Writer};
use crate::services::Services;
use edskit_types::{AbortCode, Index, SubIndex};

/// Sub-index 01h: all groups.
const ALL_GROUPS: u8 = 1;
/// The highest group that there can be.
const LAST_GROUP: u8 = 0x7F;

/// A record begins with this, then the fingerprint of the dictionary and the length of what follows, and ends with a
/// checksum over all of that.
const MAGIC: [u8; 4] = *b"EDS2";
const HEADER: usize = 12;
/// Before each value: its index, sub-index and length.
const HEAD: usize = 5;
/// In the length: the value is an offset to the node-ID, since it was the default, which follows the node-ID. So a value
/// that is stored has less than 32 KiB.
const RELATIVE: u16 = 1 << 15;
/// How much is read at once.
const CHUNK: usize = 16;

impl Services<'_> {
    /// Saves a group of values, as 1010h does: for manuals that save on other occasions.
    ///
    /// # Errors
    /// [`StorageError`] if the memory does not take them; what was stored before then stays.
    pub fn save(&mut self, group: StorageGroup) -> Result<(), StorageError> {
        self.save_group(group)?;
        self.clear(EmcyError::LOST_PARAMETERS, group.0.into());
        Ok(())
    }

    /// Forgets what is stored of a group of values, as 1011h does: they change with the next reset.
    ///
    /// # Errors
    /// [`StorageError`] if the memory fails.
    pub fn forget(&mut self, group: StorageGroup) -> Result<(), StorageError> {
        self.storage.erase(Record::Values(group))?;
        self.clear(EmcyError::LOST_PARAMETERS, group.0.into());
        Ok(())
    }

    fn save_group(&mut self, group: StorageGroup) -> Result<(), StorageError> {
        let record = Record::Values(group);
        let table = self.objects.table;
        // Values from 2000h on that follow the node-ID have that of the last reset of the node.
        let (own, own_of_reset) = (self.core.node_id, self.core.node_id_of_reset);
        let node_id_in = |index| if is_communication(index) { own } else { own_of_reset };
        let length = |(position, _)| HEAD + self.objects.bytes(position).len();
        let length = members(table, group).map(length).sum::<usize>() as u32;
        let mut writer = Writer { storage: self.storage, record, crc: Crc::new() };
        writer.storage.begin(record)?;
        for part in [MAGIC, table.fingerprint.to_le_bytes(), length.to_le_bytes()] {
            writer.write(&part)?;
        }
        for (position, entry) in members(table, group) {
            let own = self.objects.node_relative(position, entry, node_id_in(entry.index));
            let bytes = own.unwrap_or(self.objects.bytes(position));
            let size = bytes.len() as u16;
            if size & RELATIVE != 0 {
                return Err(StorageError);
            }
            let [index_low, index_high] = entry.index.0.to_le_bytes();
            let [size_low, size_high] = (size | if own.is_some() { RELATIVE } else { 0 }).to_le_bytes();
            writer.write(&[index_low, index_high, entry.sub_index.0, size_low, size_high])?;
            writer.write(bytes)?;
        }
        let crc = writer.crc.value().to_le_bytes();
        writer.storage.write(record, &crc)?;
        writer.storage.commit(record)
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// 1010h is written: saves the groups that the sub-index stands for. Or 1011h is: forgets what is stored of them; the
    /// values change with the next reset. Either way nothing of them is lost any more.
    pub(crate) fn do_command(&mut self, entry: &Entry) -> Result<(), AbortCode> {
        if !self.app.storage_command(&mut self.node, entry)? {
            return Ok(());
        }
        for group in groups(self.node.objects.table) {
            if ![ALL_GROUPS, group.0].contains(&entry.sub_index.0) {
                continue;
            }
            let saves = entry.index == Index::STORE_PARAMETERS;
            let done = if saves { self.node.save(group) } else { self.node.forget(group) };
            if done.is_err() {
                self.app.storage_failed(&mut self.node, Record::Values(group));
                return Err(AbortCode::HARDWARE_ERROR);
            }
        }
        Ok(())
    }

    /// Loads the stored values of the entries that `is_chosen` chooses over the defaults. What is torn or has no place in
    /// this dictionary is left.
    pub(crate) fn load_parameters(&mut self, is_chosen: impl Fn(Index) -> bool) {
        // Values that an update has moved to another group come first: what is stored in their own group is newer.
        for wants_moved in [true, false] {
            for group in StorageGroup::COMMUNICATION.0..=LAST_GROUP {
                let group = StorageGroup(group);
                let loaded = match self.check_record(Record::Values(group), wants_moved) {
                    Ok(Some(length)) => self.load_group(group, length, wants_moved, &is_chosen),
                    Ok(None) => Ok(()),
                    Err(StorageError) => Err([0; 4]),
                };
                if let Err([a, b, c, d]) = loaded {
                    self.app.storage_failed(&mut self.node, Record::Values(group));
                    self.raise(EmcyError::LOST_PARAMETERS, u16::from(group.0), [group.0, a, b, c, d]);
                }
            }
        }
    }

    /// The length of the values in a record; `None` where there is no record, or only one of another dictionary is wanted.
    fn check_record(&mut self, record: Record, wants_other: bool) -> Result<Option<u32>, StorageError> {
        let mut reader = Reader::new(self.node.storage, record);
        let mut crc = Crc::new();
        let mut header = [0; HEADER];
        match reader.read(&mut header)? {
            0 => return Ok(None),
            HEADER => crc.update(&header),
            _ => return Err(StorageError),
        }
        let [m0, m1, m2, m3, f0, f1, f2, f3, l0, l1, l2, l3] = header;
        if [m0, m1, m2, m3] != MAGIC {
            return Err(StorageError);
        }
        if wants_other && u32::from_le_bytes([f0, f1, f2, f3]) == self.node.objects.table.fingerprint {
            return Ok(None);
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

    /// Takes over the values of a record that has been checked, one by one, since an update may have changed the
    /// dictionary. The application is told each that has no place any more.
    ///
    /// # Errors
    /// The place of the first value that was lost: its entry is there and is stored, but cannot have it.
    fn load_group(
        &mut self,
        group: StorageGroup,
        length: u32,
        wants_moved: bool,
        is_chosen: &impl Fn(Index) -> bool,
    ) -> Result<(), [u8; 4]> {
        let mut offset = HEADER as u32;
        let end = offset.saturating_add(length);
        let mut loaded = Ok(());
        while offset < end {
            let mut reader = Reader { storage: self.node.storage, record: Record::Values(group), offset };
            let mut head = [0; HEAD];
            if reader.read(&mut head) != Ok(HEAD) {
                return Err([0; 4]);
            }
            let [index_low, index_high, sub_index, size_low, size_high] = head;
            let (index, sub_index) =
                (Index(u16::from_le_bytes([index_low, index_high])), SubIndex(sub_index));
            let size = u16::from_le_bytes([size_low, size_high]);
            let start = reader.offset;
            offset = start + u32::from(size & !RELATIVE);
            if !is_chosen(index) {
                continue;
            }
            let found = self.node.objects.table.find(index, sub_index).ok();
            let entry = found.and_then(|position| Some((position, self.node.objects.table.entry(position)?)));
            let stored = entry.filter(|(_, entry)| is_stored(entry));
            let has_moved = stored.is_some_and(|(_, entry)| entry.flags.group() != Some(group));
            if has_moved != wants_moved {
                continue;
            }
            let is_taken = match stored {
                Some((position, entry)) => self.load_value(group, start, position, entry, size),
                None => false,
            };
            if !is_taken {
                self.app.stored_value_dropped(&mut self.node, index, sub_index);
            }
            if !is_taken && stored.is_some() && loaded.is_ok() {
                loaded = Err([index_low, index_high, sub_index.0, 0]);
            }
        }
        loaded
    }

    /// Takes over a stored value; false where it does not fit, or is one that a client could not write.
    fn load_value(
        &mut self,
        group: StorageGroup,
        offset: u32,
        position: Position,
        entry: &Entry,
        size: u16,
    ) -> bool {
        let (is_relative, size) = (size & RELATIVE != 0, size & !RELATIVE);
        if size != entry.size && (!entry.has_length() || size > entry.size) {
            return false;
        }
        self.node.objects.set_length(position, size);
        let mut reader = Reader { storage: self.node.storage, record: Record::Values(group), offset };
        let mut is_right = reader.read(self.node.objects.bytes_of(entry)) == Ok(size.into());
        if is_relative {
            self.node.objects.add_node_id(position, self.node.core.node_id);
        }
        // What follows the node-ID is not known without one.
        let is_known = self.node.core.node_id.is_some();
        is_right = is_right && (!is_known || self.check_present(position, entry).is_ok());
        if !is_right {
            self.node.objects.restore_entry(position, entry, self.node.core.node_id);
        }
        is_right
    }
}

/// Whether the value of an entry is stored. The errors of an operation are none of the next one.
fn is_stored(entry: &Entry) -> bool {
    let is_of_errors = matches!(entry.index, Index::ERROR_REGISTER | Index::PREDEFINED_ERROR_FIELD);
    entry.flags.has(Flags::VARIABLE) && entry.flags.group().is_some() && !is_of_errors
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
    let stored = entries.iter().filter(|entry| is_stored(entry));
    stored.filter_map(|entry| entry.flags.group()).filter(|group| *group > last).min()
}

/// The entries of a group with their positions.
fn members<'a>(
    table: &Table<'a>,
    group: StorageGroup,
) -> impl Iterator<Item = (Position, &'a Entry)> + Clone + use<'a> {
    table.all().filter(move |(_, entry)| is_stored(entry) && entry.flags.group() == Some(group))
}
