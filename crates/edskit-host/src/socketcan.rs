//! An interface of the Linux kernel.

use crate::{Bus, BusError, Event, Received, SendError, system_now};
use ::socketcan::{CanFrame, CanSocket, EmbeddedFrame, Socket, SocketOptions};
use edskit_runtime::{Frame, Instant};
use std::collections::VecDeque;
use std::io;
use std::thread;
use std::time::Duration;

/// The kernel waits in milliseconds; what is left below one is waited for in pieces of this size.
const PIECE: Duration = Duration::from_micros(100);

/// How many events are kept for who asks; then the oldest goes.
const MOST_EVENTS: usize = 256;

/// An interface of the Linux kernel, `can0` or `vcan0` say. Its bit rate is set outside (`ip link`). Error frames of the
/// controller come as [`Event::ErrorFrame`].
pub struct SocketCan {
    socket: CanSocket,
    interface: String,
    /// What came while waiting.
    stash: Option<Received>,
    events: VecDeque<Event>,
}

impl SocketCan {
    /// Opens an interface by its name.
    ///
    /// # Errors
    ///
    /// [`BusError::Interface`] where there is no such interface, or no permission.
    pub fn open(interface: &str) -> Result<Self, BusError> {
        let fail = |source| BusError::Interface { interface: interface.to_owned(), source };
        let socket = CanSocket::open(interface).map_err(fail)?;
        socket.set_nonblocking(true).map_err(fail)?;
        socket.set_error_filter_accept_all().map_err(fail)?;
        Ok(Self { socket, interface: interface.to_owned(), stash: None, events: VecDeque::new() })
    }

    /// What `read` gives: a frame, or nothing where it gives an error frame or nothing in time.
    fn take(&mut self, read: io::Result<CanFrame>) -> Result<Read, BusError> {
        match read {
            Ok(CanFrame::Error(error)) => {
                if self.events.len() == MOST_EVENTS {
                    self.events.pop_front();
                }
                self.events.push_back(Event::ErrorFrame(error.error_bits()));
                Ok(Read::Other)
            }
            Ok(frame) => Ok(Read::Frame(Received { time: system_now(), frame: Frame::of(&frame) })),
            Err(error) => match error.kind() {
                io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut | io::ErrorKind::Interrupted => {
                    Ok(Read::Nothing)
                }
                _ => Err(BusError::Interface { interface: self.interface.clone(), source: error }),
            },
        }
    }
}

enum Read {
    Frame(Received),
    Other,
    Nothing,
}

impl Bus for SocketCan {
    fn now(&self) -> Instant {
        system_now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        if let Some(received) = self.stash.take() {
            return Ok(Some(received));
        }
        loop {
            let read = self.socket.read_frame();
            match self.take(read)? {
                Read::Frame(received) => return Ok(Some(received)),
                Read::Other => {}
                Read::Nothing => return Ok(None),
            }
        }
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        let id = EmbeddedFrame::id(frame);
        let made = if frame.is_remote() {
            <CanFrame as EmbeddedFrame>::new_remote(id, usize::from(frame.length()))
        } else {
            <CanFrame as EmbeddedFrame>::new(id, frame.data())
        };
        // Frames of the runtime are never too long for one of the kernel.
        let made = made.ok_or(io::Error::from(io::ErrorKind::InvalidInput))?;
        self.socket.write_frame(&made).map_err(|error| match error.kind() {
            io::ErrorKind::WouldBlock => SendError::Full,
            io::ErrorKind::NetworkDown => SendError::BusOff,
            _ if error.raw_os_error() == Some(NO_BUFFER_SPACE) => SendError::Full,
            _ => SendError::Io(error),
        })
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        while self.stash.is_none() && self.events.is_empty() {
            let rest = Duration::from_micros(deadline.since(system_now()).0);
            if rest.is_zero() {
                break;
            }
            let whole =
                Duration::from_millis(u64::try_from(rest.as_millis()).unwrap_or(u64::MAX)).min(LONGEST);
            let read = if whole.is_zero() {
                thread::sleep(rest.min(PIECE));
                self.socket.read_frame()
            } else {
                self.socket.read_frame_timeout(whole)
            };
            if let Read::Frame(received) = self.take(read)? {
                self.stash = Some(received);
            }
        }
        Ok(())
    }

    fn event(&mut self) -> Option<Event> {
        self.events.pop_front()
    }
}

/// The longest time for which the kernel is asked to wait; then it is asked again.
const LONGEST: Duration = Duration::from_secs(3600);

/// `ENOBUFS` of Linux: the transmit queue of the interface is full. The standard library has no word for it.
const NO_BUFFER_SPACE: i32 = 105;
