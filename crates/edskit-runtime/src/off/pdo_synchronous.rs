//! Without SYNC: synchronous transmission types are reserved, so no PDO has one.

use super::Tpdo;
use crate::Application;
use crate::context::Context;
use edskit_types::Transmission;

pub(super) fn waits_for_sync(_: Transmission) -> bool {
    false
}

pub(super) fn knows(meaning: Transmission) -> bool {
    !matches!(
        meaning,
        Transmission::Synchronous
            | Transmission::SynchronousAcyclic
            | Transmission::SynchronousCyclic(_)
            | Transmission::RtrSynchronous
    )
}

impl Tpdo {
    pub(super) fn is_of_a_period(&self) -> bool {
        false
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(super) fn lose_late(&mut self, _: usize) {}
}
