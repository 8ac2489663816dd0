//! RPDOs: taking frames, the SYNC message, and the event time.

use super::INVALID;
use super::mapping::{Slots, scatter};
use crate::context::Context;
use crate::dictionary::raw;
use crate::time::Timer;
use crate::{Error, Frame, Instant, Microseconds};
use edskit_types::{CanId, CobId, NmtState, PdoDirection, TransmissionType};

/// An RPDO at work.
#[derive(Clone, Copy, Debug)]
pub struct Rpdo {
    /// Its number from 1; 0 for a place that no PDO takes.
    pub(super) number: u16,
    pub(super) cob_id: CobId,
    pub(super) transmission: TransmissionType,
    /// The longest time between two frames; 0 where it is not monitored.
    pub(super) event_time: Microseconds,
    pub(super) slots: Slots,
    /// Runs from the first frame on.
    pub(super) deadline: Timer,
    /// Data that wait for the SYNC message.
    pub(super) waiting: Option<u64>,
}

impl Rpdo {
    /// A place for an RPDO.
    pub const NEW: Self = Self {
        number: 0,
        cob_id: INVALID,
        transmission: TransmissionType(0xFF),
        event_time: Microseconds(0),
        slots: Slots::NONE,
        deadline: Timer::OFF,
        waiting: None,
    };

    pub(crate) fn deadline(&self) -> Instant {
        self.deadline.deadline()
    }

    fn takes(&self, can_id: CanId) -> bool {
        self.cob_id.is_valid() && self.cob_id.can_id() == can_id
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
        let number = rpdo.number;
        let Some(data) = frame.data().get(..rpdo.slots.bytes()) else {
            let [low, high] = number.to_le_bytes();
            let length = frame.data().len() as u8;
            self.raise(Error::PDO_LENGTH, number, [low, high, length, 0, 0]);
            return;
        };
        let data = raw(data, false);
        rpdo.deadline = Timer::after(self.now, rpdo.event_time);
        let slots = rpdo.slots;
        let is_synchronous = rpdo.transmission.is_synchronous(PdoDirection::Receive);
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
            let (number, slots) = (rpdo.number, rpdo.slots);
            scatter(&mut self.objects, slots.of(self.mapped), data);
            self.app.rpdo_received(&mut self.objects, number);
        }
    }

    pub(crate) fn poll_rpdos(&mut self) {
        for place in 0..self.rpdos.len() {
            let Some(rpdo) = self.rpdos.get_mut(place) else { continue };
            if rpdo.deadline.is_due(self.now) {
                rpdo.deadline = Timer::OFF;
                let number = rpdo.number;
                let [low, high] = number.to_le_bytes();
                self.raise(Error::RPDO_TIME_OUT, number, [low, high, 0, 0, 0]);
                self.app.rpdo_timed_out(&mut self.objects, number);
            }
        }
    }
}
