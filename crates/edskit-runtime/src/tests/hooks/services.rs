//! What a device does with the node from within its calls.

use crate::tests::device::{COB_ID, RW, with_values};
use crate::tests::{Bench, NODE, frame};
use crate::{
    Application, Dictionary, EmcyError, Entry, Instant, Memory, NoStorage, Node, Parts, Reset, Services,
    Settings, Table,
};
use edskit_types::{Index, NmtState, NodeId, SubIndex};
use std::boxed::Box;

const TPDO: u16 = 0x1800;

/// A device that is told what to do by writing into 3000h, and does it at once.
struct Obedient;

impl Application for Obedient {
    fn after_write(&mut self, node: &mut Services<'_>, entry: &Entry) {
        if entry.index != Index(0x3000) {
            return;
        }
        let what: u8 = node.objects.value(Index(0x3000), 0).unwrap();
        match what {
            1 => node.trigger(1),
            2 => node.enter(NmtState::Operational),
            3 => node.reset(Reset::Communication),
            4 => node.raise(EmcyError { code: 0x4210, register: 8 }, 0, [7; 5]),
            5 => node.clear(EmcyError { code: 0x4210, register: 8 }, 0),
            // As many parameters at once as no list has room for.
            6 => {
                for number in 0..12 {
                    let cob_id = node.objects.table().find(Index(TPDO + number), SubIndex(1)).unwrap();
                    node.objects.set_value(Index(TPDO + number), 1, 0x4000_0191 + u32::from(number) * 0x10);
                    node.update(cob_id);
                }
            }
            _ => {}
        }
    }
}

fn bench() -> Bench {
    let device = with_values().u32(0x1014, 0, COB_ID, 0x80).u8(0x3000, 0, RW, 0);
    let pdos =
        (0..12).fold(device, |device, number| device.pdo(TPDO + number, 0x8000_0000, 0xFE, &[0x2000_0010]));
    let mut bench = Bench::with(pdos.build(), Box::new(NoStorage), Box::new(Obedient));
    bench.write(TPDO, 1, &[0x85, 1, 0, 0]).unwrap();
    bench
}

/// What follows from a write into 3000h, besides the answer.
fn told(bench: &mut Bench, what: u8) -> std::vec::Vec<crate::Frame> {
    let mut sent = bench.ask(0x605, &[0x2F, 0, 0x30, 0, what, 0, 0, 0]);
    sent.retain(|frame| frame.can_id().raw() != 0x585);
    sent
}

#[test]
fn everything_can_be_done_from_within_a_call() {
    let mut bench = bench();
    let value = frame(0x185, &[0x34, 0x12]);
    assert_eq!(told(&mut bench, 1), [], "a trigger is an event in operational only");
    assert_eq!(told(&mut bench, 2), [value]);
    assert_eq!(bench.node.state(), NmtState::Operational);
    assert_eq!(told(&mut bench, 1), [value]);
    assert_eq!(told(&mut bench, 4), [frame(0x85, &[0x10, 0x42, 9, 7, 7, 7, 7, 7])]);
    assert_eq!(told(&mut bench, 4), [], "it is present already");
    assert_eq!(told(&mut bench, 5), [frame(0x85, &[0; 8])]);
    assert_eq!(told(&mut bench, 3), [frame(0x705, &[0])]);
    assert_eq!(bench.node.state(), NmtState::PreOperational);
}

#[test]
fn any_number_of_parameters_is_followed() {
    let mut bench = bench();
    bench.nmt(1);
    let sent = told(&mut bench, 6);
    let mut identifiers: std::vec::Vec<u32> = sent.iter().map(|frame| frame.can_id().raw()).collect();
    identifiers.sort_unstable();
    let expected: std::vec::Vec<u32> = (0..12).map(|number| 0x191 + number * 0x10).collect();
    assert_eq!(identifiers, expected);
}

#[test]
fn a_value_that_is_put_is_an_event_where_it_is_another_one() {
    let mut bench = bench();
    bench.nmt(1);
    let handle = |bench: &mut Bench| {
        let position = bench.node.objects().table().find(Index(0x2000), SubIndex(0)).unwrap();
        crate::Handle::<u16>::new(position, crate::Key { index: Index(0x2000), sub_index: SubIndex(0) })
    };
    let handle = handle(&mut bench);
    bench.node.services(bench.now).put(handle, 0x1234);
    assert_eq!(bench.poll(), []);
    bench.node.services(bench.now).put(handle, 0x1235);
    assert_eq!(bench.poll(), [frame(0x185, &[0x35, 0x12])]);
    bench.node.services(bench.now).changed(handle);
    assert_eq!(bench.poll(), [frame(0x185, &[0x35, 0x12])]);
}

#[test]
fn between_the_calls_the_main_loop_has_the_same() {
    let mut bench = bench();
    let now = bench.now;
    bench.node.services(now).enter(NmtState::Operational);
    assert_eq!(bench.node.next_deadline(now), now, "it is done with the next poll");
    bench.poll();
    assert_eq!(bench.node.state(), NmtState::Operational);
    let mut node = bench.node.services(now);
    assert_eq!(
        (node.now(), node.state(), node.node_id()),
        (now, NmtState::Operational, NodeId::new(NODE).ok())
    );
    node.reset(Reset::Node);
    node.enter(NmtState::Stopped);
    assert_eq!(bench.poll(), [frame(0x705, &[0])]);
    assert_eq!(bench.node.state(), NmtState::PreOperational, "a reset ends what else was asked for");
}

/// A dictionary without any entry.
struct Empty(Memory<0, 0, 0, 0, 0, 0, 0>);

impl Dictionary for Empty {
    fn parts(&mut self) -> Parts<'_> {
        const TABLE: Table<'_> =
            Table { entries: &[], constants: &[], defaults: &[], limits: &[], dummies: 0, fingerprint: 0 };
        self.0.parts(&TABLE)
    }
}

#[test]
fn a_node_lies_in_a_static() {
    static NODE: std::sync::Mutex<Node<Empty, NoStorage>> =
        std::sync::Mutex::new(Node::new(Empty(Memory::new([])), Settings::DEFAULT, NoStorage));
    let mut node = NODE.lock().unwrap();
    node.poll(Instant(0), &mut crate::NoApplication);
    assert_eq!(node.transmit(), Some(frame(0x701, &[0])));
}
