//! A bus that doubles frames.

use crate::{Bus, BusError, Event, Received, SendError};
use edskit_runtime::{Frame, Instant};
use fastrand::Rng;

/// A bus that doubles frames in both directions, each with the same probability, as a CAN bus does when an error hits the
/// last bit of a frame: some have it already and get it again. The same seed doubles the same frames.
pub struct Duplication<B> {
    bus: B,
    probability: f64,
    random: Rng,
    again: Option<Received>,
}

impl<B: Bus> Duplication<B> {
    /// Doubles each frame of `bus` with a `probability` from 0 (none) to 1 (all).
    pub fn new(bus: B, probability: f64, seed: u64) -> Self {
        Self { bus, probability, random: Rng::with_seed(seed), again: None }
    }

    fn is_doubled(&mut self) -> bool {
        self.random.f64() < self.probability
    }
}

impl<B: Bus> Bus for Duplication<B> {
    fn now(&self) -> Instant {
        self.bus.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        if let Some(again) = self.again.take() {
            return Ok(Some(again));
        }
        let received = self.bus.receive()?;
        if received.is_some() && self.is_doubled() {
            self.again = received;
        }
        Ok(received)
    }

    /// A double for which there is no room is left out.
    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        self.bus.send(frame)?;
        if self.is_doubled() {
            // The frame itself has been taken, and that is what counts.
            let _ = self.bus.send(frame);
        }
        Ok(())
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        if self.again.is_some() { Ok(()) } else { self.bus.wait(deadline) }
    }

    fn event(&mut self) -> Option<Event> {
        self.bus.event()
    }
}
