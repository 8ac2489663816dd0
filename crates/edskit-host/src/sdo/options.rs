//! What a transfer can be told.

use super::MOST_SEGMENTS;
use edskit_runtime::Microseconds;
use edskit_types::{CanId, NodeId, Party, SdoMessage, SdoRole};

/// The two identifiers of an SDO channel.
///
/// ```
/// use edskit_host::sdo::SdoChannel;
/// use edskit_types::NodeId;
///
/// let channel = SdoChannel::of_node(NodeId::new(5)?);
/// assert_eq!((channel.request.to_string(), channel.response.to_string()), ("605h".into(), "585h".into()));
/// # Ok::<(), edskit_types::InvalidNodeId>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SdoChannel {
    /// From the client to the server.
    pub request: CanId,
    /// From the server to the client.
    pub response: CanId,
}

impl SdoChannel {
    /// The default channel, which every node has: 600h and 580h with the node-ID (CiA 301 v4.2, 7.3.3).
    #[must_use]
    pub fn of_node(node: NodeId) -> Self {
        let can_id = |message| {
            let party = Party::Sdo { role: SdoRole::Server, number: 1, message };
            // The pre-defined connection set has both for every node, so the fallback is never taken.
            party.predefined_can_id(node).unwrap_or(CanId::NMT)
        };
        Self { request: can_id(SdoMessage::Request), response: can_id(SdoMessage::Response) }
    }

    /// The node whose default channel this is; `None` for any other channel.
    #[must_use]
    pub fn node(self) -> Option<NodeId> {
        let node = NodeId::new((self.response.raw() & 0x7F) as u8).ok()?;
        (self == Self::of_node(node)).then_some(node)
    }
}

/// Which of the three kinds of transfer is used.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum SdoMode {
    /// Expedited up to four bytes, in blocks above 256 bytes, in segments in between. Where the server shows in any way
    /// that it does not do blocks (it refuses them, is silent, answers as if they had not been asked for, or gets them
    /// wrong), in segments after all: a new transfer, which may wait once more for as long as the time-out.
    #[default]
    Automatic,
    /// In one message: 1 to 4 bytes.
    Expedited,
    /// In segments, each of which is confirmed. A server may still answer a read of up to four bytes expedited.
    Segmented,
    /// In blocks of segments, with a checksum where the server has one.
    Block,
}

/// How a transfer goes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SdoOptions {
    /// Which kind of transfer.
    pub mode: SdoMode,
    /// How long the server may be silent; 1 s unless told otherwise.
    pub time_out: Microseconds,
    /// The most bytes that are taken in; 64 MiB unless told otherwise. A value that is longer is refused.
    pub most_bytes: usize,
    /// How many segments a block has that is read, 1 to 127; other numbers count as the nearest of them.
    pub block_size: u8,
}

impl Default for SdoOptions {
    fn default() -> Self {
        Self {
            mode: SdoMode::Automatic,
            time_out: Microseconds::from_milliseconds(1000),
            most_bytes: 64 << 20,
            block_size: MOST_SEGMENTS,
        }
    }
}
