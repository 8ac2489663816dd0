//! What a value means that is brought to an entry: checks, hooks, and what follows for the services.
//!
//! A rule on a value holds on every way by which the value comes. So there are two questions, each with one answer for
//! each object: whether an entry can have a value at all ([`Context::check_parameter`]), which is asked of SDO clients, of
//! RPDOs, of stored values, and by each service of what it finds in the dictionary; and whether it can have it now
//! ([`Context::check_change`]). What follows from a value that is there is one function of each service.

use crate::Application;
use crate::Value;
use crate::context::Context;
use crate::dictionary::{Entry, Position};
use crate::error_behaviour::check_error_behaviour;
use crate::pdo::Place;
use crate::sync::check_sync_overflow;
use edskit_types::{AbortCode, CobId, Index, SubIndex};

/// Where 1010h and 1011h take commands: from sub-index 01h on.
const FIRST_COMMAND: u8 = 1;
/// "save", as 1010h wants it.
const SAVE: [u8; 4] = *b"save";
/// "load", as 1011h wants it.
const LOAD: [u8; 4] = *b"load";

impl<'a, A: Application + ?Sized> Context<'a, A> {
    /// The entry at a place, in the dictionary or with the device, and where it is.
    pub(crate) fn open(&mut self, index: Index, sub_index: SubIndex) -> Result<(Position, Entry), AbortCode> {
        let table = self.node.objects.table;
        let found = table.find(index, sub_index);
        let absence = match found.map(|position| (position, table.entry(position))) {
            Ok((position, Some(entry))) if self.exists(entry) => return Ok((position, *entry)),
            Ok(_) => self.absence(index),
            Err(absence) => absence,
        };
        let entry = self.app.find(&mut self.node, index, sub_index, absence)?;
        Ok((Position::OF_DEVICE, entry))
    }

    /// What is missing where an entry of an object does not exist in the present configuration.
    fn absence(&mut self, index: Index) -> AbortCode {
        let table = self.node.objects.table;
        let has_entries = table.entries_of(index).any(|(_, entry)| self.exists(entry));
        if has_entries { AbortCode::SUB_INDEX_DOES_NOT_EXIST } else { AbortCode::OBJECT_DOES_NOT_EXIST }
    }

    /// A client is about to read an entry.
    pub(crate) fn begin_read(&mut self, entry: &Entry) -> Result<(), AbortCode> {
        self.app.check_read(&self.node, entry)?;
        self.app.before_read(&mut self.node, entry)
    }

    /// A client writes an entry.
    pub(crate) fn write(&mut self, position: Position, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        self.app.check_write(&self.node, entry, Some(data.len()))?;
        self.bring(position, entry, data)?;
        self.app.after_write(&mut self.node, entry);
        Ok(())
    }

    /// A client or an RPDO brings a value of the right length to an entry.
    pub(crate) fn bring(&mut self, position: Position, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        if position == Position::OF_DEVICE {
            return self.app.write_value(&mut self.node, entry, data);
        }
        if is_communication(entry.index) {
            return self.bring_parameter(position, entry, data);
        }
        self.node.objects.check_value(position, entry, data)?;
        self.app.before_write(&mut self.node, entry, data)?;
        self.put(position, entry, data);
        Ok(())
    }

    /// The same for an entry of 1000h to 1FFFh.
    #[inline(never)]
    fn bring_parameter(&mut self, position: Position, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        let mut taken = [0; 8];
        let data = match taken.get_mut(..data.len()) {
            Some(taken) if !entry.data_type.is_string() => {
                crate::dictionary::copy(taken, data);
                self.app.adapt(&self.node, entry, taken);
                taken
            }
            _ => data,
        };
        self.node.objects.check_value(position, entry, data)?;
        // Of a value that cannot be, at a time when none can, the time is said.
        self.check_change(entry, data)?;
        self.check_parameter(entry, data)?;
        self.app.before_write(&mut self.node, entry, data)?;
        if is_command(entry) {
            return self.do_command(entry);
        }
        self.put(position, entry, data);
        if let Some((place, true)) = Place::at(entry.index) {
            self.mapping_written(place);
        }
        Ok(())
    }

    /// Gives an entry a value that has been checked, with what follows from it.
    #[inline]
    fn put(&mut self, position: Position, entry: &Entry, data: &[u8]) {
        let is_event =
            self.app.write_is_event(&self.node, entry) && self.node.objects.bytes(position) != data;
        self.node.objects.put(position, entry, data);
        if is_communication(entry.index) {
            self.parameter_changed(entry);
        }
        if is_event {
            self.node.value_changed(position);
        }
    }

