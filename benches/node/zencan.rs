//! zencan's side: the dictionary that zencan-build has generated of `fixtures/zencan.toml`.

use crate::device::{Device, Mapping, NODE_ID, bytes, start};
use generated::{
    NODE_MBOX, NODE_STATE, OBJECT2001, OBJECT2010, OBJECT2011, OBJECT2014, OBJECT2015, OD_TABLE,
};
use zencan_node::common::{CanId, CanMessage, NodeId};
use zencan_node::object_dict::ObjectAccess;
use zencan_node::{Callbacks, Node};

#[allow(
    unsafe_code,
    missing_docs,
    unreachable_pub,
    clippy::all,
    reason = "it is generated, and not by this project"
)]
mod generated {
    zencan_node::include_modules!(BENCH);
}

#[cfg(not(feature = "zencan-mutex"))]
#[allow(unsafe_code, reason = "the trait of critical sections is unsafe")]
mod critical_section {
    use critical_section::{Impl, RawRestoreState};

    /// The benchmark has one thread and no interrupts, so there is nothing to keep out.
    struct Nothing;

    critical_section::set_impl!(Nothing);

    // SAFETY: only the main thread uses zencan's node.
    unsafe impl Impl for Nothing {
        unsafe fn acquire() -> RawRestoreState {}

        unsafe fn release((): RawRestoreState) {}
    }
}

/// How many microseconds pass between two calls.
const STEP: u64 = 10;

pub(crate) struct Zencan {
    node: Node<'static>,
    now: u64,
}

impl Zencan {
    /// The node; there can be one only.
    pub(crate) fn new() -> Self {
        let node_id = NodeId::new(NODE_ID as u8).expect("it is a node-ID");
        let node = Node::new(node_id, Callbacks::new(), &NODE_MBOX, &NODE_STATE, &OD_TABLE);
        let mut device = Self { node, now: 0 };
        start(&mut device);
        OBJECT2001.value.store(bytes());
        device
    }
}

impl Device for Zencan {
    type Frame = CanMessage;

    const NAME: &'static str = "zencan";

    fn receive(&mut self, can_id: u16, data: &[u8]) {
        let taken = NODE_MBOX.store_message(CanMessage::new(CanId::std(can_id), data));
        assert!(taken.is_ok());
    }

    fn poll(&mut self) {
        self.now += STEP;
        self.node.process(self.now);
    }

    fn transmit(&mut self) -> Option<CanMessage> {
        NODE_MBOX.next_transmit_message()
    }

    fn can_id(frame: &CanMessage) -> u16 {
        frame.id().raw() as u16
    }

    fn data(frame: &CanMessage) -> &[u8] {
        frame.data()
    }

    fn change(&mut self, mapping: Mapping, value: u8) {
        let changed = match mapping {
            Mapping::Words => OBJECT2011.set(0, value.into()).and_then(|()| OBJECT2011.set_event_flag(1)),
            Mapping::Bytes => OBJECT2015.set(0, value).and_then(|()| OBJECT2015.set_event_flag(1)),
            Mapping::Bits => unreachable!("zencan maps no single bits"),
        };
        assert!(changed.is_ok());
    }

    fn received(&mut self, mapping: Mapping) -> Vec<u8> {
        match mapping {
            Mapping::Words => OBJECT2010.array.iter().flat_map(|value| value.load().to_le_bytes()).collect(),
            Mapping::Bytes => OBJECT2014.array.iter().map(|value| value.load()).collect(),
            Mapping::Bits => unreachable!("zencan maps no single bits"),
        }
    }
}
