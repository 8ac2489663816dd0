//! A bus that a controller can leave.

use crate::{Bus, BusError, Event, Received, SendError};
use edskit_runtime::{Frame, Instant};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A bus whose controller can go bus-off: then it receives nothing, and [`SendError::BusOff`] is the answer to every
/// frame.
pub struct BusOff<B> {
    bus: B,
    switch: BusOffSwitch,
}

/// Switches the bus-off state of a [`BusOff`], also from another thread.
#[derive(Clone, Default)]
pub struct BusOffSwitch(Arc<AtomicBool>);

impl BusOffSwitch {
    /// Leaves the bus, or comes back to it.
    pub fn set(&self, is_off: bool) {
        self.0.store(is_off, Ordering::Relaxed);
    }

    /// Whether the controller is off the bus.
    #[must_use]
    pub fn is_off(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl<B: Bus> BusOff<B> {
    /// A bus that is on until the switch says otherwise.
    pub fn new(bus: B) -> Self {
        Self { bus, switch: BusOffSwitch::default() }
    }

    /// A handle to the switch.
    #[must_use]
    pub fn switch(&self) -> BusOffSwitch {
        self.switch.clone()
    }
}

impl<B: Bus> Bus for BusOff<B> {
    fn now(&self) -> Instant {
        self.bus.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        while let Some(received) = self.bus.receive()? {
            if !self.switch.is_off() {
                return Ok(Some(received));
            }
        }
        Ok(None)
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        if self.switch.is_off() { Err(SendError::BusOff) } else { self.bus.send(frame) }
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        self.bus.wait(deadline)
    }

    fn event(&mut self) -> Option<Event> {
        self.bus.event()
    }
}
