//! Who is on the bus, as the given files say, and as transfers have shown since.

use super::node::Node;
use crate::live::KnownDevice;
use crate::value;
use edskit_host::sdo::SdoValue;
use edskit_types::{CanId, DataType, Index, NodeId, Party, PdoDirection, SdoMessage, SdoRole, SubIndex};
use serde::Serialize;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;

/// The nodes of which something is known, and what follows for the identifiers on the bus.
#[derive(Default)]
pub(super) struct Network {
    nodes: BTreeMap<NodeId, Node>,
    users: HashMap<CanId, User>,
}

/// What uses an identifier.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct User {
    pub(super) party: Party,
    /// The node; `None` for a service of the whole network.
    pub(super) node: Option<NodeId>,
    /// What a PDO carries, where anything is known of that.
    pub(super) mapping: Option<Mapping>,
}

/// What a PDO carries.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Mapping {
    /// `None` where a part is not known.
    pub(super) entries: Option<Vec<MappedEntry>>,
    /// Whether transfers have shown it, and not the file.
    pub(super) is_seen: bool,
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
        self.node(node_id).describe(device)?;
        self.find_users();
        Ok(())
    }

    fn node(&mut self, node_id: NodeId) -> &mut Node {
        self.nodes.entry(node_id).or_insert_with(|| Node::new(node_id))
    }

    /// A transfer has shown what an entry of a node holds; no value where it was not seen whole.
    pub(super) fn learn(
        &mut self,
        node_id: NodeId,
        place: (Index, SubIndex),
        value: Option<&SdoValue>,
        is_written: bool,
    ) {
        if self.node(node_id).learn(place, value, is_written) {
            self.find_users();
        }
    }

    /// A node starts anew; all of them for `None`.
    pub(super) fn reset(&mut self, node_id: Option<NodeId>) {
        let nodes =
            self.nodes.iter_mut().filter(|(known, _)| node_id.is_none_or(|node_id| **known == node_id));
        nodes.for_each(|(_, node)| node.reset());
        self.find_users();
    }

    fn find_users(&mut self) {
        self.users.clear();
        for (node_id, node) in &self.nodes {
            for (party, cob_id, mapping) in node.uses() {
                let is_of_network = matches!(party, Party::Sync | Party::Time);
                let user = User { party, node: (!is_of_network).then_some(*node_id), mapping };
                // Of those that send and those that receive the same PDO, the sender says what it is.
                let is_better = |present: &User| present.party.is_rpdo() && !party.is_rpdo();
                match self.users.get(&cob_id.can_id()) {
                    Some(present) if !is_better(present) => {}
                    _ => {
                        self.users.insert(cob_id.can_id(), user);
                    }
                }
            }
        }
    }

    /// Who uses an identifier: what is known of the nodes first, then the pre-defined connection set.
    pub(super) fn user(&self, can_id: CanId) -> Option<User> {
        let predefined = predefined(can_id);
        // NMT, the default SDO, heartbeats and LSS are where they are, whatever a file says.
        let is_free = predefined.as_ref().is_none_or(|user| user.party.is_configurable());
        if is_free && let Some(user) = self.users.get(&can_id) {
            return Some(user.clone());
        }
        let user = predefined?;
        let node = user.node.and_then(|node_id| self.nodes.get(&node_id));
        node.is_none_or(|node| !node.knows(user.party)).then_some(user)
    }

    /// Whether a node is known to send heartbeats, so that it is not guarded (CiA 301 v4.2, 7.2.8.3).
    pub(super) fn sends_heartbeats(&self, node_id: NodeId) -> bool {
        let time =
            self.nodes.get(&node_id).and_then(|node| node.parameter(Index::PRODUCER_HEARTBEAT, SubIndex(0)));
        time.is_some_and(|time| time > 0)
    }

    fn device(&self, node_id: NodeId) -> Option<&KnownDevice> {
        self.nodes.get(&node_id)?.device()
    }

    /// The name of an entry of a node.
    pub(super) fn name(&self, node_id: NodeId, index: Index, sub_index: SubIndex) -> Option<String> {
        self.device(node_id)?.name(index, sub_index)
    }

    /// A value of an entry of a node, as its server or client says it.
    pub(super) fn show(&self, node_id: NodeId, index: Index, sub_index: SubIndex, value: &SdoValue) -> Shown {
        let entry = self.device(node_id).and_then(|device| device.entry(index, sub_index));
        let data_type = entry.and_then(|entry| entry.data_type());
        let mut shown = show(data_type, value::counted(data_type, value));
        if !value::is_settled(data_type, value) {
            shown.text += value::NOT_SAID;
        }
        shown
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
