//! What the node does after a serious error of communication: 1029h (CiA 301 v4.2, 7.5.2.32).

use crate::context::Context;
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

impl Context<'_> {
    /// A heartbeat, the master's guarding, or the bus itself is gone.
    pub(crate) fn react_to_communication_error(&mut self) {
        let behaviour = self.node.objects.value::<u8>(ERROR_BEHAVIOUR, COMMUNICATION);
        match behaviour.filter(|value| check_error_behaviour(*value).is_ok()).unwrap_or(0) {
            0 if self.node.core.state == NmtState::Operational => self.enter(NmtState::PreOperational),
            2 => self.enter(NmtState::Stopped),
            _ => {}
        }
    }
}
