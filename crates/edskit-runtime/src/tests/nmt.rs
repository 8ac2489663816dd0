use super::device::{RW, plain, with_values};
use super::{Bench, NODE, frame};
use crate::{Frame, NoStorage, NotSent, Pattern, Settings};
use edskit_types::{CanId, NmtState, NodeId};
use std::boxed::Box;

#[test]
fn commands_change_the_state() {
    let mut bench = Bench::new(plain().build());
    for (command, state) in [
        (1, NmtState::Operational),
        (2, NmtState::Stopped),
        (128, NmtState::PreOperational),
        (2, NmtState::Stopped),
        (1, NmtState::Operational),
    ] {
        assert!(bench.nmt(command).is_empty());
        assert_eq!(bench.node.state(), state);
    }
    for command in [129, 130] {
        assert_eq!(bench.nmt(command), [frame(0x705, &[0])]);
        assert_eq!(bench.node.state(), NmtState::PreOperational);
    }
}

#[test]
fn only_commands_for_the_node_count() {
    let mut bench = Bench::new(plain().build());
    let extended = Frame::new(CanId::extended(0).unwrap(), &[1, NODE]);
    let others = [
        frame(0, &[1, 6]),
        frame(0, &[1]),
        frame(0, &[]),
        frame(0, &[1, NODE, 0]),
        frame(0, &[3, NODE]),
        extended,
    ];
    for other in others {
        bench.receive(other);
        assert_eq!(bench.node.state(), NmtState::PreOperational, "{other:?}");
    }
    bench.ask(0, &[1, 0]);
    assert_eq!(bench.node.state(), NmtState::Operational);
}

#[test]
fn a_reset_of_communication_keeps_the_application() {
    let mut bench = Bench::new(with_values().build());
    bench.write(0x2000, 0, &[1, 1]).unwrap();
    bench.write(0x1017, 0, &[0xE8, 3]).unwrap();
    bench.nmt(130);
    assert_eq!((bench.read(0x2000, 0), bench.read(0x1017, 0)), (Ok([1, 1].into()), Ok([0, 0].into())));
    bench.nmt(129);
    assert_eq!(bench.read(0x2000, 0), Ok([0x34, 0x12].into()));
}

#[test]
fn nothing_happens_before_power_on() {
    let settings = Settings { node_id: NodeId::new(NODE).ok(), ..Settings::default() };
    let mut bench = Bench::off(plain().build(), settings, Box::new(NoStorage));
    bench.node.receive(bench.now, &frame(0, &[1, 0]), &mut *bench.app);
    assert_eq!((bench.sent().len(), bench.node.state()), (0, NmtState::Initialising));
    assert_eq!(bench.node.next_deadline(bench.now), bench.now);
}

#[test]
fn a_node_may_start_by_itself() {
    // Bit 0 says that the device is the NMT master; bit 2 speaks of a master. Else only 8 as a whole means something here.
    let starting = [1, 3, 8, 9, 0x41];
    for startup in (0..=0x4F).chain([0x8000_0000, 0x0000_0108]) {
        let bench = Bench::new(plain().u32(0x1F80, 0, RW, startup).build());
        let is_master = startup & 1 == 1 && startup & 4 == 0;
        assert!(!starting.contains(&startup) || is_master || startup == 8);
        let state = if is_master || startup == 8 { NmtState::Operational } else { NmtState::PreOperational };
        assert_eq!(bench.node.state(), state, "{startup:X}");
    }
}

#[test]
fn the_indicators_follow_the_state() {
    let mut bench = Bench::new(plain().build());
    assert_eq!(bench.node.leds().run, Pattern::Blinking);
    bench.nmt(1);
    assert_eq!(bench.node.leds().run, Pattern::On);
    bench.nmt(2);
    assert_eq!((bench.node.leds().run, bench.node.leds().error), (Pattern::SingleFlash, Pattern::Off));
    assert_eq!(bench.node.why_not_sent(bench.now, 1), NotSent::NoSuchPdo);
}
