//! What the node does after a serious error of communication: 1029h (CiA 301 v4.2, 7.5.2.32).

use crate::context::Context;
use edskit_types::{Index, NmtState};

const ERROR_BEHAVIOUR: Index = Index(0x1029);
/// Sub-index 01h: communication errors.
const COMMUNICATION: u8 = 1;

impl Context<'_> {
    /// A heartbeat, the master's guarding, or the bus itself is gone.
    pub(crate) fn react_to_communication_error(&mut self) {
        match self.objects.value::<u8>(ERROR_BEHAVIOUR, COMMUNICATION).unwrap_or(0) {
            0 if self.core.state == NmtState::Operational => self.enter(NmtState::PreOperational),
            2 => self.enter(NmtState::Stopped),
            _ => {}
        }
    }
}
