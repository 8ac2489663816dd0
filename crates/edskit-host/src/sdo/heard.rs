//! What a client hears while it waits.

use super::SdoChannel;
use edskit_runtime::Frame;
use edskit_types::{CanId, NodeId, Party, PdoDirection};

/// What a transfer has heard on the bus, so that whoever explains its end says nothing that the bus has shown to be wrong.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Heard {
    /// How many answers of the server the transfer has taken.
    pub answers: u32,
    /// Whether blocks were tried first and segments then, so that two requests were waited for.
    pub without_blocks: bool,
    /// The last frame on the server's identifier that was not the awaited answer. One without eight data bytes is no SDO
    /// message at all (CiA 301 v4.2, 7.2.4.3).
    pub untaken: Option<Frame>,
    /// The last request that another client has sent on the same channel.
    pub other_client: Option<Frame>,
    /// The last state of the node, as heartbeat or guarding say it, without the toggle bit; 0 for its boot-up message.
    /// Known only on the default channel of a node, as is `is_there`.
    pub state: Option<u8>,
    /// Whether the node has sent a boot-up message.
    pub has_booted_up: bool,
    /// Whether anything has come from one of the node's pre-defined identifiers besides SDO.
    pub is_there: bool,
    /// Whether anything else has come.
    pub has_others: bool,
}

impl Heard {
    /// A frame that is none of the server's messages.
    pub(super) fn elsewhere(&mut self, channel: SdoChannel, frame: &Frame) {
        if frame.can_id() == channel.request {
            self.other_client = Some(*frame);
            return;
        }
        let node = channel.node();
        let is_of_node = node.is_some_and(|node| comes_from(node, frame.can_id()));
        // A request for the state is of the master.
        if !is_of_node || frame.is_remote() {
            self.has_others = true;
            return;
        }
        self.is_there = true;
        if frame.can_id() == node.and_then(error_control).unwrap_or(CanId::NMT)
            && let [byte] = *frame.data()
        {
            self.state = Some(byte & 0x7F);
            self.has_booted_up |= byte == 0;
        }
    }
}

fn error_control(node: NodeId) -> Option<CanId> {
    Party::Heartbeat.predefined_can_id(node)
}

/// Whether the pre-defined connection set lets only this node send there.
fn comes_from(node: NodeId, can_id: CanId) -> bool {
    let tpdos = (1..=4).map(|number| Party::Pdo { direction: PdoDirection::Transmit, number });
    let mut parties = [Party::Heartbeat, Party::Emcy].into_iter().chain(tpdos);
    parties.any(|party| party.predefined_can_id(node) == Some(can_id))
}
