//! A participant of a bus that is reached over TCP.

mod connection;
mod greeter;
mod protocol;

pub(crate) use greeter::Greeter;
pub(crate) use protocol::Incoming;

use crate::address::place;
use crate::queue::Refusal;
use crate::{Bus, BusError, Event, Received, SendError, system_now};
use connection::{Shared, keep};
use edskit_runtime::{Frame, Instant};
use protocol::Protocol;
use std::collections::VecDeque;
use std::convert::Infallible;
use std::sync::{Arc, mpsc};
use std::thread::{self, JoinHandle};

/// A connection to a bus over TCP, with socketcand or SLCAN.
///
/// Once made, a connection that is lost is made again, after 0.1 s at first and then after twice the time up to 5 s. That
/// is said once when it is lost and once when it is there again ([`Event`]); in between, frames are refused with
/// [`SendError::Disconnected`]. Up to 4096 frames wait for being sent, then [`SendError::Full`]; up to 32,768 received ones
/// wait for being taken, then the oldest are dropped ([`Event::FramesLost`]). A connection whose other side does not take
/// what is sent for 5 s is given up and made again.
///
/// Dropping it sends what has been taken for sending.
pub struct Client {
    shared: Arc<Shared>,
    carries_remote_frames: bool,
    events: VecDeque<Event>,
    /// Dropping it tells the thread to stop.
    stop: Option<mpsc::Sender<Infallible>>,
    thread: Option<JoinHandle<()>>,
}

impl Client {
    /// Attaches to a hub or to a socketcand daemon, to its interface `channel` (a hub takes any). The protocol carries no
    /// remote frames: they are refused with [`SendError::RemoteFrame`].
    ///
    /// # Errors
    ///
    /// [`BusError`] says why there is no connection, or who else answers there.
    pub fn socketcand(host: &str, port: u16, channel: &str) -> Result<Self, BusError> {
        Self::open(host, port, Protocol::Socketcand { channel: channel.to_owned() })
    }

    /// Attaches to a hub or to an SLCAN adapter that speaks TCP. The adapter's bit rate stays as it is.
    ///
    /// # Errors
    ///
    /// [`BusError`] says why there is no connection, or who else answers there.
    pub fn slcan(host: &str, port: u16) -> Result<Self, BusError> {
        Self::open(host, port, Protocol::Slcan)
    }

    fn open(host: &str, port: u16, protocol: Protocol) -> Result<Self, BusError> {
        let shared = Arc::new(Shared::new(host, port));
        let stream = shared.connect(&protocol)?;
        let carries_remote_frames = protocol.carries_remote_frames();
        let (stop, stopped) = mpsc::channel();
        let keeper = Arc::clone(&shared);
        let thread = thread::Builder::new()
            .name(format!("client of {}", place(host, port)))
            .spawn(move || keep(&keeper, &protocol, stream, &stopped))
            .map_err(BusError::Thread)?;
        let (stop, thread) = (Some(stop), Some(thread));
        Ok(Self { shared, carries_remote_frames, events: VecDeque::new(), stop, thread })
    }
}

impl Bus for Client {
    fn now(&self) -> Instant {
        system_now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        let lost = self.shared.inbox.take_lost();
        if lost > 0 {
            self.remember(Event::FramesLost(lost));
        }
        while let Some(input) = self.shared.inbox.pop() {
            match input {
                Ok(received) => return Ok(Some(received)),
                Err(event) => self.remember(event),
            }
        }
        Ok(None)
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        if frame.is_remote() && !self.carries_remote_frames {
            return Err(SendError::RemoteFrame);
        }
        self.shared.send(*frame).map_err(|refusal| match refusal {
            Refusal::Full => SendError::Full,
            Refusal::Closed => SendError::Disconnected,
        })
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        self.shared.inbox.wait(deadline);
        Ok(())
    }

    fn event(&mut self) -> Option<Event> {
        self.events.pop_front()
    }
}

impl Client {
    /// Keeps an event for who asks; who never asks has the newest.
    fn remember(&mut self, event: Event) {
        const MOST_EVENTS: usize = 256;
        if self.events.len() == MOST_EVENTS {
            self.events.pop_front();
        }
        self.events.push_back(event);
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        self.stop = None;
        // Without a connection there is nothing to send, and the thread ends by itself.
        if self.shared.finish()
            && let Some(thread) = self.thread.take()
        {
            // A panic there has nothing to tell here.
            let _ = thread.join();
        }
    }
}
