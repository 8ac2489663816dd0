//! TIME consumer: 1012h (CiA 301 v4.2, 7.2.6).

use crate::Application;
use crate::context::Context;
use crate::{Frame, TimeOfDay};
use edskit_types::{AbortCode, CanId, CobId, Index};

const TIME_COB_ID: Index = Index(0x1012);

impl<A: Application + ?Sized> Context<'_, A> {
    /// Whether an identifier is that of the TIME message, and the device takes it (bit 31).
    pub(crate) fn is_time(&self, can_id: CanId) -> bool {
        self.time_can_id() == Some(can_id)
    }

    /// The identifier of the message; `None` where the device does not take it, or 1012h cannot be used.
    fn time_can_id(&self) -> Option<CanId> {
        let cob_id = self.node.objects.value(TIME_COB_ID, 0).map(CobId)?;
        let is_taken = cob_id.0 & CobId::BIT_31 != 0 && self.check_time(cob_id).is_ok();
        is_taken.then(|| cob_id.can_id())
    }

    pub(crate) fn time_received(&mut self, frame: &Frame) {
        let &[m0, m1, m2, m3, d0, d1] = frame.data() else { return };
        if self.node.is_communicating() {
            let milliseconds = u32::from_le_bytes([m0, m1, m2, m3]) & 0x0FFF_FFFF;
            let days = u16::from_le_bytes([d0, d1]);
            self.app.time_received(&mut self.node, TimeOfDay { milliseconds, days });
        }
    }

    /// What 1012h can be set to: the node takes the message, but does not produce it.
    pub(crate) fn check_time(&self, cob_id: CobId) -> Result<(), AbortCode> {
        if cob_id.bit30() {
            return Err(AbortCode::INVALID_VALUE);
        }
        self.node.check_cob_id(CobId(cob_id.0 & !CobId::BIT_31))
    }

    /// 1012h is about to be written. The identifier cannot change while the node takes the message.
    pub(crate) fn check_time_change(&self, new: CobId) -> Result<(), AbortCode> {
        match self.time_can_id() {
            Some(old) if new.0 & CobId::BIT_31 != 0 && old != new.can_id() => Err(AbortCode::INVALID_VALUE),
            _ => Ok(()),
        }
    }
}
