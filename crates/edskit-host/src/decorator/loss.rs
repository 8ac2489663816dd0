//! A bus that loses frames.

use crate::{Bus, BusError, Event, Received, SendError};
use edskit_runtime::{Frame, Instant};
use fastrand::Rng;

/// A bus that loses frames in both directions, each with the same probability. Who sends one does not learn of it. The
/// same seed loses the same frames.
pub struct Loss<B> {
    bus: B,
    probability: f64,
    random: Rng,
}

impl<B: Bus> Loss<B> {
    /// Loses each frame of `bus` with a `probability` from 0 (none) to 1 (all).
    pub fn new(bus: B, probability: f64, seed: u64) -> Self {
        Self { bus, probability, random: Rng::with_seed(seed) }
    }

    fn is_lost(&mut self) -> bool {
        self.random.f64() < self.probability
    }
}

impl<B: Bus> Bus for Loss<B> {
    fn now(&self) -> Instant {
        self.bus.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        while let Some(received) = self.bus.receive()? {
            if !self.is_lost() {
                return Ok(Some(received));
            }
        }
        Ok(None)
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        if self.is_lost() { Ok(()) } else { self.bus.send(frame) }
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        self.bus.wait(deadline)
    }

    fn event(&mut self) -> Option<Event> {
        self.bus.event()
    }
}
