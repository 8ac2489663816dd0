//! Without TIME: the message is not taken.

use crate::Application;
use crate::Frame;
use crate::context::Context;
use edskit_types::{AbortCode, CanId, CobId};

impl<A: Application + ?Sized> Context<'_, A> {
    pub(crate) fn is_time(&self, _: CanId) -> bool {
        false
    }

    pub(crate) fn time_received(&mut self, _: &Frame) {}

    /// What 1012h can be set to: an identifier, but the message can be neither taken nor produced.
    pub(crate) fn check_time(&self, cob_id: CobId) -> Result<(), AbortCode> {
        if cob_id.0 & (CobId::BIT_31 | CobId::BIT_30) != 0 {
            return Err(AbortCode::INVALID_VALUE);
        }
        self.node.check_cob_id(cob_id)
    }

    pub(crate) fn check_time_change(&self, _: CobId) -> Result<(), AbortCode> {
        Ok(())
    }
}
