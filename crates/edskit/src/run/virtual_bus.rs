//! The bus in virtual time of a device, which other programs attach to.

use crate::live::TraceFile;
use edskit_host::{Bus, BusError, Event, Participant, Received, SendError, Trace, VirtualBus, VirtualServer};
use edskit_runtime::{Frame, Instant};
use edskit_types::Bitrate;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};

/// Where it listens if nothing else is said.
pub(super) const USUAL_ADDRESS: SocketAddr = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 29538);

/// The device's place on the bus. While the device waits, the other programs are served, and time passes when all wait.
pub(super) struct VirtualConnection {
    device: Participant,
    server: VirtualServer,
    /// A participant of its own, so that frames are recorded in the order and at the times in which they are on the wire.
    recorder: Option<Trace<Participant, TraceFile>>,
}

impl VirtualConnection {
    pub(super) fn start(
        listen: SocketAddr,
        bit_rate: Bitrate,
        record: Option<TraceFile>,
    ) -> Result<Self, BusError> {
        let bus = VirtualBus::new(bit_rate);
        let recorder = record.map(|record| Trace::new(bus.attach(), record));
        Ok(Self { device: bus.attach(), server: VirtualServer::start(&bus, listen)?, recorder })
    }

    pub(super) fn address(&self) -> SocketAddr {
        self.server.address()
    }
}

impl Bus for VirtualConnection {
    fn now(&self) -> Instant {
        self.device.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        self.device.receive()
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        self.device.send(frame)
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        self.server.wait(deadline);
        if let Some(recorder) = &mut self.recorder {
            while recorder.receive()?.is_some() {}
        }
        Ok(())
    }

    fn event(&mut self) -> Option<Event> {
        self.device.event().or_else(|| self.recorder.as_mut()?.event())
    }
}
