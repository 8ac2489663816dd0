//! A client and a node, with a bus in virtual time between them.

use edskit_codegen::{Layout, LoadedDictionary};
use edskit_host::{
    Bus, BusError, Event, MemoryDevice, MemoryStorage, Participant, Received, SendError, Station, VirtualBus,
};
use edskit_runtime::{Frame, Instant, Node, NodeDevice, Settings};
use edskit_types::{Bitrate, NodeId};

/// The client's end of the bus. While the client waits, the node at the other end works.
pub(crate) struct Line<'a> {
    bus: VirtualBus,
    client: Participant,
    station: Station<NodeDevice<LoadedDictionary<'a>, MemoryStorage, MemoryDevice>, Participant>,
}

impl<'a> Line<'a> {
    /// A node over this dictionary.
    pub(crate) fn new(layout: &'a Layout, node_id: NodeId) -> Self {
        let bus = VirtualBus::new(Bitrate::Kbit1000);
        let settings = Settings { node_id: Some(node_id), ..Settings::default() };
        let node = Node::new(LoadedDictionary::new(layout), settings, MemoryStorage::default());
        let station = Station::new(NodeDevice { node, application: MemoryDevice::default() }, bus.attach());
        Self { client: bus.attach(), station, bus }
    }
}

impl Bus for Line<'_> {
    fn now(&self) -> Instant {
        self.bus.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        self.client.receive()
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        self.client.send(frame)
    }

    /// Until the next frame on the bus, or until the node has something to do.
    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        let next = self.station.round()?;
        // What nobody reads must not pile up.
        drop(self.station.device.application.take_events());
        self.bus.step(deadline.min(next));
        self.station.round().map(drop)
    }

    fn event(&mut self) -> Option<Event> {
        self.client.event()
    }
}
