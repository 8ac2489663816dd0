//! What the node does after a serious error of communication: 1029h (CiA 301 v4.2, 7.5.2.32).

use crate::Application;
use crate::EmcyError;
use crate::context::Context;
use crate::services::Services;
use edskit_types::{AbortCode, Index, NmtState};

const ERROR_BEHAVIOUR: Index = Index(0x1029);
/// Sub-index 01h: communication errors.
const COMMUNICATION: u8 = 1;

/// From here on the values mean what the manufacturer says.
const MANUFACTURER: u8 = 0x80;

/// What 1029h can be set to: values from 03h to 7Fh are reserved.
pub(crate) fn check_error_behaviour(value: u8) -> Result<(), AbortCode> {
    if (3..MANUFACTURER).contains(&value) { Err(AbortCode::INVALID_VALUE) } else { Ok(()) }
}

impl Services<'_> {
    /// The state that an error of a class leads to: 1029h with the sub-index of the class, 01h for communication errors, the
    /// others as the device profile or the manual says. `None` where the state stays.
    #[must_use]
    pub fn error_behaviour(&self, class: u8) -> Option<NmtState> {
        let behaviour = self.objects.value::<u8>(ERROR_BEHAVIOUR, class);
        match behaviour.filter(|value| check_error_behaviour(*value).is_ok()).unwrap_or(0) {
            0 if self.core.state == NmtState::Operational => Some(NmtState::PreOperational),
            2 => Some(NmtState::Stopped),
            _ => None,
        }
    }

    /// A serious error of a class has occurred in the device: the node enters the state that 1029h prescribes for it, at the
    /// end of its call or with its next [`poll`](crate::Node::poll).
    pub fn react(&mut self, class: u8) {
        if let Some(state) = self.error_behaviour(class) {
            self.enter(state);
        }
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// A heartbeat, the master's guarding, or the bus itself is gone.
    pub(crate) fn react_to_communication_error(&mut self, error: EmcyError) {
        let prescribed = self.node.error_behaviour(COMMUNICATION);
        if let Some(state) = self.app.reaction(&mut self.node, error, prescribed) {
            self.enter(state);
        }
    }
}
