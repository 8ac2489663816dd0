//! A bus with a node that acts whenever somebody waits.

use edskit_host::{Bus, BusError, MemoryDevice, Participant, Received, SendError, Station, VirtualBus};
use edskit_runtime::{
    Dictionary, Entry, Flags, Frame, Instant, Memory, NoStorage, Node, NodeDevice, Parts, Settings, Table,
};
use edskit_types::{Bitrate, DataType, Index, SubIndex};

/// How many bytes the text can have.
pub(crate) const TEXT_CAPACITY: usize = 2000;
/// The text with its length, and a number.
const VALUES: usize = 2 + TEXT_CAPACITY + 4;

/// A participant's view of a bus on which there is a node with node-ID 1.
pub(crate) struct Served {
    bus: VirtualBus,
    tool: Participant,
    station: Station<NodeDevice<Device, NoStorage, MemoryDevice>, Participant>,
}

impl Served {
    pub(crate) fn new() -> Self {
        let bus = VirtualBus::new(Bitrate::Kbit1000);
        let node = Node::new(Device(Memory::new([0; VALUES])), Settings::default(), NoStorage);
        let mut station =
            Station::new(NodeDevice { node, application: MemoryDevice::default() }, bus.attach());
        station.round().expect("a virtual bus stays");
        Self { tool: bus.attach(), station, bus }
    }

    pub(crate) fn milliseconds(&self) -> u64 {
        self.bus.now().0 / 1_000
    }
}

impl Bus for Served {
    fn now(&self) -> Instant {
        self.bus.now()
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        self.tool.receive()
    }

    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        self.tool.send(frame)
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        let next = self.station.round()?;
        self.bus.step(deadline.min(next));
        self.station.round().map(drop)
    }
}

struct Device(Memory<VALUES, 0, 0, 0, 1, 0, TEXT_CAPACITY>);

const BOTH: Flags = Flags::READ.and(Flags::WRITE);

static ENTRIES: [Entry; 4] = [
    entry(0x2000, DataType::Domain, BOTH, 0, 0),
    entry(0x2001, DataType::OctetString, BOTH.and(Flags::VARIABLE), 0, TEXT_CAPACITY as u16),
    entry(0x2002, DataType::Unsigned32, Flags::READ, 0, 4),
    entry(0x2003, DataType::Unsigned32, BOTH.and(Flags::VARIABLE), 2 + TEXT_CAPACITY as u16, 4),
];

static TABLE: Table<'static> = Table {
    entries: &ENTRIES,
    constants: &[0x44, 0x33, 0x22, 0x11],
    defaults: &[0; VALUES],
    limits: &[],
    dummies: 0,
    fingerprint: 1,
};

const fn entry(index: u16, data_type: DataType, flags: Flags, offset: u16, size: u16) -> Entry {
    Entry { index: Index(index), sub_index: SubIndex(0), data_type, flags, offset, size }
}

impl Dictionary for Device {
    fn parts(&mut self) -> Parts<'_> {
        self.0.parts(&TABLE)
    }
}
