//! One node: what it uses on the bus by its file, and by what it was seen to be told since.

use super::network::{MappedEntry, Mapping};
use crate::live::KnownDevice;
use crate::printable;
use edskit_host::sdo::SdoValue;
use edskit_types::{
    CobId, DataType, Index, MappingEntry, NodeId, Party, PdoDirection, SdoMessage, SdoRole, SubIndex,
};
use std::collections::{BTreeMap, BTreeSet};

/// Of CiA 301 v4.2, 7.5.2.15.
const TIME_COB_ID: Index = Index(0x1012);
/// How many PDOs there can be in each direction.
const MOST_PDOS: u16 = 512;
/// More entries cannot be mapped; 254 and 255 stand for multiplexed PDOs.
const MOST_MAPPED: u32 = 64;

/// What a node's parameters were seen to be; `None` for one that has changed in a way that was not seen whole.
type Parameters = BTreeMap<(Index, SubIndex), Option<u32>>;

/// A node of which something is known.
pub(super) struct Node {
    node_id: NodeId,
    device: Option<KnownDevice>,
    /// What differs from the file since the node has started.
    seen: Parameters,
    /// What of that it has stored, and has again after a reset.
    stored: Parameters,
}

impl Node {
    /// A node without a file.
    pub(super) fn new(node_id: NodeId) -> Self {
        Self { node_id, device: None, seen: Parameters::new(), stored: Parameters::new() }
    }

    pub(super) fn device(&self) -> Option<&KnownDevice> {
        self.device.as_ref()
    }

    /// Takes its file in; there can be one only.
    pub(super) fn describe(&mut self, device: KnownDevice) -> Result<(), String> {
        match &self.device {
            Some(other) => {
                Err(format!("{} and {} are both for node {}", other.file, device.file, self.node_id))
            }
            None => {
                self.device = Some(device);
                Ok(())
            }
        }
    }

    /// A transfer has shown what an entry holds; no value where it was not seen whole. Says whether that is news about a
    /// service on the bus.
    pub(super) fn learn(
        &mut self,
        (index, sub_index): (Index, SubIndex),
        value: Option<&SdoValue>,
        is_written: bool,
    ) -> bool {
        if is_written {
            self.store(index, sub_index, value);
        }
        let Some(data_type) = parameter_type(index, sub_index) else { return false };
        let value = value.and_then(|value| number(value.of_type(data_type)));
        // What was read in part has not changed.
        if value.map_or(!is_written, |value| self.parameter(index, sub_index) == Some(value)) {
            return false;
        }
        self.seen.insert((index, sub_index), value);
        true
    }

    /// Storing the communication parameters, and restoring their defaults, which takes effect with the next reset
    /// (CiA 301 v4.2, 7.5.2.13 and 7.5.2.14).
    fn store(&mut self, index: Index, sub_index: SubIndex, value: Option<&SdoValue>) {
        let word = value.map(|value| value.of_type(DataType::Unsigned32));
        if !matches!(sub_index.0, 1 | 2) {
            return;
        }
        match (index, word) {
            (Index::STORE_PARAMETERS, Some(b"save")) => self.stored = self.seen.clone(),
            (Index::RESTORE_PARAMETERS, Some(b"load")) => self.stored.clear(),
            _ => {}
        }
    }

    /// The node starts anew, with the values of its file and what it has stored.
    pub(super) fn reset(&mut self) {
        self.seen = self.stored.clone();
    }

    /// What a parameter is, as far as that is known.
    pub(super) fn parameter(&self, index: Index, sub_index: SubIndex) -> Option<u32> {
        if let Some(seen) = self.seen.get(&(index, sub_index)) {
            return *seen;
        }
        let entry = self.device.as_ref()?.entry(index, sub_index)?;
        let data_type = entry.data_type().unwrap_or(DataType::Unsigned32);
        u32::try_from(entry.value()?.integer(data_type, Some(self.node_id)).ok()?).ok()
    }

    /// Whether it is known where this service of the node is, so that the pre-defined connection set does not count.
    pub(super) fn knows(&self, party: Party) -> bool {
        match party {
            // A file says which PDOs there are.
            Party::Pdo { direction, number } => {
                self.device.is_some()
                    || self.seen.contains_key(&(communication(direction, number), SubIndex(1)))
            }
            Party::Emcy => self.parameter(Index::EMCY_COB_ID, SubIndex(0)).is_some(),
            _ => false,
        }
    }

    /// What the node uses on the bus.
    pub(super) fn uses(&self) -> Vec<(Party, CobId, Option<Mapping>)> {
        let cob_id = |index, sub_index| self.parameter(index, SubIndex(sub_index)).map(CobId);
        let mut uses = Vec::new();
        let sync = cob_id(Index::SYNC_COB_ID, 0);
        uses.extend(sync.map(|cob_id| (Party::Sync, cob_id, None)));
        // Bits 31 and 30: the device takes or makes time stamps.
        let time = cob_id(TIME_COB_ID, 0).filter(|cob_id| !cob_id.is_valid() || cob_id.bit30());
        uses.extend(time.map(|cob_id| (Party::Time, cob_id, None)));
        let emcy = cob_id(Index::EMCY_COB_ID, 0).filter(|cob_id| cob_id.is_valid());
        uses.extend(emcy.map(|cob_id| (Party::Emcy, cob_id, None)));
        // The first server has the pre-defined identifiers.
        for number in 2..=128 {
            let index = Index(Index::SDO_SERVER.0 + u16::from(number) - 1);
            let directions = [(SdoMessage::Request, 1), (SdoMessage::Response, 2)];
            let both = directions.map(|(message, sub_index)| (message, cob_id(index, sub_index)));
            if let [(request, Some(to)), (response, Some(from))] = both
                && to.is_valid()
                && from.is_valid()
            {
                let party = |message| Party::Sdo { role: SdoRole::Server, number, message };
                uses.extend([(party(request), to, None), (party(response), from, None)]);
            }
        }
        for direction in [PdoDirection::Transmit, PdoDirection::Receive] {
            uses.extend(self.pdos(direction).into_iter().filter_map(|number| self.pdo(direction, number)));
        }
        uses
    }

