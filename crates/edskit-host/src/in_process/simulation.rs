//! Driving several participants through virtual time.

use super::VirtualBus;
use edskit_runtime::{Instant, Microseconds};

/// Something that acts on a virtual bus: a device, a tool, a physical model.
pub trait Actor {
    /// Takes what has arrived and does what is due at `now`. Returns when it wants to act next, [`Instant::NEVER`] for only
    /// when a frame arrives.
    fn act(&mut self, now: Instant) -> Instant;
}

impl<F: FnMut(Instant) -> Instant> Actor for F {
    fn act(&mut self, now: Instant) -> Instant {
        self(now)
    }
}

/// Lets `actors` act on `bus` until the time is `until`. They act in their order at the start, whenever one of them wants
/// to, and whenever a frame arrives. An actor that wants to act at a time that is not later than now acts again a
/// microsecond later, so the time always moves.
///
/// ```
/// use edskit_host::{Bus, VirtualBus, simulate};
/// use edskit_runtime::{Frame, Instant, Microseconds};
/// use edskit_types::{Bitrate, CanId};
///
/// let bus = VirtualBus::new(Bitrate::Kbit500);
/// let (mut device, mut tool) = (bus.attach(), bus.attach());
/// let heartbeat = Frame::new(CanId::standard(0x705).unwrap(), &[5]);
/// let mut next = Instant(0);
/// let mut produce = |now: Instant| {
///     if now >= next {
///         device.send(&heartbeat).expect("the bus has room");
///         next = next + Microseconds::from_milliseconds(100);
///     }
///     next
/// };
/// let mut heard = 0;
/// let mut consume = |_| {
///     while tool.receive().expect("a virtual bus stays").is_some() {
///         heard += 1;
///     }
///     Instant::NEVER
/// };
/// simulate(&bus, &mut [&mut produce, &mut consume], Instant(1_000_000));
/// assert_eq!(heard, 10);
/// ```
pub fn simulate(bus: &VirtualBus, actors: &mut [&mut dyn Actor], until: Instant) {
    loop {
        let now = bus.now();
        let wanted = actors.iter_mut().map(|actor| actor.act(now)).min().unwrap_or(Instant::NEVER);
        if now >= until {
            return;
        }
        let next = wanted.max(now + Microseconds(1)).min(until);
        if bus.step(next) == now {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Bus;
    use edskit_runtime::Frame;
    use edskit_types::{Bitrate, CanId};

    #[test]
    fn the_same_simulation_gives_the_same_frames() {
        let run = || {
            let bus = VirtualBus::new(Bitrate::Kbit250);
            let (mut ping, mut pong, mut log) = (bus.attach(), bus.attach(), bus.attach());
            let mut recorded = Vec::new();
            let mut asks = |now: Instant| {
                if now.0.is_multiple_of(1_000) {
                    ping.send(&Frame::new(CanId::standard(0x601).unwrap(), &[now.0 as u8])).unwrap();
                }
                while ping.receive().unwrap().is_some() {}
                Instant((now.0 / 1_000 + 1) * 1_000)
            };
            let mut answers = |_| {
                while let Some(received) = pong.receive().unwrap() {
                    pong.send(&Frame::new(CanId::standard(0x581).unwrap(), received.frame.data())).unwrap();
                }
                Instant::NEVER
            };
            let mut records = |_| {
                recorded.extend(std::iter::from_fn(|| log.receive().unwrap()));
                Instant::NEVER
            };
            simulate(&bus, &mut [&mut asks, &mut answers, &mut records], Instant(20_500));
            recorded
        };
        let recorded = run();
        assert_eq!(recorded.len(), 42);
        assert!(recorded.windows(2).all(|pair| pair[0].time < pair[1].time));
        assert_eq!(recorded, run());
    }

    #[test]
    fn an_impatient_actor_does_not_stop_the_time() {
        let bus = VirtualBus::new(Bitrate::Kbit250);
        let mut calls = 0;
        let mut impatient = |now| {
            calls += 1;
            now
        };
        simulate(&bus, &mut [&mut impatient], Instant(100));
        assert_eq!((bus.now(), calls), (Instant(100), 101));
    }

    #[test]
    fn without_anything_to_do_it_ends() {
        let bus = VirtualBus::new(Bitrate::Kbit250);
        simulate(&bus, &mut [&mut |_| Instant::NEVER], Instant::NEVER);
        assert_eq!(bus.now(), Instant(0));
    }
}
