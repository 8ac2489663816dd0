use super::device::{Builder, RW, plain};
use super::{Bench, frame};
use crate::{Flags, Frame};
use edskit_types::{CanId, NmtState};
use std::vec::Vec;

fn times(sent: &[(u64, Frame)]) -> Vec<u64> {
    sent.iter().filter(|(_, frame)| frame.can_id().raw() == 0x705).map(|(time, _)| *time).collect()
}

#[test]
fn the_heartbeat_keeps_its_period_to_the_microsecond() {
    let mut bench = Bench::new(plain().build());
    bench.write(0x1017, 0, &[100, 0]).unwrap();
    let sent = bench.pass(350);
    assert_eq!(times(&sent), [100_000, 200_000, 300_000]);
    assert_eq!(sent[0].1, frame(0x705, &[127]));
    bench.write(0x1017, 0, &[0, 0]).unwrap();
    assert!(bench.pass(1000).is_empty());
}

#[test]
fn a_late_call_does_not_shift_the_heartbeat() {
    let mut bench = Bench::new(plain().build());
    bench.write(0x1017, 0, &[100, 0]).unwrap();
    bench.now.0 += 130_000;
    assert_eq!(bench.poll().len(), 1);
    assert_eq!(times(&bench.pass(100)), [70_000]);
}

#[test]
fn the_heartbeat_tells_the_state_even_when_stopped() {
    let mut bench = Bench::new(plain().build());
    bench.write(0x1017, 0, &[10, 0]).unwrap();
    bench.nmt(2);
    assert_eq!(bench.pass(10), [(10_000, frame(0x705, &[4]))]);
}

fn consumer() -> Builder {
    plain()
        .add(0x1003, 0, edskit_types::DataType::Unsigned8, RW, [0])
        .u32(0x1014, 0, super::device::COB_ID, 0x80)
        .u8(0x1016, 0, Flags::READ, 2)
        .u32(0x1016, 1, RW, 0)
        .u32(0x1016, 2, RW, 0)
        .u8(0x1029, 0, Flags::READ, 1)
        .u8(0x1029, 1, RW, 0)
}

#[cfg(feature = "heartbeat-consumer")]
#[test]
fn a_lost_heartbeat_is_an_error_until_it_comes_back() {
    let mut bench = Bench::new(consumer().build());
    bench.write(0x1016, 1, &[200, 0, 99, 0]).unwrap();
    assert!(bench.pass(1000).is_empty(), "nothing is missed before the first heartbeat");
    bench.nmt(1);
    bench.ask(0x763, &[5]);
    assert_eq!(bench.pass(300), [(200_000, frame(0x85, &[0x30, 0x81, 0x11, 99, 0, 0, 0, 0]))]);
    assert_eq!(bench.node.state(), NmtState::PreOperational);
    assert!(bench.pass(1000).is_empty(), "an error is told once");
    assert_eq!(bench.ask(0x763, &[5]), [frame(0x85, &[0; 8])]);
}

#[cfg(feature = "heartbeat-consumer")]
#[test]
fn error_behaviour_says_what_follows() {
    for (behaviour, state) in
        [(0, NmtState::PreOperational), (1, NmtState::Operational), (2, NmtState::Stopped)]
    {
        let mut bench = Bench::new(consumer().build());
        bench.write(0x1029, 1, &[behaviour]).unwrap();
        bench.write(0x1016, 2, &[100, 0, 9, 0]).unwrap();
        bench.nmt(1);
        bench.ask(0x709, &[127]);
        bench.pass(150);
        assert_eq!(bench.node.state(), state);
    }
}

#[cfg(feature = "heartbeat-consumer")]
#[test]
fn no_node_is_monitored_twice() {
    let mut bench = Bench::new(consumer().build());
    bench.write(0x1016, 1, &[200, 0, 99, 0]).unwrap();
    assert_eq!(bench.write(0x1016, 2, &[10, 0, 99, 0]), Err(0x0604_0043));
    assert_eq!(bench.write(0x1016, 1, &[10, 0, 99, 0]), Ok(()));
    assert_eq!(bench.write(0x1016, 2, &[0, 0, 99, 0]), Ok(()), "a time of 0 monitors nobody");
}

fn guarded() -> Bench {
    Bench::new(consumer().u16(0x100C, 0, RW, 0).u8(0x100D, 0, RW, 0).build())
}

fn guard(bench: &mut Bench) -> Vec<Frame> {
    bench.receive(Frame::remote(CanId::standard(0x705).unwrap(), 1))
}

#[cfg(feature = "guarding")]
#[test]
fn guarding_is_answered_with_a_toggle_bit() {
    let mut bench = guarded();
    let answers: Vec<u8> = (0..4).map(|_| guard(&mut bench)[0].data()[0]).collect();
    assert_eq!(answers, [0x7F, 0xFF, 0x7F, 0xFF]);
    bench.nmt(130);
    assert_eq!(guard(&mut bench), [frame(0x705, &[0x7F])]);
    bench.write(0x1017, 0, &[0xE8, 3]).unwrap();
    assert!(guard(&mut bench).is_empty(), "heartbeat has precedence");
    assert!(guard(&mut Bench::new(plain().build())).is_empty(), "without 100Ch there is no guarding");
}

#[cfg(feature = "guarding")]
#[test]
fn life_guarding_begins_with_the_first_request() {
    let mut bench = guarded();
    bench.write(0x100C, 0, &[100, 0]).unwrap();
    bench.write(0x100D, 0, &[3]).unwrap();
    assert!(bench.pass(1000).is_empty());
    guard(&mut bench);
    assert_eq!(bench.pass(400), [(300_000, frame(0x85, &[0x30, 0x81, 0x11, 0, 0, 0, 0, 0]))]);
}
