//! What a client's read or write of an entry means: checks, hooks, and what follows for the services.

use crate::Value;
use crate::context::Context;
use crate::dictionary::{Entry, Position};
use crate::pdo::Place;
use edskit_types::{AbortCode, CobId, Index, SubIndex};

/// Where 1010h and 1011h take commands: from sub-index 01h on.
const FIRST_COMMAND: u8 = 1;

impl<'a> Context<'a> {
    /// The entry that a client asks for.
    pub(crate) fn open(
        &mut self,
        index: Index,
        sub_index: SubIndex,
    ) -> Result<(Position, &'a Entry), AbortCode> {
        let position = self.objects.table.find(index, sub_index)?;
        let entry = self.objects.table.entry(position).ok_or(AbortCode::OBJECT_DOES_NOT_EXIST)?;
        if self.exists(entry) { Ok((position, entry)) } else { Err(self.absence(index)) }
    }

    /// What is missing where an entry of an object does not exist in the present configuration.
    fn absence(&mut self, index: Index) -> AbortCode {
        let table = self.objects.table;
        let has_entries = table.entries_of(index).any(|(_, entry)| self.exists(entry));
        if has_entries { AbortCode::SUB_INDEX_DOES_NOT_EXIST } else { AbortCode::OBJECT_DOES_NOT_EXIST }
    }

    /// A client is about to read an entry.
    pub(crate) fn begin_read(&mut self, entry: &Entry) -> Result<(), AbortCode> {
        self.objects.check_read(entry)?;
        if entry.index == Index::PREDEFINED_ERROR_FIELD && entry.sub_index.0 > 0 {
            let count: u8 = self.objects.value(entry.index, 0).unwrap_or_default();
            if entry.sub_index.0 > count {
                return Err(AbortCode::NO_DATA);
            }
        }
        self.app.before_read(&mut self.objects, entry)
    }

    /// A client writes an entry.
    pub(crate) fn write(&mut self, position: Position, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        self.app.check_write(&self.objects, entry, Some(data.len()))?;
        self.objects.check_value(position, entry, data)?;
        self.check_communication_object(position, entry, data)?;
        self.app.before_write(&mut self.objects, entry, data)?;
        let is_command = [Index::STORE_PARAMETERS, Index::RESTORE_PARAMETERS].contains(&entry.index);
        if !is_command {
            self.objects.store(position, data);
            self.apply_communication_object(entry);
        }
        self.app.after_write(&mut self.objects, entry);
        Ok(())
    }

    /// What the standard says about single objects of the communication profile.
    fn check_communication_object(
        &mut self,
        position: Position,
        entry: &Entry,
        data: &[u8],
    ) -> Result<(), AbortCode> {
        let (index, sub_index) = (entry.index, entry.sub_index);
        let old = CobId(u32::from_bytes(self.objects.bytes(position)));
        let new = CobId(u32::from_bytes(data));
        match index {
            Index::PREDEFINED_ERROR_FIELD => self.check_history(data),
            Index::SYNC_COB_ID => self.check_sync_cob_id(old, new),
            Index::STORE_PARAMETERS if sub_index.0 >= FIRST_COMMAND => self.store_parameters(sub_index, data),
            Index::RESTORE_PARAMETERS if sub_index.0 >= FIRST_COMMAND => {
                self.restore_parameters(sub_index, data)
            }
            Index(0x1012) => self.check_time_cob_id(old, new),
            Index::EMCY_COB_ID => self.check_emcy_cob_id(old, new),
            Index::CONSUMER_HEARTBEAT if sub_index.0 > 0 => self.check_consumer(sub_index, new.0),
            Index(0x1019) => self.check_sync_overflow(u8::from_bytes(data)),
            Index(0x1200..=0x127F) => self.check_server(index, sub_index, new),
            _ => match Self::pdo_at(index) {
                Some((place, false)) => self.check_communication(place, sub_index, data),
                Some((place, true)) => self.check_mapping(place, sub_index, data),
                None => Ok(()),
            },
        }
    }

    /// What a new value means for the services.
    fn apply_communication_object(&mut self, entry: &Entry) {
        match entry.index {
            Index::SYNC_COB_ID | Index(0x1006) => self.sync_written(),
            Index(0x100C | 0x100D) => self.guarding_written(),
            Index::CONSUMER_HEARTBEAT => self.consumer_written(entry.sub_index),
            Index::PRODUCER_HEARTBEAT => self.heartbeat_time_written(),
            Index(0x1200..=0x127F) => self.configure_server(entry.index),
            index => match Self::pdo_at(index) {
                Some((place, false)) => self.load_communication(place),
                Some((place, true)) => self.mapping_written(place, entry.sub_index),
                None => {}
            },
        }
    }

    fn mapping_written(&mut self, place: Place, sub_index: SubIndex) {
        if sub_index.0 == 0 {
            self.load_mapping(place);
        }
    }
}
