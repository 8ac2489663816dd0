//! Without guarding: remote frames with the identifier of the heartbeat get no answer.

use crate::Application;
use crate::Instant;
use crate::Value;
use crate::context::Context;
use crate::time::Timer;
use edskit_types::{AbortCode, CanId};

#[derive(Debug)]
pub(crate) struct Guarding;

impl Guarding {
    pub(crate) const fn new() -> Self {
        Self
    }

    pub(crate) fn deadline(&self) -> Instant {
        Timer::OFF.deadline()
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(crate) fn guarding_request(&mut self, _: CanId) {}

    pub(crate) fn end_guarding(&mut self) {}

    /// What 100Ch can be set to: 0.
    pub(crate) fn check_guard_time(&self, data: &[u8]) -> Result<(), AbortCode> {
        if u16::from_bytes(data) > 0 { Err(AbortCode::INVALID_VALUE) } else { Ok(()) }
    }

    pub(crate) fn guarding_changed(&mut self) {}

    pub(crate) fn poll_guarding(&mut self) {}
}
