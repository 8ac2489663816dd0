//! Recording what goes over a bus.

use crate::{Bus, BusError, Event, Received, SendError};
use edskit_runtime::{Frame, Instant};
use std::io;

/// Something that writes frames down: [`Candump`](crate::Candump) or [`Pcap`](crate::Pcap).
pub trait Recorder {
    /// Writes one frame with its time.
    ///
    /// # Errors
    ///
    /// As the writer below.
    fn record(&mut self, time: Instant, frame: &Frame) -> io::Result<()>;
}

/// A bus whose frames are recorded: those that are received when they are taken, with the time of their arrival, and those
/// that are sent when they are handed over. Where the record cannot be written, it ends with [`Event::TraceEnded`], and the
/// bus goes on.
///
/// ```
/// use edskit_host::{Bus, Candump, Trace, VirtualBus};
/// use edskit_runtime::{Frame, Instant};
/// use edskit_types::{Bitrate, CanId};
///
/// let bus = VirtualBus::new(Bitrate::Kbit125);
/// bus.advance(Instant(1_500_000));
/// let mut log = Vec::new();
/// let mut traced = Trace::new(bus.attach(), Candump::new(&mut log, "can0"));
/// traced.send(&Frame::new(CanId::standard(0x601).unwrap(), &[0x40, 0, 0x10, 0]))?;
/// drop(traced);
/// assert_eq!(log, b"(0000000001.500000) can0 601#40001000\n");
/// # Ok::<(), edskit_host::SendError>(())
/// ```
pub struct Trace<B, R> {
    bus: B,
    recorder: Option<R>,
    ended: Option<Event>,
}

impl<B: Bus, R: Recorder> Trace<B, R> {
    /// Records what goes over `bus`.
    pub fn new(bus: B, recorder: R) -> Self {
        Self { bus, recorder: Some(recorder), ended: None }
    }

    fn record(&mut self, time: Instant, frame: &Frame) {
        if let Some(recorder) = &mut self.recorder
            && let Err(error) = recorder.record(time, frame)
        {
            self.recorder = None;
            self.ended = Some(Event::TraceEnded(error.to_string()));
        }
    }
}

impl<B: Bus, R: Recorder> Bus for Trace<B, R> {
    fn now(&self) -> Instant {
        self.bus.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        let received = self.bus.receive()?;
        if let Some(Received { time, frame }) = &received {
            self.record(*time, frame);
        }
        Ok(received)
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        self.bus.send(frame)?;
        self.record(self.bus.now(), frame);
        Ok(())
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        self.bus.wait(deadline)
    }

    fn event(&mut self) -> Option<Event> {
        self.ended.take().or_else(|| self.bus.event())
    }
}
