//! A bus that is late.

use crate::{Bus, BusError, Event, Received, SendError};
use edskit_runtime::{Frame, Instant, Microseconds};
use fastrand::Rng;
use std::collections::VecDeque;

/// How many frames are held in each direction.
const MOST_HELD: usize = 4096;

/// When a frame is handed over again for which the bus had no room.
const AGAIN: Microseconds = Microseconds(1_000);

/// A bus that delivers frames late in both directions: after a fixed time and a random one on top. Frames keep their order.
/// The same seed gives the same times.
///
/// Held frames move when the bus is used: who sends has to call [`Bus::wait`] or [`Bus::receive`] for the frames to leave.
/// A frame that the bus refuses for another reason than lack of room is gone.
pub struct Delay<B> {
    bus: B,
    fixed: Microseconds,
    jitter: Microseconds,
    random: Rng,
    /// Each with the time when it is due.
    incoming: VecDeque<Received>,
    outgoing: VecDeque<Received>,
}

impl<B: Bus> Delay<B> {
    /// Delays each frame by `fixed` and up to `jitter` more.
    pub fn new(bus: B, fixed: Microseconds, jitter: Microseconds, seed: u64) -> Self {
        let random = Rng::with_seed(seed);
        Self { bus, fixed, jitter, random, incoming: VecDeque::new(), outgoing: VecDeque::new() }
    }

    /// When a frame of `time` is due, and not before the one before it.
    fn due(&mut self, time: Instant, before: Option<Instant>) -> Instant {
        let late = time + self.fixed + Microseconds(self.random.u64(0..=self.jitter.0));
        before.map_or(late, |before| before.max(late))
    }

    /// Takes in what has arrived and hands over what is due.
    fn pump(&mut self) -> Result<(), BusError> {
        while self.incoming.len() < MOST_HELD
            && let Some(received) = self.bus.receive()?
        {
            let time = self.due(received.time, self.incoming.back().map(|last| last.time));
            self.incoming.push_back(Received { time, ..received });
        }
        let now = self.bus.now();
        while let Some(first) = self.outgoing.front_mut().filter(|first| first.time <= now) {
            if let Err(SendError::Full) = self.bus.send(&first.frame) {
                first.time = now + AGAIN;
                break;
            }
            self.outgoing.pop_front();
        }
        Ok(())
    }
}

impl<B: Bus> Bus for Delay<B> {
    fn now(&self) -> Instant {
        self.bus.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        self.pump()?;
        let now = self.bus.now();
        let is_due = self.incoming.front().is_some_and(|first| first.time <= now);
        Ok(if is_due { self.incoming.pop_front() } else { None })
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        if self.outgoing.len() >= MOST_HELD {
            return Err(SendError::Full);
        }
        let time = self.due(self.bus.now(), self.outgoing.back().map(|last| last.time));
        self.outgoing.push_back(Received { time, frame: *frame });
        Ok(())
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        self.pump()?;
        let due = |held: &VecDeque<Received>| held.front().map_or(Instant::NEVER, |first| first.time);
        self.bus.wait(deadline.min(due(&self.incoming)).min(due(&self.outgoing)))?;
        self.pump()
    }

    fn event(&mut self) -> Option<Event> {
        self.bus.event()
    }
}
