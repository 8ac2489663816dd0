//! Without heartbeat consumer: no other node is monitored.

use crate::Application;
use crate::context::Context;
use crate::time::Timer;
use crate::{Frame, Instant};
use edskit_types::{AbortCode, CanId, NodeId, SubIndex};

/// What is known of a node whose heartbeat is monitored: nothing, as the crate is built without its feature
/// `heartbeat-consumer`.
#[derive(Clone, Copy, Debug)]
pub struct HeartbeatConsumer;

impl HeartbeatConsumer {
    /// A place for a node that is monitored.
    pub const NEW: Self = Self;

    pub(crate) fn deadline(&self) -> Instant {
        Timer::OFF.deadline()
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(crate) fn configure_consumers(&mut self) {}

    /// What 1016h can be set to: what monitors no node.
    pub(crate) fn check_consumer(&self, _: SubIndex, value: u32) -> Result<(), AbortCode> {
        let is_used = value & 0xFFFF > 0 && NodeId::new((value >> 16) as u8).is_ok();
        if is_used || value >> 24 != 0 { Err(AbortCode::INVALID_VALUE) } else { Ok(()) }
    }

    pub(crate) fn consumer_changed(&mut self, _: SubIndex) {}

    pub(crate) fn heartbeat_received(&mut self, _: CanId, _: &Frame) {}

    pub(crate) fn poll_consumers(&mut self) {}
}
