//! The wire that participants share, and its time.

use super::arbitration::priority;
use super::bit_time::{INTERMISSION, frame_bits};
use crate::{Bus, BusError, Event, Received, SendError};
use edskit_runtime::{Frame, Instant};
use edskit_types::Bitrate;
use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

/// How many frames of a participant may wait for the bus.
const MOST_PENDING: usize = 64;

/// How many frames a participant can leave untaken.
const MOST_UNTAKEN: usize = 4096;

/// A bus in virtual time: nothing happens until somebody moves the time, and the same calls always give the same frames
/// at the same times.
///
/// Frames that wait compete bit by bit, as on the wire: by identifier, a standard frame before an extended one with the
/// same first bits, a data frame before a remote frame. A participant's own frames compete in the same way, as those of a
/// controller that sends its mailboxes by identifier; frames of the same identifier keep their order. (Where two
/// participants send the same identifier at once, a real bus has an error; here the frame that was handed over first
/// goes first.) A frame occupies the bus for as long as its bits take, stuff bits included ([`frame_bits`]), and arrives
/// with the last bit of its end of frame, rounded up to whole microseconds.
///
/// It takes no threads: a clone is another handle to the same bus.
#[derive(Clone)]
pub struct VirtualBus(Rc<RefCell<Medium>>);

/// A participant of a [`VirtualBus`].
pub struct Participant {
    bus: VirtualBus,
    number: usize,
    /// Frames lost that nobody has been told of.
    lost: u64,
}

struct Medium {
    /// Nanoseconds per bit: a whole number for all bit rates of CANopen.
    bit: u64,
    now: Instant,
    /// When the last frame and its intermission end, in nanoseconds.
    free: u64,
    in_flight: Option<InFlight>,
    pending: Vec<Pending>,
    next_serial: u64,
    inboxes: Vec<Inbox>,
}

struct Pending {
    /// Who wins: arbitration, then the order of handing over.
    rank: (u32, u64),
    sender: usize,
    /// When it was handed over, in nanoseconds.
    since: u64,
    frame: Frame,
}

struct InFlight {
    sender: usize,
    frame: Frame,
    /// When the receivers have it, in nanoseconds.
    end: u64,
}

#[derive(Default)]
struct Inbox {
    frames: VecDeque<Received>,
    lost: u64,
    is_gone: bool,
}

impl VirtualBus {
    /// A bus without participants, at time 0.
    #[must_use]
    pub fn new(bitrate: Bitrate) -> Self {
        Self(Rc::new(RefCell::new(Medium {
            bit: 1_000_000 / u64::from(bitrate.kbit_per_s()),
            now: Instant(0),
            free: 0,
            in_flight: None,
            pending: Vec::new(),
            next_serial: 0,
            inboxes: Vec::new(),
        })))
    }

    /// A further participant. When it is dropped, it leaves the bus; frames that it has handed over are still sent.
    #[must_use]
    pub fn attach(&self) -> Participant {
        let mut medium = self.0.borrow_mut();
        medium.inboxes.push(Inbox::default());
        Participant { bus: self.clone(), number: medium.inboxes.len() - 1, lost: 0 }
    }

    /// The time on the bus, in microseconds since its making.
    #[must_use]
    pub fn now(&self) -> Instant {
        self.0.borrow().now
    }

    /// When the next frame arrives, as things stand; never where no frame is under way or waits.
    #[must_use]
    pub fn next_event(&self) -> Instant {
        let medium = self.0.borrow();
        let end = match &medium.in_flight {
            Some(in_flight) => Some(in_flight.end),
            None => medium
                .winner()
                .map(|(start, place)| start.saturating_add(medium.duration(&medium.pending[place].frame))),
        };
        end.map_or(Instant::NEVER, microseconds)
    }

    /// Moves the time to `to` and delivers every frame that arrives until then. An earlier time changes nothing.
    pub fn advance(&self, to: Instant) {
        self.0.borrow_mut().advance(to);
    }

