//! Node guarding and life guarding (CiA 301 v4.2, 7.2.8.3.1).

use crate::Application;
use crate::context::Context;
use crate::nmt::error_control;
use crate::time::Timer;
use crate::{EmcyError, Instant, Microseconds};
use edskit_types::{AbortCode, CanId, Index};

const GUARD_TIME: Index = Index(0x100C);
const LIFE_TIME_FACTOR: Index = Index(0x100D);

#[derive(Debug)]
pub(crate) struct Guarding {
    toggle: bool,
    /// Runs from the first request on.
    life: Timer,
    /// Whether it is an error that the master's requests are missing.
    is_missing: bool,
}

impl Guarding {
    pub(crate) const fn new() -> Self {
        Self { toggle: false, life: Timer::OFF, is_missing: false }
    }

    pub(crate) fn deadline(&self) -> Instant {
        self.life.deadline()
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// A remote frame with the identifier of a heartbeat. Heartbeat has precedence over guarding, and a device without
    /// 100Ch knows no guarding.
    pub(crate) fn guarding_request(&mut self, can_id: CanId) {
        let own = self.node.core.node_id.map(error_control);
        let is_guarded = self.node.objects.value::<u16>(GUARD_TIME, 0).is_some();
        if own != Some(can_id) || !is_guarded || self.node.core.producer.is_running() {
            return;
        }
        // The toggle bit tells the master which answers were sent.
        if self.node.core.queue.room() > 0 {
            let toggle = u8::from(self.node.core.guarding.toggle) << 7;
            self.node.core.queue.send(can_id, &[toggle | self.node.core.state.code()]);
            self.node.core.guarding.toggle = !self.node.core.guarding.toggle;
        } else {
            self.node.core.queue.note_loss();
        }
        self.node.core.guarding.life = Timer::after(self.node.now, self.life_time());
        self.master_found(false);
    }

    /// Whether the requests of the master are missing.
    fn master_found(&mut self, is_missing: bool) {
        let was_missing = core::mem::replace(&mut self.node.core.guarding.is_missing, is_missing);
        self.found(EmcyError::HEARTBEAT, was_missing, is_missing, [0; 5]);
    }

    /// Guarding ends with all it had: there is one error control protocol at a time (7.2.8.3).
    pub(crate) fn end_guarding(&mut self) {
        self.master_found(false);
        self.node.core.guarding = Guarding::new();
    }

    /// The product of 100Ch and 100Dh.
    fn life_time(&self) -> Microseconds {
        let guard_time: u16 = self.node.objects.value(GUARD_TIME, 0).unwrap_or_default();
        let factor: u8 = self.node.objects.value(LIFE_TIME_FACTOR, 0).unwrap_or_default();
        Microseconds::from_milliseconds(u32::from(guard_time) * u32::from(factor))
    }

    /// What 100Ch can be set to: anything.
    pub(crate) fn check_guard_time(&self, _: &[u8]) -> Result<(), AbortCode> {
        Ok(())
    }

    /// What follows from 100Ch and 100Dh: a life time that runs begins anew, and an error of the old one is none any more.
    pub(crate) fn guarding_changed(&mut self) {
        self.master_found(false);
        if self.node.core.guarding.life.is_running() {
            self.node.core.guarding.life = Timer::after(self.node.now, self.life_time());
        }
    }

    pub(crate) fn poll_guarding(&mut self) {
        if self.node.core.guarding.life.is_due(self.node.now) {
            self.node.core.guarding.life = Timer::OFF;
            self.master_found(true);
            self.react_to_communication_error(EmcyError::HEARTBEAT);
        }
    }
}
