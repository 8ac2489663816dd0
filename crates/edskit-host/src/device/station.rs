//! A device on a bus.

use crate::{Bus, BusError, SendError};
use edskit_runtime::{Device, Frame, Instant, Microseconds};

/// When a bus that has no room is asked again: a little more than the longest frame takes at 1 Mbit/s.
const RETRY: Microseconds = Microseconds(150);

/// A device on a bus: what the main loop of a firmware is on a computer.
///
/// ```
/// use edskit_host::{Bus, MemoryDevice, Station, VirtualBus};
/// use edskit_runtime::{Dictionary, Instant, NoStorage, Node, NodeDevice, Settings};
///
/// fn run(dictionary: impl Dictionary, bus: &VirtualBus) -> Result<(), edskit_host::BusError> {
///     let node = Node::new(dictionary, Settings::default(), NoStorage);
///     let device = NodeDevice { node, application: MemoryDevice::default() };
///     let mut station = Station::new(device, bus.attach());
///     while station.bus.now() < Instant(1_000_000) {
///         let next = station.round()?;
///         station.bus.wait(next)?;
///     }
///     Ok(())
/// }
/// ```
#[derive(Debug)]
pub struct Station<D, B> {
    /// The device.
    pub device: D,
    /// Its bus.
    pub bus: B,
    /// A frame that the bus has not taken yet.
    waiting: Option<Frame>,
}

impl<D: Device, B: Bus> Station<D, B> {
    /// A device that has done nothing yet.
    pub fn new(device: D, bus: B) -> Self {
        Self { device, bus, waiting: None }
    }

    /// Takes what has arrived, sends what is due, and says when there is something to do again if nothing arrives:
    /// until then [`Bus::wait`].
    ///
    /// # Errors
    /// As [`Bus::receive`].
    pub fn round(&mut self) -> Result<Instant, BusError> {
        while let Some(received) = self.bus.receive()? {
            self.device.receive(self.bus.now(), &received.frame);
            self.send_all();
        }
        self.device.poll(self.bus.now());
        self.send_all();
        let now = self.bus.now();
        let next = self.device.next_deadline(now);
        Ok(if self.waiting.is_some() { now + RETRY } else { next })
    }

    fn send_all(&mut self) {
        while let Some(frame) = self.waiting.take().or_else(|| self.device.transmit()) {
            match self.bus.send(&frame) {
                Ok(()) => {}
                Err(SendError::Full) => {
                    self.waiting = Some(frame);
                    return;
                }
                // Nobody can be told over a bus that is away; the frame is gone as on a real one.
                Err(_) => {}
            }
        }
    }
}