    /// The numbers of the PDOs of which anything is known.
    fn pdos(&self, direction: PdoDirection) -> BTreeSet<u16> {
        let described =
            self.device.iter().flat_map(|device| device.sheet.pdos(direction)).map(|pdo| pdo.number);
        let blocks = [communication(direction, 1), mapping(direction, 1)];
        let seen = blocks.into_iter().flat_map(|Index(first)| {
            let last = first + (MOST_PDOS - 1);
            let range = (Index(first), SubIndex(0))..=(Index(last), SubIndex(u8::MAX));
            self.seen.range(range).map(move |((index, _), _)| index.0 - first + 1)
        });
        described.chain(seen).collect()
    }

    fn pdo(&self, direction: PdoDirection, number: u16) -> Option<(Party, CobId, Option<Mapping>)> {
        let party = Party::Pdo { direction, number };
        let cob_id = if self.knows(party) {
            self.parameter(communication(direction, number), SubIndex(1)).map(CobId)
        } else {
            party.predefined_can_id(self.node_id).map(|can_id| CobId(can_id.raw()))
        };
        let cob_id = cob_id.filter(|cob_id| cob_id.is_valid())?;
        Some((party, cob_id, self.mapping(direction, number)))
    }

    /// What a PDO carries; `None` where nothing is known of that.
    fn mapping(&self, direction: PdoDirection, number: u16) -> Option<Mapping> {
        let index = mapping(direction, number);
        let mut seen = self.seen.range((index, SubIndex(0))..=(index, SubIndex(u8::MAX)));
        let is_seen = seen.next().is_some();
        let count = match (self.parameter(index, SubIndex(0)), &self.device) {
            (Some(count), _) => Some(if count > MOST_MAPPED { 0 } else { count as u8 }),
            (None, Some(_)) if !is_seen => Some(0),
            (None, None) if !is_seen => return None,
            (None, _) => None,
        };
        // A mapping with a gap says nothing about what stands behind the gap.
        let entries = count.and_then(|count| {
            let entry = |sub_index| self.parameter(index, SubIndex(sub_index)).map(MappingEntry);
            (1..=count).map(|sub_index| self.mapped(entry(sub_index)?)).collect()
        });
        Some(Mapping { entries, is_seen })
    }

    fn mapped(&self, entry: MappingEntry) -> Option<MappedEntry> {
        let (index, sub_index, bits) = (entry.index(), entry.sub_index(), entry.bits());
        if entry.is_dummy() {
            let data_type = DataType::from_index(index);
            return Some(MappedEntry { index, sub_index, bits, name: Some("dummy".to_owned()), data_type });
        }
        let described = self.device.as_ref().and_then(|device| device.entry(index, sub_index));
        let name = self.device.as_ref().and_then(|device| device.name(index, sub_index));
        let name = name.map(|name| printable::line(&name));
        let data_type = described.and_then(|entry| entry.data_type());
        (entry.0 != 0).then_some(MappedEntry { index, sub_index, bits, name, data_type })
    }
}

fn communication(direction: PdoDirection, number: u16) -> Index {
    let first = match direction {
        PdoDirection::Transmit => Index::TPDO_COMMUNICATION,
        PdoDirection::Receive => Index::RPDO_COMMUNICATION,
    };
    Index(first.0 + (number - 1))
}

fn mapping(direction: PdoDirection, number: u16) -> Index {
    // The mapping parameters stand 200h behind the communication parameters.
    Index(communication(direction, number).0 + MOST_PDOS)
}

/// The type of a parameter that says what a service on the bus is; `None` for any other entry.
fn parameter_type(index: Index, sub_index: SubIndex) -> Option<DataType> {
    let is_sdo_server = (Index::SDO_SERVER.0 + 1..Index::SDO_CLIENT.0).contains(&index.0);
    let is_mapping = index.is_rpdo_mapping() || index.is_tpdo_mapping();
    match (index, sub_index.0) {
        (Index::SYNC_COB_ID | TIME_COB_ID | Index::EMCY_COB_ID, 0) => Some(DataType::Unsigned32),
        (Index::PRODUCER_HEARTBEAT, 0) => Some(DataType::Unsigned16),
        (_, 1 | 2) if is_sdo_server => Some(DataType::Unsigned32),
        (_, 1) if index.is_rpdo_communication() || index.is_tpdo_communication() => {
            Some(DataType::Unsigned32)
        }
        (_, 0) if is_mapping => Some(DataType::Unsigned8),
        _ if is_mapping => Some(DataType::Unsigned32),
        _ => None,
    }
}

/// A number of up to four bytes.
fn number(bytes: &[u8]) -> Option<u32> {
    let is_number = (1..=4).contains(&bytes.len());
    is_number.then(|| bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte)))
}
