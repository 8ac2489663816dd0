//! Without remote requests of TPDOs: they get no answer, and the transmission types FCh and FDh are reserved.

use crate::Application;
use crate::context::Context;
use edskit_types::{CanId, Transmission};

pub(super) fn knows(meaning: Transmission) -> bool {
    !matches!(meaning, Transmission::RtrSynchronous | Transmission::RtrEvent)
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(crate) fn tpdo_requested(&mut self, _: CanId) {}
}
