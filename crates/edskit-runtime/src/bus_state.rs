//! What the CAN controller tells of the bus.

use crate::Application;
use crate::EmcyError;
use crate::context::Context;

/// The state of a CAN controller (ISO 11898-1).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BusState {
    /// It takes part in everything.
    Active,
    /// The same, but one of its error counters has reached the warning limit, 96.
    Warning,
    /// It does not destroy the frames of others any more: one of its error counters is above 127.
    Passive,
    /// It takes part in nothing.
    Off,
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// The CAN controller is in this state.
    pub(crate) fn bus_found(&mut self, state: BusState) {
        let was = core::mem::replace(&mut self.node.core.bus_state, state);
        self.found(EmcyError::ERROR_PASSIVE, was == BusState::Passive, state == BusState::Passive, [0; 5]);
        match (was, state) {
            (BusState::Off, BusState::Off) => {}
            (_, BusState::Off) => self.react_to_communication_error(EmcyError::BUS_OFF),
            (BusState::Off, _) => {
                // What has happened is told; it is over as soon as it is told.
                self.found(EmcyError::BUS_OFF_RECOVERED, false, true, [0; 5]);
                self.found(EmcyError::BUS_OFF_RECOVERED, true, false, [0; 5]);
            }
            _ => {}
        }
    }
}
