//! What every bus can do.

use crate::{BusError, SendError};
use edskit_runtime::{Frame, Instant};
use std::fmt;
use std::ops::DerefMut;

/// A frame and when it arrived.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Received {
    /// When it was complete, in the time of [`Bus::now`].
    pub time: Instant,
    /// The frame.
    pub frame: Frame,
}

/// One participant's connection to a CAN bus. A participant does not receive what it sends itself.
///
/// A program that serves a device asks for frames until there are none, sends what it has to, and waits for the next
/// deadline:
///
/// ```
/// use edskit_host::{Bus, BusError};
/// use edskit_runtime::Instant;
///
/// fn serve(bus: &mut impl Bus, deadline: Instant) -> Result<(), BusError> {
///     while bus.now() < deadline {
///         while let Some(received) = bus.receive()? {
///             let _ = received.frame;
///         }
///         while let Some(event) = bus.event() {
///             let _ = event.to_string();
///         }
///         bus.wait(deadline)?;
///     }
///     Ok(())
/// }
/// # let bus = edskit_host::VirtualBus::new(edskit_types::Bitrate::Kbit125);
/// # serve(&mut bus.attach(), Instant(50)).unwrap();
/// ```
pub trait Bus {
    /// The time on this bus: microseconds since 1970-01-01 00:00 UTC on a real one, since the start of the simulation
    /// on a virtual one. It never goes back.
    fn now(&self) -> Instant;

    /// The next frame, if one has arrived. It does not block.
    ///
    /// # Errors
    ///
    /// Where the bus is gone for good. A connection that is being made again is no error but an [`Event`].
    fn receive(&mut self) -> Result<Option<Received>, BusError>;

    /// Hands a frame over for sending. It does not block, and success does not mean that anybody has received the
    /// frame.
    ///
    /// # Errors
    ///
    /// [`SendError`] says why the frame was not taken; it can be handed over again later.
    fn send(&mut self, frame: &Frame) -> Result<(), SendError>;

    /// Waits until something has arrived or `deadline` has come, [`Instant::NEVER`] for no deadline. It may return
    /// early; the caller looks.
    ///
    /// # Errors
    ///
    /// As [`Bus::receive`].
    fn wait(&mut self, deadline: Instant) -> Result<(), BusError>;

    /// What happened to the bus before the frame that was received last. Each event is given once.
    fn event(&mut self) -> Option<Event> {
        None
    }
}

/// A reference or a box is as good as the bus behind it.
impl<P: DerefMut<Target: Bus>> Bus for P {
    fn now(&self) -> Instant {
        (**self).now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        (**self).receive()
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        (**self).send(frame)
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        (**self).wait(deadline)
    }

    fn event(&mut self) -> Option<Event> {
        (**self).event()
    }
}

/// Something that a person may want to hear of.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum Event {
    /// The connection is lost. It is made again without further word until that succeeds.
    Disconnected {
        /// Whom the connection led to: host and port.
        peer: String,
        /// Why it ended.
        reason: String,
    },
    /// A connection that was lost is there again.
    Connected {
        /// Whom it leads to: host and port.
        peer: String,
    },
    /// So many received frames had to be dropped, the oldest first, because they were not taken in time.
    FramesLost(u64),
    /// The controller reported an error: the class as SocketCAN has it (`CAN_ERR_...`; 040h is bus-off).
    ErrorFrame(u32),
    /// The trace cannot be written any more and has ended.
    TraceEnded(String),
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Disconnected { peer, reason } => {
                write!(f, "connection to {peer} lost ({reason}), trying again")
            }
            Self::Connected { peer } => write!(f, "connected to {peer} again"),
            Self::FramesLost(1) => f.write_str("1 received frame dropped, it was not taken in time"),
            Self::FramesLost(count) => {
                write!(f, "{count} received frames dropped, they were not taken in time")
            }
            Self::ErrorFrame(class) => write!(f, "error frame, class {class:03X}h"),
            Self::TraceEnded(reason) => write!(f, "the trace has ended: {reason}"),
        }
    }
}
