//! Synchronous PDOs: data that count, and messages that are sent, with the SYNC message.

use super::Tpdo;
use crate::Application;
use crate::context::Context;
use edskit_types::{NmtState, Transmission};

/// Whether the data of an RPDO wait for the SYNC message.
#[inline]
pub(super) fn waits_for_sync(meaning: Transmission) -> bool {
    meaning == Transmission::Synchronous
}

/// Whether PDOs can be transmitted so as far as SYNC is concerned: in every way.
pub(super) fn knows(_: Transmission) -> bool {
    true
}

impl Tpdo {
    /// Whether it is sent in the period that its SYNC message has begun, and in no other.
    #[inline]
    pub(super) fn is_of_a_period(&self) -> bool {
        matches!(self.meaning(), Transmission::SynchronousAcyclic | Transmission::SynchronousCyclic(_))
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// The SYNC message makes the data count that were received before it.
    pub(crate) fn apply_synchronous_rpdos(&mut self) {
        if self.node.core.state != NmtState::Operational {
            return;
        }
        for place in 0..self.node.rpdos.len() {
            let Some(rpdo) = self.node.rpdos.get_mut(place) else { continue };
            let Some(data) = rpdo.waiting.take() else { continue };
            let (number, slots) = (rpdo.parameters.number, rpdo.parameters.slots);
            self.scatter(number, slots, data);
            self.app.rpdo_received(&mut self.node, number);
        }
    }

    /// The SYNC message has come.
    pub(crate) fn send_synchronous_tpdos(&mut self, counter: Option<u8>) {
        if self.node.core.state != NmtState::Operational {
            return;
        }
        for place in 0..self.node.tpdos.len() {
            self.lose_late(place);
            let Some(tpdo) = self.node.tpdos.get_mut(place) else { continue };
            let has_turn = match tpdo.meaning() {
                Transmission::SynchronousAcyclic => tpdo.is_due,
                Transmission::SynchronousCyclic(every) => {
                    if tpdo.waits_for_start && counter.is_some() {
                        if counter != Some(tpdo.sync_start) {
                            continue;
                        }
                        tpdo.waits_for_start = false;
                        tpdo.syncs = every;
                    } else {
                        tpdo.syncs = tpdo.syncs.saturating_add(1);
                    }
                    let has_turn = tpdo.syncs >= every;
                    if has_turn {
                        tpdo.syncs = 0;
                    }
                    has_turn
                }
                Transmission::RtrSynchronous => true,
                _ => false,
            };
            if has_turn && tpdo.is_usable() {
                let sample = self.gather(place);
                let Some(tpdo) = self.node.tpdos.get_mut(place) else { continue };
                tpdo.sample = Some(sample);
                if tpdo.is_of_a_period() {
                    tpdo.is_due = false;
                    tpdo.is_ready = true;
                }
            }
        }
        self.poll_tpdos();
    }

    /// What could not be sent in the period that it belongs to is lost, and that is told.
    pub(super) fn lose_late(&mut self, place: usize) {
        let Some(tpdo) = self.node.tpdos.get_mut(place) else { return };
        if tpdo.is_ready && tpdo.is_of_a_period() && tpdo.sample.take().is_some() {
            tpdo.is_ready = false;
            self.node.core.queue.note_loss();
        }
    }
}
