//! Frames that nobody should send.

use super::device::{COB_ID, RO, RW, with_values};
use super::{Bench, frame};
use crate::{Frame, NoStorage, Settings};
use edskit_types::CanId;
use proptest::prelude::*;
use std::boxed::Box;
use std::vec::Vec;

fn device() -> super::Device {
    with_values()
        .u8(0x1003, 0, RW, 0)
        .u32(0x1003, 1, RO, 0)
        .u32(0x1005, 0, RW, 0x80)
        .u32(0x1006, 0, RW, 0)
        .u16(0x100C, 0, RW, 0)
        .u8(0x100D, 0, RW, 0)
        .u32(0x1010, 1, RW, 1)
        .u32(0x1014, 0, COB_ID, 0x80)
        .u32(0x1016, 1, RW, 0)
        .u8(0x1019, 0, RW, 0)
        .pdo(0x1400, 0x200, 255, &[0x2000_0010])
        .pdo(0x1800, 0x180, 1, &[0x2000_0010, 0x2001_0008])
        .build()
}

/// Identifiers that mean something to the node, and others.
fn identifier() -> impl Strategy<Value = CanId> {
    let known = prop::sample::select(&[0_u16, 0x80, 0x100, 0x185, 0x205, 0x605, 0x705, 0x763, 0x7E5][..]);
    let standard = prop_oneof![4 => known, 1 => 0..0x800_u16];
    prop_oneof![
        9 => standard.prop_map(|id| CanId::standard(id).unwrap()),
        1 => (0..0x2000_0000_u32).prop_map(|id| CanId::extended(id).unwrap()),
    ]
}

fn any_frame() -> impl Strategy<Value = Frame> {
    // Requests for objects that exist reach further than any bytes.
    let index = prop::sample::select(
        &[0x1000_u16, 0x1003, 0x1005, 0x1008, 0x1016, 0x1400, 0x1600, 0x1800, 0x1A00, 0x2003, 0x2006][..],
    );
    let request = (any::<u8>(), index, 0..4_u8, any::<[u8; 4]>()).prop_map(
        |(command, index, sub_index, [a, b, c, d])| {
            let [low, high] = index.to_le_bytes();
            frame(0x605, &[command, low, high, sub_index, a, b, c, d])
        },
    );
    let data = prop::collection::vec(any::<u8>(), 0..=8);
    prop_oneof![
        4 => request,
        5 => (identifier(), data).prop_map(|(can_id, data)| Frame::new(can_id, &data)),
        1 => (identifier(), 0..=8_u8).prop_map(|(can_id, length)| Frame::remote(can_id, length)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn no_frames_break_the_node(frames in prop::collection::vec((any_frame(), 0..2_000_000_u64), 0..200)) {
        let mut bench = Bench::off(device(), Settings { node_id: edskit_types::NodeId::new(5).ok(), ..Default::default() }, Box::new(NoStorage));
        bench.poll();
        for (frame, pause) in frames {
            bench.receive(frame);
            bench.now.0 += pause;
            bench.poll();
            prop_assert!(bench.node.next_deadline(bench.now) >= bench.now);
        }
        // Whatever happened, the next reset and request are served.
        for node_id in [5_u8, bench.node.node_id().map_or(5, edskit_types::NodeId::get)] {
            bench.ask(0, &[129, node_id]);
        }
        let node_id = bench.node.node_id().map_or(0, edskit_types::NodeId::get);
        if node_id != 0 {
            let answer = bench.ask(0x600 + u16::from(node_id), &[0x40, 0, 0x10, 0, 0, 0, 0, 0]);
            prop_assert!(answer.iter().any(|frame| frame.data() == [0x43, 0, 0x10, 0, 0x91, 1, 1, 0]), "{answer:?}");
        }
    }

    #[test]
    fn frames_that_nobody_fetches_are_lost_and_told(count in 20..200_usize) {
        let mut bench = Bench::new(device());
        for _ in 0..count {
            bench.node.receive(bench.now, &frame(0x605, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]), &mut *bench.app);
        }
        let waiting = bench.sent();
        prop_assert_eq!(waiting.len(), 16);
        let told: Vec<Frame> = bench.poll();
        prop_assert_eq!(told[0], frame(0x85, &[0x10, 0x81, 0x11, 0, 0, 0, 0, 0]));
    }
}
