//! edskit's side: the dictionary that edskit-codegen has generated of `fixtures/Bench.eds`.

use crate::device::{Device, Mapping, NODE_ID, bytes, start};
use bench::objects as handles;
use edskit_runtime::types::{CanId, Index, NodeId};
use edskit_runtime::{Frame, Instant, NoApplication, NoStorage, Node, Settings};

edskit_runtime::include_dictionary!("Bench");

/// How many microseconds pass between two calls.
const STEP: u64 = 10;

pub(crate) struct Edskit {
    node: Node<bench::Dictionary, NoStorage>,
    now: Instant,
}

impl Edskit {
    pub(crate) fn new() -> Self {
        let settings = Settings { node_id: NodeId::new(NODE_ID as u8).ok(), ..Settings::default() };
        let node = Node::new(bench::Dictionary::new(), settings, NoStorage);
        let mut device = Self { node, now: Instant(0) };
        start(&mut device);
        device.node.objects().store(handles::BYTES, &bytes()).expect("there is room for them");
        device
    }
}

impl Device for Edskit {
    type Frame = Frame;

    const NAME: &'static str = "edskit";

    fn receive(&mut self, can_id: u16, data: &[u8]) {
        let can_id = CanId::standard(can_id).expect("it has eleven bits");
        self.node.receive(self.now, &Frame::new(can_id, data), &mut NoApplication);
    }

    fn poll(&mut self) {
        self.now.0 += STEP;
        self.node.poll(self.now, &mut NoApplication);
    }

    fn transmit(&mut self) -> Option<Frame> {
        self.node.transmit()
    }

    fn can_id(frame: &Frame) -> u16 {
        frame.can_id().raw() as u16
    }

    fn data(frame: &Frame) -> &[u8] {
        frame.data()
    }

    fn change(&mut self, mapping: Mapping, value: u8) {
        let mut objects = self.node.objects();
        let position = match mapping {
            Mapping::Words => {
                objects.set(handles::TRANSMITTED_WORDS[0], value.into());
                handles::TRANSMITTED_WORDS[0].position()
            }
            Mapping::Bits => {
                objects.set(handles::TRANSMITTED_BITS[0], value & 1 == 1);
                handles::TRANSMITTED_BITS[0].position()
            }
            Mapping::Bytes => {
                objects.set(handles::TRANSMITTED_BYTES[0], value);
                handles::TRANSMITTED_BYTES[0].position()
            }
        };
        self.node.services(self.now).changed(position);
    }

    fn received(&mut self, mapping: Mapping) -> Vec<u8> {
        let index = match mapping {
            Mapping::Words => 0x2010,
            Mapping::Bits => 0x2012,
            Mapping::Bytes => 0x2014,
        };
        let objects = self.node.objects();
        let entries = objects.table().entries_of(Index(index)).skip(1);
        entries.flat_map(|(position, _)| objects.bytes(position).to_vec()).collect()
    }
}
