//! What happens in the gateway, for those who watch it.

use super::eeprom::EepromErrors;
use super::error::{CanOpenError, GatewayError};
use super::parameter::Owner;
use super::state::State;
use super::telegram::StructureError;
use core::fmt;
use edskit_types::Conflict;
use heapless::Deque;

/// How many events wait for somebody to take them.
const CAPACITY: usize = 32;

/// Something that a person who watches the device wants to hear of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// A unit has lost its supply.
    Off(Owner),
    /// The program of a unit has started.
    Started(Owner),
    /// The gateway is in another state.
    State(State),
    /// An attempt to initialise the gateway has failed, by its number from 1.
    InitialisationFailed {
        /// Which attempt, 1 to 3.
        attempt: u8,
        /// Why.
        reason: Refusal,
    },
    /// An error of the gateway has come or gone.
    Error(
        /// Which.
        GatewayError,
        /// Whether it is present.
        bool,
    ),
    /// An error of CANopen has come or gone.
    CanOpenError(
        /// Which.
        CanOpenError,
        /// Whether it is present.
        bool,
    ),
    /// A start of the gateway has found bad pages in its EEPROM: 3099 EEPROMErrorCode, which lasts until a start that finds
    /// none (9.4; GW-APP-47).
    EepromErrors(EepromErrors),
    /// The error memory cannot be written.
    NotStored,
    /// So many events were lost, because nobody took them in time.
    Lost(u32),
}

/// Why an attempt to initialise the gateway has failed (7.3; GW-CFG-17).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The telegrams are not as they must be.
    Structure(StructureError),
    /// Two identifiers are equal, or one is reserved.
    Conflict(Conflict),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Structure(error) => error.fmt(f),
            Self::Conflict(conflict) => conflict.fmt(f),
        }
    }
}

/// Events that wait; where there are too many, the oldest go.
#[derive(Clone, Debug, Default)]
pub(super) struct Events {
    waiting: Deque<Event, CAPACITY>,
    lost: u32,
}

impl Events {
    pub(super) fn push(&mut self, event: Event) {
        if self.waiting.is_full() {
            self.waiting.pop_front();
            self.lost = self.lost.saturating_add(1);
        }
        // There is room for it now.
        let _ = self.waiting.push_back(event);
    }

    pub(super) fn pop(&mut self) -> Option<Event> {
        match core::mem::take(&mut self.lost) {
            0 => self.waiting.pop_front(),
            lost => Some(Event::Lost(lost)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oldest_events_go_and_are_counted() {
        let mut events = Events::default();
        for nth in 0..40 {
            events.push(Event::Error(GatewayError::Voltage, nth % 2 == 0));
        }
        assert_eq!(events.pop(), Some(Event::Lost(8)));
        assert_eq!(std::iter::from_fn(|| events.pop()).count(), 32);
    }
}
