//! RPDOs: taking frames, the SYNC message, and the event time.

use super::Parameters;
use super::mapping::scatter;
use crate::context::Context;
use crate::dictionary::raw;
use crate::time::Timer;
use crate::{Error, Frame, Instant};
use edskit_types::{CanId, NmtState, PdoDirection};

/// An RPDO at work.
#[derive(Clone, Copy, Debug)]
pub struct Rpdo {
    pub(super) parameters: Parameters,
    /// Runs from the first frame on.
    pub(super) deadline: Timer,
    /// Data that wait for the SYNC message.
    pub(super) waiting: Option<u64>,
}

impl Rpdo {
    /// A place for an RPDO.
    pub const NEW: Self = Self { parameters: Parameters::NONE, deadline: Timer::OFF, waiting: None };

    pub(crate) fn deadline(&self) -> Instant {
        self.deadline.deadline()
    }

    fn takes(&self, can_id: CanId) -> bool {
        self.parameters.can_id == Some(can_id)
    }
}

impl Context<'_> {
    /// A frame that may be that of one or more RPDOs; false where it is of none.
    pub(crate) fn rpdo_received(&mut self, can_id: CanId, frame: &Frame) -> bool {
        let mut is_taken = false;
        for place in 0..self.rpdos.len() {
            if self.rpdos.get(place).is_some_and(|rpdo| rpdo.takes(can_id)) {
                is_taken = true;
                if self.core.state == NmtState::Operational {
                    self.take(place, frame);
                }
            }
        }
        is_taken
    }

    fn take(&mut self, place: usize, frame: &Frame) {
        let Some(rpdo) = self.rpdos.get_mut(place) else { return };
        let number = rpdo.parameters.number;
        let Some(data) = frame.data().get(..rpdo.parameters.slots.bytes()) else {
            let [low, high] = number.to_le_bytes();
            let length = frame.data().len() as u8;
            self.raise(Error::PDO_LENGTH, number, [low, high, length, 0, 0]);
            return;
        };
        let data = raw(data, false);
        rpdo.deadline = Timer::after(self.now, rpdo.parameters.event_time);
        let slots = rpdo.parameters.slots;
        let is_synchronous = rpdo.parameters.transmission.is_synchronous(PdoDirection::Receive);
        if is_synchronous {
            if !self.core.sync.window_has_passed(self.now) {
                rpdo.waiting = Some(data);
            }
        } else {
            scatter(&mut self.objects, slots.of(self.mapped), data);
            self.app.rpdo_received(&mut self.objects, number);
        }
        self.clear(Error::PDO_LENGTH, number);
        self.clear(Error::RPDO_TIME_OUT, number);
    }

    /// The SYNC message makes the data count that were received before it.
    pub(crate) fn apply_synchronous_rpdos(&mut self) {
        if self.core.state != NmtState::Operational {
            return;
        }
        for place in 0..self.rpdos.len() {
            let Some(rpdo) = self.rpdos.get_mut(place) else { continue };
            let Some(data) = rpdo.waiting.take() else { continue };
            let (number, slots) = (rpdo.parameters.number, rpdo.parameters.slots);
            scatter(&mut self.objects, slots.of(self.mapped), data);
            self.app.rpdo_received(&mut self.objects, number);
        }
    }

    pub(crate) fn poll_rpdos(&mut self) {
        for place in 0..self.rpdos.len() {
            let Some(rpdo) = self.rpdos.get_mut(place) else { continue };
            if rpdo.deadline.is_due(self.now) {
                rpdo.deadline = Timer::OFF;
                let number = rpdo.parameters.number;
                let [low, high] = number.to_le_bytes();
                self.raise(Error::RPDO_TIME_OUT, number, [low, high, 0, 0, 0]);
                self.app.rpdo_timed_out(&mut self.objects, number);
            }
        }
    }
}
