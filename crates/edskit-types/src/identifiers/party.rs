//! What uses a CAN-ID.

use crate::{CanId, NodeId, PdoDirection};
use core::fmt;

/// A message of a device, or one that it listens to: what uses a CAN-ID.
///
/// ```
/// use edskit_types::{NodeId, Party, PdoDirection};
///
/// let tpdo2 = Party::Pdo { direction: PdoDirection::Transmit, number: 2 };
/// let node = NodeId::new(2)?;
/// assert_eq!(tpdo2.to_string(), "TPDO2");
/// assert_eq!(tpdo2.predefined_can_id(node).unwrap().to_string(), "282h");
/// # Ok::<(), edskit_types::InvalidNodeId>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Party {
    /// Network management commands.
    Nmt,
    /// The synchronization message.
    Sync,
    /// The time stamp message.
    Time,
    /// The emergency message of the device.
    Emcy,
    /// The emergency message of another node, which the device listens to (1028h).
    EmcyOf(u8),
    /// One direction of an SDO channel.
    Sdo {
        /// Which end the device is.
        role: SdoRole,
        /// Number of the channel from 1: server 1 is the default SDO (1200h), client 1 is 1280h.
        number: u8,
        /// The direction.
        message: SdoMessage,
    },
    /// The heartbeat, boot-up and node guarding message of the device.
    Heartbeat,
    /// The heartbeat of another node, which the device monitors (1016h).
    HeartbeatOf(u8),
    /// The request of layer setting services.
    LssRequest,
    /// The response of layer setting services.
    LssResponse,
    /// A process data object.
    Pdo {
        /// Whether the device sends it.
        direction: PdoDirection,
        /// Number from 1: RPDO 1 is 1400h, TPDO 1 is 1800h.
        number: u16,
    },
}

/// Which end of an SDO channel a device is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SdoRole {
    /// It answers (1200h to 127Fh).
    Server,
    /// It asks (1280h to 12FFh).
    Client,
}

/// Direction of an SDO message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SdoMessage {
    /// From the client to the server.
    Request,
    /// From the server to the client.
    Response,
}

impl Party {
    /// The CAN-ID that the pre-defined connection set (CiA 301, 7.3.3) gives this party on node `node_id`.
    ///
    /// `None` for what has none: PDOs beyond the fourth, SDO channels besides the default server, and messages of
    /// nodes above 127. [`Party::HeartbeatOf`] 0 gives 700h: nobody sends there, but a rule may name it.
    #[must_use]
    pub const fn predefined_can_id(self, node_id: NodeId) -> Option<CanId> {
        let node_id = node_id.get() as u16;
        CanId::standard(match self {
            Party::Nmt => 0x000,
            Party::Sync => 0x080,
            Party::Time => 0x100,
            Party::Emcy => 0x080 + node_id,
            Party::EmcyOf(other @ 1..=127) => 0x080 + other as u16,
            Party::Sdo { role: SdoRole::Server, number: 1, message } => match message {
                SdoMessage::Request => 0x600 + node_id,
                SdoMessage::Response => 0x580 + node_id,
            },
            Party::Heartbeat => 0x700 + node_id,
            Party::HeartbeatOf(other @ 0..=127) => 0x700 + other as u16,
            Party::LssRequest => 0x7E5,
            Party::LssResponse => 0x7E4,
            Party::Pdo { direction, number: number @ 1..=4 } => {
                let first = match direction {
                    PdoDirection::Transmit => 0x180,
                    PdoDirection::Receive => 0x200,
                };
                first + (number - 1) * 0x100 + node_id
            }
            Party::EmcyOf(_) | Party::Sdo { .. } | Party::HeartbeatOf(_) | Party::Pdo { .. } => return None,
        })
    }

    /// Whether a configuration chooses the CAN-ID, so that the restricted ones (CiA 301, 7.3.5) are forbidden: SYNC,
    /// TIME, EMCY, PDOs and additional SDO servers.
    ///
    /// NMT, the default SDO, heartbeats and LSS are what the ranges are kept free for. An SDO client uses the
    /// CAN-IDs of the server that it talks to, which may be a default SDO.
    #[must_use]
    pub const fn is_configurable(self) -> bool {
        match self {
            Party::Sync | Party::Time | Party::Emcy | Party::EmcyOf(_) | Party::Pdo { .. } => true,
            Party::Sdo { role: SdoRole::Server, number, .. } => number > 1,
            Party::Sdo { role: SdoRole::Client, .. }
            | Party::Nmt
            | Party::Heartbeat
            | Party::HeartbeatOf(_)
            | Party::LssRequest
            | Party::LssResponse => false,
        }
    }

    /// Whether this is a PDO that the device receives.
    #[must_use]
    pub const fn is_rpdo(self) -> bool {
        matches!(self, Party::Pdo { direction: PdoDirection::Receive, .. })
    }
}

/// `TPDO5`, `EMCY`, `SDO server request`, `heartbeat of node 5`.
impl fmt::Display for Party {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Party::Nmt => f.write_str("NMT"),
            Party::Sync => f.write_str("SYNC"),
            Party::Time => f.write_str("TIME"),
            Party::Emcy => f.write_str("EMCY"),
            Party::EmcyOf(node) => write!(f, "EMCY of node {node}"),
            Party::Sdo { role, number, message } => {
                f.write_str(match role {
                    SdoRole::Server => "SDO server",
                    SdoRole::Client => "SDO client",
                })?;
                if (role, number) != (SdoRole::Server, 1) {
                    write!(f, " {number}")?;
                }
                f.write_str(match message {
                    SdoMessage::Request => " request",
                    SdoMessage::Response => " response",
                })
            }
            Party::Heartbeat => f.write_str("heartbeat"),
            Party::HeartbeatOf(node) => write!(f, "heartbeat of node {node}"),
            Party::LssRequest => f.write_str("LSS request"),
            Party::LssResponse => f.write_str("LSS response"),
            Party::Pdo { direction: PdoDirection::Receive, number } => write!(f, "RPDO{number}"),
            Party::Pdo { direction: PdoDirection::Transmit, number } => write!(f, "TPDO{number}"),
        }
    }
}

/// A party with the CAN-ID that it uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Claim {
    /// The CAN-ID.
    pub can_id: CanId,
    /// What uses it.
    pub party: Party,
}

impl Claim {
    /// The claim of a party on the CAN-ID that the pre-defined connection set gives it, if it has one.
    #[must_use]
    pub const fn predefined(party: Party, node_id: NodeId) -> Option<Claim> {
        match party.predefined_can_id(node_id) {
            Some(can_id) => Some(Claim { can_id, party }),
            None => None,
        }
    }
}

/// `TPDO5 on 282h`.
impl fmt::Display for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} on {}", self.party, self.can_id)
    }
}
