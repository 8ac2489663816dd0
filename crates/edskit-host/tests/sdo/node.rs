//! A bus with a node that acts whenever somebody waits.

use edskit_host::{Bus, BusError, Participant, Received, SendError, VirtualBus};
use edskit_runtime::{
    Application, Dictionary, Entry, Flags, Frame, Instant, NoStorage, Node, Objects, Parts, SdoServer,
    Settings, Table,
};
use edskit_types::{AbortCode, Bitrate, DataType, Index, SubIndex};

/// How many bytes the text can have.
pub(crate) const TEXT_CAPACITY: usize = 2000;

/// A participant's view of a bus on which there is a node with node-ID 1.
pub(crate) struct Served {
    bus: VirtualBus,
    tool: Participant,
    side: Participant,
    node: Node<Device, NoStorage>,
    domain: Domain,
    /// A frame of the node for which the bus had no room.
    waiting: Option<Frame>,
}

impl Served {
    pub(crate) fn new() -> Self {
        let bus = VirtualBus::new(Bitrate::Kbit1000);
        let (tool, side) = (bus.attach(), bus.attach());
        let device = Device {
            values: vec![0; 2 + TEXT_CAPACITY + 4],
            servers: [SdoServer::NEW],
            buffers: vec![0; TEXT_CAPACITY],
        };
        let mut served = Self {
            bus,
            tool,
            side,
            node: Node::new(device, Settings::default(), NoStorage),
            domain: Domain(Vec::new()),
            waiting: None,
        };
        served.act();
        served
    }

    pub(crate) fn milliseconds(&self) -> u64 {
        self.bus.now().0 / 1_000
    }

    fn act(&mut self) {
        let now = self.bus.now();
        while let Some(received) = self.side.receive().expect("a virtual bus stays") {
            self.node.receive(now, &received.frame, &mut self.domain);
        }
        self.node.poll(now, &mut self.domain);
        while let Some(frame) = self.waiting.take().or_else(|| self.node.transmit()) {
            if self.side.send(&frame).is_err() {
                self.waiting = Some(frame);
                break;
            }
        }
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
        self.act();
        let now = self.bus.now();
        let next = if self.waiting.is_some() { Instant::NEVER } else { self.node.next_deadline(now) };
        self.bus.step(deadline.min(next));
        self.act();
        Ok(())
    }
}

/// Keeps the bytes of the DOMAIN.
struct Domain(Vec<u8>);

impl Application for Domain {
    fn domain_length(&mut self, _: &mut Objects<'_>, _: &Entry) -> Result<Option<u32>, AbortCode> {
        Ok(Some(self.0.len() as u32))
    }

    fn read_domain(
        &mut self,
        _: &mut Objects<'_>,
        _: &Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let rest = &self.0[offset as usize..];
        let count = rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&rest[..count]);
        Ok(count)
    }

    fn write_domain(
        &mut self,
        _: &mut Objects<'_>,
        _: &Entry,
        offset: u32,
        data: &[u8],
        _: bool,
    ) -> Result<(), AbortCode> {
        self.0.truncate(offset as usize);
        self.0.extend_from_slice(data);
        Ok(())
    }
}

struct Device {
    values: Vec<u8>,
    servers: [SdoServer; 1],
    buffers: Vec<u8>,
}

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
    defaults: &[0; 2 + TEXT_CAPACITY + 4],
    limits: &[],
    dummies: 0,
    fingerprint: 1,
};

const fn entry(index: u16, data_type: DataType, flags: Flags, offset: u16, size: u16) -> Entry {
    Entry { index: Index(index), sub_index: SubIndex(0), data_type, flags, offset, size }
}

impl Dictionary for Device {
    fn parts(&mut self) -> Parts<'_> {
        Parts {
            objects: Objects::new(&TABLE, &mut self.values),
            rpdos: &mut [],
            tpdos: &mut [],
            mapped: &mut [],
            servers: &mut self.servers,
            consumers: &mut [],
            buffers: &mut self.buffers,
        }
    }
}
