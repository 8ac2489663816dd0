//! Who is on the bus, as the given files say.

use crate::live::KnownDevice;
use crate::printable;
use crate::value;
use edskit_model::Value;
use edskit_types::{
    CanId, CobId, DataType, Index, MappingEntry, NodeId, Party, PdoDirection, SdoMessage, SdoRole, SubIndex,
};
use serde::Serialize;
use std::collections::HashMap;
use std::path::Path;

/// The devices whose files were given, and what follows for the identifiers on the bus.
#[derive(Default)]
pub(super) struct Network {
    devices: HashMap<NodeId, KnownDevice>,
    users: HashMap<CanId, User>,
}

/// What uses an identifier.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct User {
    pub(super) party: Party,
    /// The node; `None` for a service of the whole network.
    pub(super) node: Option<NodeId>,
    /// What a PDO carries, where that is known.
    pub(super) mapping: Option<Vec<MappedEntry>>,
}

/// One entry of a PDO.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct MappedEntry {
    pub(super) index: Index,
    pub(super) sub_index: SubIndex,
    pub(super) bits: u8,
    pub(super) name: Option<String>,
    pub(super) data_type: Option<DataType>,
}

/// A value with its notations for people and for programs.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(super) struct Shown {
    #[serde(skip)]
    pub(super) text: String,
    /// By the data type, where it is known
    pub(super) value: Option<serde_json::Value>,
    pub(super) bytes: String,
}

/// How many bytes of a long value are shown.
const MOST_SHOWN: usize = 48;

impl Network {
    /// Reads the files, each as `FILE` or `FILE@NODE`.
    pub(super) fn read(files: &[String]) -> Result<Self, String> {
        let mut network = Self::default();
        for argument in files {
            let (file, node_id) =
                match argument.rsplit_once('@') {
                    Some((file, node)) if !Path::new(argument).exists() => {
                        let node_id = node.parse().ok().and_then(|node: u8| NodeId::new(node).ok());
                        (
                            file,
                            Some(node_id.ok_or_else(|| {
                                format!("{argument}: `{node}` is no node-ID, which is 1..127")
                            })?),
                        )
                    }
                    _ => (argument.as_str(), None),
                };
            let device = KnownDevice::read(Path::new(file))?;
            let node_id = node_id
                .or(device.sheet.commissioned_node_id())
                .ok_or_else(|| format!("{file}: the file names no node-ID; write {file}@5 for node 5"))?;
            network.add(node_id, device)?;
        }
        Ok(network)
    }

    /// Takes a device in; two cannot be the same node.
    pub(super) fn add(&mut self, node_id: NodeId, device: KnownDevice) -> Result<(), String> {
        for (party, cob_id, mapping) in parties(node_id, &device) {
            let user = User { party, node: Some(node_id), mapping };
            // Of those that send and those that receive the same PDO, the sender says what it is.
            let is_better = |present: &User| present.party.is_rpdo() && !party.is_rpdo();
            match self.users.get(&cob_id.can_id()) {
                Some(present) if !is_better(present) => {}
                _ => {
                    self.users.insert(cob_id.can_id(), user);
                }
            }
        }
        let file = device.file.clone();
        match self.devices.insert(node_id, device) {
            None => Ok(()),
            Some(other) => Err(format!("{} and {file} are both for node {node_id}", other.file)),
        }
    }

    /// Who uses an identifier: by the files first, then by the pre-defined connection set.
    pub(super) fn user(&self, can_id: CanId) -> Option<User> {
        if let Some(user) = self.users.get(&can_id) {
            return Some(user.clone());
        }
        let user = predefined(can_id)?;
        // The file of a node says which PDOs it has and where; the pre-defined ones do not count beside it.
        let is_known = user.node.is_some_and(|node_id| self.devices.contains_key(&node_id));
        (!is_known || !matches!(user.party, Party::Pdo { .. })).then_some(user)
    }

    /// The name of an entry of a node.
    pub(super) fn name(&self, node_id: NodeId, index: Index, sub_index: SubIndex) -> Option<String> {
        self.devices.get(&node_id)?.name(index, sub_index)
    }

