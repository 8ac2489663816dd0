//! Without SYNC: the message is neither taken nor produced.

use crate::Application;
use crate::context::Context;
use crate::time::Timer;
use crate::{Frame, Instant};
use edskit_types::{AbortCode, CanId, CobId};

#[derive(Debug)]
pub(crate) struct Sync;

impl Sync {
    pub(crate) const fn new() -> Self {
        Self
    }

    pub(crate) fn is(&self, _: CanId) -> bool {
        false
    }

    pub(crate) fn deadline(&self) -> Instant {
        Timer::OFF.deadline()
    }

    pub(crate) fn restart(&mut self, _: Instant) {}
}

/// What 1019h can be set to: no counter.
pub(crate) fn check_sync_overflow(value: u8) -> Result<(), AbortCode> {
    if value == 0 { Ok(()) } else { Err(AbortCode::INVALID_VALUE) }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(crate) fn configure_sync(&mut self) {}

    pub(crate) fn window_has_passed(&self) -> bool {
        false
    }

    /// What 1005h can be set to: an identifier, but the message cannot be produced.
    pub(crate) fn check_sync(&self, cob_id: CobId) -> Result<(), AbortCode> {
        if cob_id.bit30() {
            return Err(AbortCode::INVALID_VALUE);
        }
        self.node.check_cob_id(CobId(cob_id.0 & !CobId::BIT_31))
    }

    pub(crate) fn check_sync_change(&self, _: CobId) -> Result<(), AbortCode> {
        Ok(())
    }

    pub(crate) fn check_overflow_change(&self) -> Result<(), AbortCode> {
        Ok(())
    }

    pub(crate) fn sync_changed(&mut self) {}

    pub(crate) fn sync_length_found(&mut self, _: bool, _: u8) {}

    pub(crate) fn poll_sync(&mut self) {}

    pub(crate) fn sync_received(&mut self, _: &Frame) {}
}
