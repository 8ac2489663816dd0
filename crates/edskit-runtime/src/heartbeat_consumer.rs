//! Heartbeat consumer: 1016h (CiA 301 v4.2, 7.2.8.3.2).

use crate::Application;
use crate::context::Context;
use crate::nmt::error_control;
use crate::time::Timer;
use crate::{EmcyError, Frame, Instant, Microseconds};
use edskit_types::{AbortCode, CanId, Index, NmtState, NodeId, SubIndex};

/// What is known of a node whose heartbeat is monitored: an entry of 1016h.
#[derive(Clone, Copy, Debug)]
pub struct HeartbeatConsumer {
    node_id: Option<NodeId>,
    time: Microseconds,
    /// Runs from the first heartbeat on.
    timer: Timer,
    state: Option<NmtState>,
    /// Whether that is an error which is present.
    is_missing: bool,
}

impl HeartbeatConsumer {
    /// One that monitors nobody.
    pub const NEW: Self =
        Self { node_id: None, time: Microseconds(0), timer: Timer::OFF, state: None, is_missing: false };

    pub(crate) fn deadline(&self) -> Instant {
        self.timer.deadline()
    }

    /// The consumer that an entry of 1016h describes: the node-ID in bits 16 to 23, milliseconds in bits 0 to 15.
    fn of(value: u32) -> Self {
        let milliseconds = value & 0xFFFF;
        let node_id = NodeId::new((value >> 16) as u8).ok().filter(|_| milliseconds > 0);
        Self { node_id, time: Microseconds::from_milliseconds(milliseconds), ..Self::NEW }
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// Takes the monitored nodes from 1016h.
    pub(crate) fn configure_consumers(&mut self) {
        self.node.consumers.fill(HeartbeatConsumer::NEW);
        for place in 1..=self.node.consumers.len() {
            self.consumer_changed(SubIndex(place as u8));
        }
    }

    /// What 1016h can be set to: bits 24 to 31 are reserved, and no node may be monitored twice.
    pub(crate) fn check_consumer(&self, sub_index: SubIndex, value: u32) -> Result<(), AbortCode> {
        if value >> 24 != 0 {
            return Err(AbortCode::INVALID_VALUE);
        }
        let Some(node_id) = HeartbeatConsumer::of(value).node_id else { return Ok(()) };
        let others =
            self.node.consumers.iter().enumerate().filter(|(place, _)| place + 1 != usize::from(sub_index.0));
        let is_doubled = others.map(|(_, other)| other.node_id).any(|other| other == Some(node_id));
        if is_doubled { Err(AbortCode::PARAMETER_INCOMPATIBLE) } else { Ok(()) }
    }

    /// What follows from an entry of 1016h: its monitoring begins anew, and an error of the old one is none any more.
    pub(crate) fn consumer_changed(&mut self, sub_index: SubIndex) {
        let value: u32 = self.node.objects.value(Index::CONSUMER_HEARTBEAT, sub_index.0).unwrap_or_default();
        let new = match self.check_consumer(sub_index, value) {
            Ok(()) => HeartbeatConsumer::of(value),
            Err(_) => HeartbeatConsumer::NEW,
        };
        let place = usize::from(sub_index.0).checked_sub(1);
        let Some(consumer) = place.and_then(|place| self.node.consumers.get_mut(place)) else { return };
        let was_missing = core::mem::replace(consumer, new).is_missing;
        self.found(EmcyError::HEARTBEAT, was_missing, false, [0; 5]);
    }

    /// A frame with the identifier of a heartbeat.
    ///
    /// Monitoring begins with the first heartbeat (7.5.2.19), and a boot-up message is none: its node may be configured
    /// for a long time before it sends any. Of a node that is monitored already it is a sign of life.
    pub(crate) fn heartbeat_received(&mut self, can_id: CanId, frame: &Frame) {
        let &[code] = frame.data() else { return };
        let Some(state) = NmtState::from_code(code & 0x7F) else { return };
        let now = self.node.now;
        let is_of = |consumer: &&mut HeartbeatConsumer| consumer.node_id.map(error_control) == Some(can_id);
        let Some(consumer) = self.node.consumers.iter_mut().find(is_of) else { return };
        let Some(node_id) = consumer.node_id else { return };
        if state != NmtState::Initialising || consumer.timer.is_running() {
            consumer.timer = Timer::after(now, consumer.time);
        }
        let is_new = consumer.state.replace(state) != Some(state);
        let was_missing = core::mem::take(&mut consumer.is_missing);
        self.found(EmcyError::HEARTBEAT, was_missing, false, [0; 5]);
        if is_new {
            self.app.remote_state(&mut self.node, node_id, Some(state));
        }
    }

    pub(crate) fn poll_consumers(&mut self) {
        for place in 0..self.node.consumers.len() {
            let Some(consumer) = self.node.consumers.get_mut(place) else { continue };
            let (true, Some(node_id)) = (consumer.timer.is_due(self.node.now), consumer.node_id) else {
                continue;
            };
            consumer.timer = Timer::OFF;
            consumer.state = None;
            let was_missing = core::mem::replace(&mut consumer.is_missing, true);
            self.found(EmcyError::HEARTBEAT, was_missing, true, [node_id.get(), 0, 0, 0, 0]);
            self.app.remote_state(&mut self.node, node_id, None);
            self.react_to_communication_error(EmcyError::HEARTBEAT);
        }
    }
}
