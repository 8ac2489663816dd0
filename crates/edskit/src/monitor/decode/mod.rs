//! From frames to what they say.

mod lss;
mod sdo;
mod simple;

pub(super) use lss::Lss;
pub(super) use sdo::Sdo;

use super::network::{Mapping, Network, Shown, show};
use edskit_runtime::{Frame, Value as _};
use edskit_types::{NmtCommand, NodeId, Party, SdoMessage};
use sdo::{Channel, Held};
use serde::Serialize;
use std::collections::{HashMap, HashSet};

/// What a frame says.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(tag = "service", rename_all = "kebab-case")]
pub(super) enum Message {
    /// A command of the NMT master.
    Nmt {
        command: String,
        /// `None` for all nodes.
        node: Option<u8>,
    },
    Sync {
        counter: Option<u8>,
    },
    Time {
        time: String,
    },
    Emcy {
        node: u8,
        code: u16,
        meaning: Option<&'static str>,
        error_register: u8,
        errors: Vec<&'static str>,
        info: String,
    },
    BootUp {
        node: u8,
    },
    Heartbeat {
        node: u8,
        state: String,
    },
    GuardRequest {
        node: u8,
    },
    Guarding {
        node: u8,
        state: String,
        toggle: bool,
    },
    Sdo(Sdo),
    Pdo {
        node: u8,
        pdo: String,
        values: Vec<PdoValue>,
        /// What does not fit the mapping.
        note: Option<String>,
    },
    PdoRequest {
        node: u8,
        pdo: String,
    },
    Lss(Lss),
    /// A frame of a service that does not look like one.
    Malformed {
        expected: String,
    },
    Unknown,
}

/// One value of a PDO.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(super) struct PdoValue {
    pub(super) index: u16,
    pub(super) sub_index: u8,
    pub(super) name: Option<String>,
    #[serde(flatten)]
    pub(super) shown: Shown,
}

/// Decodes frames, one after the other. It remembers what the frames before said: which SDO transfers run, what they have
/// shown of the nodes' PDOs and identifiers, and which nodes are guarded.
#[derive(Default)]
pub(super) struct Decoder {
    network: Network,
    /// By node and number of its server.
    channels: HashMap<(NodeId, u8), Channel>,
    guarded: HashSet<NodeId>,
}

impl Decoder {
    pub(super) fn new(network: Network) -> Self {
        Self { network, ..Self::default() }
    }

    /// Frames are missing: of what runs, no value can be put together.
    pub(super) fn forget(&mut self) {
        self.channels.clear();
    }

    pub(super) fn decode(&mut self, frame: &Frame) -> Message {
        let Some(user) = self.network.user(frame.can_id()) else { return Message::Unknown };
        let (data, malformed) =
            (frame.data(), |expected: &str| Message::Malformed { expected: expected.to_owned() });
        let Some(node) = user.node else {
            let (message, expected) = match user.party {
                Party::Nmt => (simple::nmt(data), "an NMT command of two bytes"),
                Party::Sync => (simple::sync(data), "a SYNC of at most one byte"),
                Party::Time => (simple::time(data), "a TIME of six bytes"),
                Party::LssRequest => (Lss::of_request(data), "an LSS message of eight bytes"),
                Party::LssResponse => (Lss::of_response(data), "an LSS message of eight bytes"),
                _ => (Some(Message::Unknown), ""),
            };
            if let (Party::Nmt, Some(Message::Nmt { node, .. })) = (user.party, &message) {
                self.commanded(data[0], *node);
            }
            return message.unwrap_or_else(|| malformed(expected));
        };
        let number = node.get();
        match user.party {
            Party::Pdo { .. } if frame.is_remote() => {
                Message::PdoRequest { node: number, pdo: user.party.to_string() }
            }
            Party::Heartbeat if frame.is_remote() => {
                self.guarded.insert(node);
                Message::GuardRequest { node: number }
            }
            Party::Pdo { .. } => pdo(number, user.party, user.mapping.as_ref(), data),
            Party::Heartbeat => {
                let is_guarded = self.guarded.contains(&node) && !self.network.sends_heartbeats(node);
                let message = simple::error_control(number, is_guarded, data);
                if let Some(Message::BootUp { .. }) = message {
                    self.restarted(Some(node));
                }
                message.unwrap_or_else(|| malformed("a heartbeat of one byte"))
            }
            Party::Emcy => simple::emcy(number, data).unwrap_or_else(|| malformed("an EMCY of eight bytes")),
            Party::Sdo { number: server, message, .. } => {
                let Ok(bytes) = <[u8; 8]>::try_from(data) else { return malformed("an SDO of eight bytes") };
                let channel = self.channels.entry((node, server)).or_default();
                let step = match message {
                    SdoMessage::Request => channel.request(bytes),
                    SdoMessage::Response => channel.response(bytes),
                };
                if let Some(Held { place, value, is_written }) = &step.held {
                    self.network.learn(node, *place, value.as_ref(), *is_written);
                }
                Message::Sdo(Sdo::new(number, message, step, |index, sub_index, value| {
                    let name = self.network.name(node, index, sub_index);
                    (name, value.map(|value| self.network.show(node, index, sub_index, value)))
                }))
            }
            _ => Message::Unknown,
        }
    }