    /// Whether an entry of 1000h to 1FFFh can have a value at all: what the standard says about single objects.
    fn check_parameter(&mut self, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        let (index, sub_index) = (entry.index, entry.sub_index);
        let cob_id = CobId(u32::from_bytes(data));
        match index {
            Index::SYNC_COB_ID => self.check_sync(cob_id),
            Index::STORE_PARAMETERS | Index::RESTORE_PARAMETERS if is_command(entry) => {
                check_command(index, data)
            }
            Index(0x100C) => self.check_guard_time(data),
            Index(0x1012) => self.check_time(cob_id),
            Index::EMCY_COB_ID => self.node.check_cob_id(cob_id),
            Index::CONSUMER_HEARTBEAT if sub_index.0 > 0 => self.check_consumer(sub_index, cob_id.0),
            Index(0x1019) => check_sync_overflow(u8::from_bytes(data)),
            Index(0x1029) if sub_index.0 > 0 => check_error_behaviour(u8::from_bytes(data)),
            Index(0x1201..=0x127F) => self.check_server(sub_index, cob_id),
            _ => match Place::at(index) {
                Some((place, false)) => self.check_communication(place, sub_index, data),
                Some((place, true)) => self.check_mapping(place, sub_index, data),
                None => Ok(()),
            },
        }
    }

    /// Whether an entry can have a value now: what is valid has to be made invalid first, and the like.
    fn check_change(&mut self, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        let (index, sub_index) = (entry.index, entry.sub_index);
        let new = CobId(u32::from_bytes(data));
        match index {
            Index::PREDEFINED_ERROR_FIELD if sub_index.0 == 0 => self.check_history(data),
            Index::SYNC_COB_ID => self.check_sync_change(new),
            Index(0x1012) => self.check_time_change(new),
            Index::EMCY_COB_ID => self.check_emcy_change(new),
            Index(0x1019) => self.check_overflow_change(),
            Index(0x1201..=0x127F) => self.check_server_change(index, sub_index, new),
            _ => match Place::at(index) {
                Some((place, false)) => self.check_communication_change(place, sub_index, new),
                Some((place, true)) => self.check_mapping_change(place, sub_index),
                None => Ok(()),
            },
        }
    }

    /// What follows for the services from the value that an entry of 1000h to 1FFFh has now, and what is left of what
    /// they had under the old one.
    pub(crate) fn parameter_changed(&mut self, entry: &Entry) {
        match entry.index {
            Index::SYNC_COB_ID | Index(0x1006 | 0x1019) => self.sync_changed(),
            Index(0x100C | 0x100D) => self.guarding_changed(),
            Index::EMCY_COB_ID => self.node.send_emergencies(),
            Index::CONSUMER_HEARTBEAT => self.consumer_changed(entry.sub_index),
            Index::PRODUCER_HEARTBEAT => self.heartbeat_time_changed(),
            Index(0x1200..=0x127F) => self.configure_server(entry.index),
            index => match Place::at(index) {
                Some((place, false)) => self.pdo_changed(place, false),
                // Entries do not count before their number does.
                Some((place, true)) if entry.sub_index.0 == 0 => self.pdo_changed(place, true),
                _ => {}
            },
        }
    }

    /// Whether an entry can have the value that it has, wherever that comes from. A mapping counts as a whole, and
    /// entries beyond the number of those that count have no meaning.
    pub(crate) fn check_present(&mut self, position: Position, entry: &Entry) -> Result<(), AbortCode> {
        let mut value = [0; 8];
        let bytes = self.node.objects.bytes(position);
        let value = value.get_mut(..bytes.len()).unwrap_or_default();
        crate::dictionary::copy(value, bytes);
        self.node.objects.check_value(position, entry, value)?;
        let is_mapped = matches!(Place::at(entry.index), Some((_, true)));
        if is_communication(entry.index) && !is_command(entry) && !is_mapped {
            self.check_parameter(entry, value)?;
        }
        Ok(())
    }

    /// Calls `report` with every entry whose value is one that a client could not write.
    pub(crate) fn refused(&mut self, report: &mut dyn FnMut(&Entry, AbortCode)) {
        for (position, entry) in self.node.objects.table.all() {
            // What follows the node-ID is not known without one.
            if self.node.core.node_id.is_none() || !self.exists(entry) {
                continue;
            }
            let is_count = matches!(Place::at(entry.index), Some((_, true))) && entry.sub_index.0 == 0;
            let checked = match self.node.objects.bytes(position).first() {
                Some(count) if is_count => self.check_parameter(entry, &[*count]),
                _ => self.check_present(position, entry),
            };
            if let Err(code) = checked {
                report(entry, code);
            }
        }
    }
}

/// Whether an index is in the area of the communication profile.
pub(crate) fn is_communication(index: Index) -> bool {
    (0x1000..0x2000).contains(&index.0)
}

/// Whether what is written into an entry is a command and no value.
fn is_command(entry: &Entry) -> bool {
    let takes_commands = matches!(entry.index, Index::STORE_PARAMETERS | Index::RESTORE_PARAMETERS);
    takes_commands && entry.sub_index.0 >= FIRST_COMMAND
}

/// What 1010h and 1011h take: their signature.
fn check_command(index: Index, data: &[u8]) -> Result<(), AbortCode> {
    let signature = if index == Index::STORE_PARAMETERS { SAVE } else { LOAD };
    if data == signature { Ok(()) } else { Err(AbortCode::CANNOT_TRANSFER) }
}
