//! RPDOs: taking frames, the SYNC message, and the event time.

use super::Parameters;
use super::synchronous::waits_for_sync;
use crate::Application;
use crate::context::Context;
use crate::dictionary::raw;
use crate::time::Timer;
use crate::{EmcyError, Frame, Instant};
use edskit_types::{CanId, NmtState};

/// An RPDO at work.
#[derive(Clone, Copy, Debug)]
pub struct Rpdo {
    pub(super) parameters: Parameters,
    /// Runs from the first frame on.
    deadline: Timer,
    /// Data that wait for the SYNC message.
    pub(super) waiting: Option<u64>,
    /// Whether it is an error that no frame has come in time.
    is_late: bool,
    /// Whether it is an error that the last frame was too short.
    is_short: bool,
}

impl Rpdo {
    /// A place for an RPDO.
    pub const NEW: Self = Self {
        parameters: Parameters::NONE,
        deadline: Timer::OFF,
        waiting: None,
        is_late: false,
        is_short: false,
    };

    pub(crate) fn deadline(&self) -> Instant {
        self.deadline.deadline()
    }

    fn takes(&self, can_id: CanId) -> bool {
        self.parameters.can_id == Some(can_id)
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// What is left of an RPDO with other parameters. Of one that is not the same any more, nothing is. Data wait for SYNC
    /// only in a type that makes them wait. An event time that runs begins anew, and the error of the old one goes.
    pub(super) fn rpdo_changed(&mut self, place: usize, new: Parameters, is_remapped: bool) {
        let Some(rpdo) = self.node.rpdos.get_mut(place) else { return };
        let old = core::mem::replace(&mut rpdo.parameters, new);
        if !new.is_same_pdo(&old, is_remapped) {
            self.end_rpdo(place);
            self.shortness_found(place, false, 0);
            return;
        }
        if !waits_for_sync(new.meaning) {
            rpdo.waiting = None;
        }
        if new.event_time != old.event_time {
            if rpdo.deadline.is_running() {
                rpdo.deadline = Timer::after(self.node.now, new.event_time());
            }
            self.lateness_found(place, false);
        }
    }

    /// An RPDO is not received any more: nothing waits, and nothing is missed. That a frame was too short stays true.
    pub(super) fn end_rpdo(&mut self, place: usize) {
        let Some(rpdo) = self.node.rpdos.get_mut(place) else { return };
        rpdo.waiting = None;
        rpdo.deadline = Timer::OFF;
        self.lateness_found(place, false);
    }

    /// Whether no frame has come in time.
    fn lateness_found(&mut self, place: usize, is_late: bool) {
        let Some(rpdo) = self.node.rpdos.get_mut(place) else { return };
        let was_late = core::mem::replace(&mut rpdo.is_late, is_late);
        let [low, high] = rpdo.parameters.number.to_le_bytes();
        self.found(EmcyError::RPDO_TIME_OUT, was_late, is_late, [low, high, 0, 0, 0]);
    }

    /// Whether the last frame was too short.
    fn shortness_found(&mut self, place: usize, is_short: bool, length: u8) {
        let Some(rpdo) = self.node.rpdos.get_mut(place) else { return };
        let was_short = core::mem::replace(&mut rpdo.is_short, is_short);
        let [low, high] = rpdo.parameters.number.to_le_bytes();
        self.found(EmcyError::PDO_LENGTH, was_short, is_short, [low, high, length, 0, 0]);
    }

    /// A frame that may be that of one or more RPDOs; false where it is of none.
    pub(crate) fn rpdo_received(&mut self, can_id: CanId, frame: &Frame) -> bool {
        let mut is_taken = false;
        for place in 0..self.node.rpdos.len() {
            if self.node.rpdos.get(place).is_some_and(|rpdo| rpdo.takes(can_id)) {
                is_taken = true;
                if self.node.core.state == NmtState::Operational {
                    self.take(place, frame);
                }
            }
        }
        is_taken
    }

    fn take(&mut self, place: usize, frame: &Frame) {
        let Some(Rpdo { parameters, .. }) = self.node.rpdos.get(place) else { return };
        let Parameters { number, slots, meaning, .. } = *parameters;
        let Some(data) = frame.data().get(..slots.bytes()) else {
            self.shortness_found(place, true, frame.data().len() as u8);
            return;
        };
        let data = raw(data, false);
        let is_synchronous = waits_for_sync(meaning);
        let is_in_time = !is_synchronous || !self.window_has_passed();
        let Some(rpdo) = self.node.rpdos.get_mut(place) else { return };
        rpdo.deadline = Timer::after(self.node.now, rpdo.parameters.event_time());
        if is_synchronous && is_in_time {
            rpdo.waiting = Some(data);
        }
        if rpdo.is_short || rpdo.is_late {
            self.shortness_found(place, false, 0);
            self.lateness_found(place, false);
        }
        if !is_synchronous {
            self.scatter(number, slots, data);
            self.app.rpdo_received(&mut self.node, number);
        }
    }

    pub(crate) fn poll_rpdos(&mut self) {
        for place in 0..self.node.rpdos.len() {
            let Some(rpdo) = self.node.rpdos.get_mut(place) else { continue };
            if rpdo.deadline.is_due(self.node.now) {
                rpdo.deadline = Timer::OFF;
                let number = rpdo.parameters.number;
                self.lateness_found(place, true);
                self.app.rpdo_timed_out(&mut self.node, number);
            }
        }
    }
}
