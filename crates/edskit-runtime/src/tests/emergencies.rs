use super::device::{Builder, COB_ID, RO, RW, plain};
use super::{Bench, frame};
use crate::EmcyError;
use edskit_types::{EmergencyCode, ErrorRegister};
use std::vec::Vec;

fn device() -> Builder {
    let device = plain().u8(0x1003, 0, RW, 0).u32(0x1014, 0, COB_ID, 0x80).u16(0x1015, 0, RW, 0);
    (1..=3).fold(device, |device, sub_index| device.u32(0x1003, sub_index, RO, 0))
}

const HOT: EmcyError =
    EmcyError::new(EmergencyCode::DEVICE_TEMPERATURE.with(0x10), ErrorRegister::TEMPERATURE);

fn raise(bench: &mut Bench, error: EmcyError, source: u16) {
    bench.node.services(bench.now).raise(error, source, [1, 2, 3, 4, 5]);
}

#[test]
fn an_error_is_told_remembered_and_cleared() {
    let mut bench = Bench::new(device().build());
    raise(&mut bench, HOT, 0);
    raise(&mut bench, HOT, 0);
    assert_eq!(bench.poll(), [frame(0x85, &[0x10, 0x42, 0x09, 1, 2, 3, 4, 5])]);
    assert_eq!((bench.read(0x1001, 0), bench.read(0x1003, 0)), (Ok([9].into()), Ok([1].into())));
    assert_eq!(bench.read(0x1003, 1), Ok([0x10, 0x42, 1, 2].into()));
    assert_eq!(bench.read(0x1003, 2), Err(0x0800_0024));
    bench.node.services(bench.now).clear(HOT, 0);
    assert_eq!(bench.poll(), [frame(0x85, &[0; 8])]);
    assert_eq!(bench.read(0x1001, 0), Ok([0].into()));
    assert_eq!(bench.write(0x1003, 0, &[1]), Err(0x0609_0030));
    assert_eq!((bench.write(0x1003, 0, &[0]), bench.read(0x1003, 1)), (Ok(()), Err(0x0800_0024)));
}

#[test]
fn the_history_keeps_the_newest_in_front() {
    let mut bench = Bench::new(device().build());
    for number in 1..=5 {
        raise(&mut bench, EmcyError { code: 0x1000 + number, register: 0 }, 0);
    }
    let newest: Vec<u8> = (1..=3).map(|sub_index| bench.read(0x1003, sub_index).unwrap()[0]).collect();
    assert_eq!((newest, bench.read(0x1003, 0)), ([5, 4, 3].into(), Ok([3].into())));
}

#[test]
fn the_inhibit_time_is_kept() {
    let mut bench = Bench::new(device().build());
    bench.write(0x1015, 0, &5000_u16.to_le_bytes()).unwrap();
    for source in 0..3 {
        raise(&mut bench, HOT, source);
    }
    assert_eq!(bench.poll().len(), 1);
    let times: Vec<u64> = bench.pass(2000).iter().map(|(time, _)| *time).collect();
    assert_eq!(times, [500_000, 1_000_000]);
}

#[test]
fn an_invalid_cob_id_keeps_emergencies_back() {
    let mut bench = Bench::new(device().build());
    assert_eq!(bench.write(0x1014, 0, &[0x86, 0, 0, 0]), Err(0x0609_0030), "a valid one cannot change");
    assert_eq!(bench.write(0x1014, 0, &[0, 0, 0, 0]), Err(0x0609_0030), "000h belongs to NMT");
    bench.write(0x1014, 0, &[0x85, 0, 0, 0x80]).unwrap();
    raise(&mut bench, HOT, 0);
    assert!(bench.poll().is_empty());
    assert_eq!(bench.read(0x1001, 0), Ok([9].into()));
    bench.write(0x1014, 0, &[0x86, 0, 0, 0]).unwrap();
    bench.node.services(bench.now).clear(HOT, 0);
    assert_eq!(bench.poll(), [frame(0x86, &[0; 8])]);
}

#[test]
fn emergencies_wait_while_the_node_is_stopped() {
    let mut bench = Bench::new(device().build());
    bench.nmt(2);
    raise(&mut bench, HOT, 0);
    assert!(bench.poll().is_empty() && bench.pass(1000).is_empty());
    assert_eq!(bench.nmt(1).len(), 1);
}

#[test]
fn an_emergency_behind_a_full_queue_does_not_keep_the_main_loop_busy() {
    let mut bench = Bench::new(device().build());
    // Answers that nobody takes fill the queue.
    for _ in 0..16 {
        let request = frame(0x605, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]);
        bench.node.receive(bench.now, &request, &mut *bench.app);
    }
    raise(&mut bench, HOT, 0);
    bench.node.poll(bench.now, &mut *bench.app);
    assert!(bench.node.next_deadline(bench.now) > bench.now);
    assert_eq!(bench.sent().len(), 16);
    assert_eq!(bench.node.next_deadline(bench.now), bench.now);
    assert_eq!(bench.poll().len(), 1);
}