    /// The master has told a node something, or all of them.
    fn commanded(&mut self, command: u8, node: Option<u8>) {
        let is_reset = matches!(
            NmtCommand::from_code(command),
            Some(NmtCommand::ResetNode | NmtCommand::ResetCommunication)
        );
        match node.map(NodeId::new) {
            None if is_reset => self.restarted(None),
            Some(Ok(node)) if is_reset => self.restarted(Some(node)),
            _ => {}
        }
    }

    /// A node starts anew, or all do: nothing that was told to it before counts.
    fn restarted(&mut self, node: Option<NodeId>) {
        let is_meant = |known: NodeId| node.is_none_or(|node| node == known);
        self.channels.retain(|(known, _), _| !is_meant(*known));
        self.guarded.retain(|known| !is_meant(*known));
        self.network.reset(node);
    }
}

/// The values of a PDO by its mapping, bit by bit (CiA 301 v4.2, 7.2.2).
fn pdo(node: u8, party: Party, mapping: Option<&Mapping>, data: &[u8]) -> Message {
    let all = u64::from_bytes(data);
    let (mut first, mut values) = (0_u32, Vec::new());
    for entry in mapping.and_then(|mapping| mapping.entries.as_ref()).into_iter().flatten() {
        let (start, end) = (first, first + u32::from(entry.bits));
        first = end;
        if end > 8 * data.len() as u32 || entry.bits == 0 {
            continue;
        }
        let mask = u64::MAX >> (64 - u32::from(entry.bits));
        let bits = all >> start & mask;
        let bytes = &bits.to_le_bytes()[..usize::from(entry.bits.div_ceil(8))];
        values.push(PdoValue {
            index: entry.index.0,
            sub_index: entry.sub_index.0,
            name: entry.name.clone(),
            shown: show(entry.data_type, bytes),
        });
    }
    let (mapped, length) = (first.div_ceil(8), data.len() as u32);
    let note = mapping.and_then(|Mapping { entries, is_seen }| {
        let source = if *is_seen { "what was seen of it" } else { "the file" };
        match entries.as_deref() {
            None if *is_seen => Some("its mapping has changed, and not all of that was seen".to_owned()),
            None => None,
            Some([]) if length > 0 => Some(format!("nothing is mapped by {source}")),
            Some(_) if length < mapped => Some(format!("too short, {mapped} bytes are mapped by {source}")),
            Some(_) if length > mapped => Some(format!("too long, {mapped} bytes are mapped by {source}")),
            Some(_) => None,
        }
    });
    Message::Pdo { node, pdo: party.to_string(), values, note }
}

#[cfg(test)]
mod tests;