    /// Moves the time to the next frame that arrives, or to `limit` if that is earlier, and says which time it is then.
    /// Without any frame and without a limit it stays.
    pub fn step(&self, limit: Instant) -> Instant {
        let to = self.next_event().min(limit);
        if to != Instant::NEVER {
            self.advance(to);
        }
        self.now()
    }
}

impl Medium {
    fn advance(&mut self, to: Instant) {
        let end = nanoseconds(to);
        loop {
            if self.in_flight.is_none() {
                match self.winner() {
                    // At `to` itself others may still hand something over and win.
                    Some((start, place)) if start < end => self.begin(start, place),
                    _ => break,
                }
            }
            match self.in_flight.take_if(|in_flight| in_flight.end <= end) {
                Some(in_flight) => self.deliver(&in_flight),
                None => break,
            }
        }
        self.now = self.now.max(to);
    }

    /// When the next frame begins, and its place among the pending ones.
    fn winner(&self) -> Option<(u64, usize)> {
        let earliest = self.pending.iter().map(|pending| pending.since).min()?;
        let start = earliest.max(self.free);
        let competitors = self.pending.iter().enumerate().filter(|(_, pending)| pending.since <= start);
        competitors.min_by_key(|(_, pending)| pending.rank).map(|(place, _)| (start, place))
    }

    fn begin(&mut self, start: u64, place: usize) {
        let Pending { sender, frame, .. } = self.pending.swap_remove(place);
        let end = start.saturating_add(self.duration(&frame));
        self.free = end.saturating_add(u64::from(INTERMISSION) * self.bit);
        self.in_flight = Some(InFlight { sender, frame, end });
    }

    /// From the first bit of the frame to the last, in nanoseconds.
    fn duration(&self, frame: &Frame) -> u64 {
        u64::from(frame_bits(frame) - INTERMISSION) * self.bit
    }

    fn deliver(&mut self, in_flight: &InFlight) {
        let received = Received { time: microseconds(in_flight.end), frame: in_flight.frame };
        for (number, inbox) in self.inboxes.iter_mut().enumerate() {
            if number != in_flight.sender && !inbox.is_gone {
                inbox.put(received);
            }
        }
    }
}

impl Inbox {
    fn put(&mut self, received: Received) {
        if self.frames.len() == MOST_UNTAKEN {
            self.frames.pop_front();
            self.lost += 1;
        }
        self.frames.push_back(received);
    }
}

/// [`Bus::wait`] moves the time of the whole bus. That suits a test that plays one participant at a time; several that
/// act by themselves go into [`simulate`](crate::simulate).
impl Bus for Participant {
    fn now(&self) -> Instant {
        self.bus.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        let mut medium = self.bus.0.borrow_mut();
        let inbox = &mut medium.inboxes[self.number];
        self.lost += std::mem::take(&mut inbox.lost);
        Ok(inbox.frames.pop_front())
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        let mut medium = self.bus.0.borrow_mut();
        if medium.pending.iter().filter(|pending| pending.sender == self.number).count() >= MOST_PENDING {
            return Err(SendError::Full);
        }
        let (serial, since) = (medium.next_serial, nanoseconds(medium.now));
        medium.next_serial += 1;
        let rank = (priority(frame), serial);
        medium.pending.push(Pending { rank, sender: self.number, since, frame: *frame });
        Ok(())
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        let is_empty = || self.bus.0.borrow().inboxes[self.number].frames.is_empty();
        while is_empty() && self.bus.now() < deadline {
            let before = self.bus.now();
            if self.bus.step(deadline) == before {
                break;
            }
        }
        Ok(())
    }

    fn event(&mut self) -> Option<Event> {
        let lost = std::mem::take(&mut self.lost);
        (lost > 0).then_some(Event::FramesLost(lost))
    }
}

impl Drop for Participant {
    fn drop(&mut self) {
        self.bus.0.borrow_mut().inboxes[self.number] = Inbox { is_gone: true, ..Inbox::default() };
    }
}

fn nanoseconds(time: Instant) -> u64 {
    time.0.saturating_mul(1000)
}

/// Rounded up: a frame is not there before its last bit.
fn microseconds(time: u64) -> Instant {
    Instant(time.div_ceil(1000))
}

#[cfg(test)]
mod tests;
