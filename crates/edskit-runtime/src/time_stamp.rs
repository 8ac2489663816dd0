//! TIME consumer: 1012h (CiA 301 v4.2, 7.2.6).

use crate::context::Context;
use crate::{Frame, TimeOfDay};
use edskit_types::{AbortCode, CanId, CobId, Index};

const TIME_COB_ID: Index = Index(0x1012);

impl Context<'_> {
    /// Whether an identifier is that of the TIME message, and the device takes it (bit 31).
    pub(crate) fn is_time(&self, can_id: CanId) -> bool {
        let cob_id = self.objects.value(TIME_COB_ID, 0).map(CobId);
        cob_id.is_some_and(|cob_id| cob_id.0 & CobId::BIT_31 != 0 && cob_id.can_id() == can_id)
    }

    pub(crate) fn time_received(&mut self, frame: &Frame) {
        let &[m0, m1, m2, m3, d0, d1] = frame.data() else { return };
        if self.is_communicating() {
            let milliseconds = u32::from_le_bytes([m0, m1, m2, m3]) & 0x0FFF_FFFF;
            let days = u16::from_le_bytes([d0, d1]);
            self.app.time_received(&mut self.objects, TimeOfDay { milliseconds, days });
        }
    }

    /// 1012h is about to be written: the node takes the message, but does not produce it. The identifier cannot change
    /// while the node takes it.
    pub(crate) fn check_time_cob_id(&self, old: CobId, new: CobId) -> Result<(), AbortCode> {
        self.check_cob_id(CobId(new.0 & !CobId::BIT_31))?;
        let is_consumer = |cob_id: CobId| cob_id.0 & CobId::BIT_31 != 0;
        if new.bit30() || (is_consumer(old) && is_consumer(new) && old.can_id() != new.can_id()) {
            return Err(AbortCode::INVALID_VALUE);
        }
        Ok(())
    }
}