    /// A value of an entry of a node.
    pub(super) fn show(&self, node_id: NodeId, index: Index, sub_index: SubIndex, bytes: &[u8]) -> Shown {
        let device = self.devices.get(&node_id);
        show(device.and_then(|device| device.entry(index, sub_index)?.data_type()), bytes)
    }
}

/// A value of a type, cut where it is long.
pub(super) fn show(data_type: Option<DataType>, bytes: &[u8]) -> Shown {
    let is_text = data_type.is_some_and(DataType::is_string) && data_type != Some(DataType::OctetString);
    let text = if bytes.len() > MOST_SHOWN && !is_text {
        format!("{} ... ({} bytes)", value::hex(&bytes[..MOST_SHOWN]), bytes.len())
    } else {
        data_type.map_or_else(|| value::untyped(bytes), |data_type| value::text(data_type, bytes))
    };
    Shown {
        text,
        value: data_type.map(|data_type| value::json(data_type, bytes)),
        bytes: value::digits(bytes),
    }
}

/// What a device uses by its file, with the values of power-on.
fn parties(
    node_id: NodeId,
    device: &KnownDevice,
) -> impl Iterator<Item = (Party, CobId, Option<Vec<MappedEntry>>)> + '_ {
    let cob_id = move |value: Option<Value<'_>>| {
        let value = value?.integer(DataType::Unsigned32, Some(node_id)).ok()?;
        u32::try_from(value).ok().map(CobId)
    };
    let of_object = move |index| cob_id(device.entry(index, SubIndex(0)).and_then(|entry| entry.value()));
    let emcy = of_object(Index::EMCY_COB_ID).filter(|cob_id| cob_id.is_valid());
    let emcy = emcy.map(|cob_id| (Party::Emcy, cob_id, None));
    let directions = [PdoDirection::Transmit, PdoDirection::Receive];
    let pdos = directions.into_iter().flat_map(|direction| device.sheet.pdos(direction));
    let pdos = pdos.filter_map(move |pdo| {
        let cob_id = cob_id(pdo.cob_id()).filter(|cob_id| cob_id.is_valid())?;
        let party = Party::Pdo { direction: pdo.direction, number: pdo.number };
        let entries = pdo.mapped(Some(node_id)).map(|(_, entry)| mapped(device, entry?));
        // A mapping with a gap says nothing about what stands behind the gap.
        Some((party, cob_id, entries.collect::<Option<Vec<_>>>()))
    });
    emcy.into_iter().chain(pdos)
}

fn mapped(device: &KnownDevice, entry: MappingEntry) -> Option<MappedEntry> {
    let (index, sub_index, bits) = (entry.index(), entry.sub_index(), entry.bits());
    if entry.is_dummy() {
        let data_type = DataType::from_index(index);
        return Some(MappedEntry { index, sub_index, bits, name: Some("dummy".to_owned()), data_type });
    }
    let described = device.entry(index, sub_index);
    let name = device.name(index, sub_index).map(|name| printable::line(&name));
    let data_type = described.and_then(|entry| entry.data_type());
    (entry.0 != 0).then_some(MappedEntry { index, sub_index, bits, name, data_type })
}

/// The pre-defined connection set, seen from an identifier (CiA 301 v4.2, 7.3.3).
fn predefined(can_id: CanId) -> Option<User> {
    let of_network = [Party::Nmt, Party::Sync, Party::Time, Party::LssRequest, Party::LssResponse];
    let pdos = (1..=4).flat_map(|number| {
        [PdoDirection::Transmit, PdoDirection::Receive].map(|direction| Party::Pdo { direction, number })
    });
    let sdo = |message| Party::Sdo { role: SdoRole::Server, number: 1, message };
    let of_node = [Party::Emcy, sdo(SdoMessage::Request), sdo(SdoMessage::Response), Party::Heartbeat];
    let user = |party, node| User { party, node, mapping: None };
    if let Some(party) =
        of_network.into_iter().find(|party| party.predefined_can_id(NodeId::MIN) == Some(can_id))
    {
        return Some(user(party, None));
    }
    let node_id = NodeId::new((can_id.raw() & 0x7F) as u8).ok()?;
    let party =
        of_node.into_iter().chain(pdos).find(|party| party.predefined_can_id(node_id) == Some(can_id))?;
    Some(user(party, Some(node_id)))
}
