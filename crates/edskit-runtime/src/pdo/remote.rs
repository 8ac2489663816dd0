//! Remote requests of TPDOs.

use super::Tpdo;
use crate::Application;
use crate::context::Context;
use edskit_types::{CanId, NmtState, Transmission};

/// Whether PDOs can be transmitted so as far as remote requests are concerned: in every way.
pub(super) fn knows(_: Transmission) -> bool {
    true
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// A remote frame that may ask for a TPDO. It is answered within the inhibit time too.
    pub(crate) fn tpdo_requested(&mut self, can_id: CanId) {
        if self.node.core.state != NmtState::Operational {
            return;
        }
        // Bit 30 of the COB-ID forbids remote requests, or the device does.
        let is_asked = |tpdo: &Tpdo| {
            tpdo.is_usable() && tpdo.parameters.allows_rtr && tpdo.parameters.can_id == Some(can_id)
        };
        let Some(place) = self.node.tpdos.iter().position(is_asked) else { return };
        let Some(tpdo) = self.node.tpdos.get_mut(place) else { return };
        if tpdo.meaning() != Transmission::RtrSynchronous || tpdo.sample.is_some() {
            tpdo.is_ready = true;
            self.send(place);
        }
    }
}
