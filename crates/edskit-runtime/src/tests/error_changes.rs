//! Errors that nothing could clear any more, and values that no client could write.

use super::device::{Builder, COB_ID, RW, with_values};
use super::{Bench, frame};
use crate::{Application, Entry, Flags, Frame, NoStorage, NotSent, Services, Settings};
use edskit_types::{AbortCode, CanId, Index, NodeId};
use std::boxed::Box;
use std::cell::RefCell;
use std::rc::Rc;
use std::vec::Vec;

const GONE: [u8; 8] = [0; 8];
const LOST_MASTER: [u8; 8] = [0x30, 0x81, 0x11, 0, 0, 0, 0, 0];

fn device() -> Builder {
    with_values()
        .u32(0x1005, 0, RW, 0x80)
        .u32(0x1006, 0, RW, 0)
        .u16(0x100C, 0, RW, 0)
        .u8(0x100D, 0, RW, 0)
        .u32(0x1012, 0, RW, 0x100)
        .u32(0x1014, 0, COB_ID, 0x80)
        .u8(0x1016, 0, Flags::READ, 2)
        .u32(0x1016, 1, RW, 0)
        .u32(0x1016, 2, RW, 0)
        .u8(0x1019, 0, RW, 0)
        .u8(0x1029, 0, Flags::READ, 2)
        .u8(0x1029, 1, RW, 0)
        .u8(0x1029, 2, RW, 0)
        .u8(0x1201, 0, Flags::READ, 2)
        .u32(0x1201, 1, RW, 0x8000_0000)
        .u32(0x1201, 2, RW, 0x8000_0000)
        .pdo(0x1400, 0x200, 255, &[0x2000_0010])
        .pdo(0x1800, 0x180, 1, &[0x2000_0010])
}

fn bench() -> Bench {
    Bench::new(device().build())
}

fn guard(bench: &mut Bench) -> Vec<Frame> {
    bench.receive(Frame::remote(CanId::standard(0x705).unwrap(), 1))
}

/// A node that is guarded, in operational.
fn guarded() -> Bench {
    let mut bench = bench();
    bench.write(0x100C, 0, &[100, 0]).unwrap();
    bench.write(0x100D, 0, &[3]).unwrap();
    bench.nmt(1);
    assert_eq!(guard(&mut bench), [frame(0x705, &[5])]);
    bench
}

// W10

#[cfg(feature = "guarding")]
#[test]
fn heartbeat_ends_guarding() {
    let mut bench = guarded();
    bench.write(0x1017, 0, &[100, 0]).unwrap();
    let sent = bench.pass(1000);
    assert!(sent.iter().all(|(_, sent)| *sent == frame(0x705, &[5])) && sent.len() == 10, "{sent:?}");
    assert_eq!(guard(&mut bench), []);
    // Guarding begins anew with a request, and with a toggle bit of 0.
    bench.write(0x1017, 0, &[0, 0]).unwrap();
    assert_eq!(bench.pass(1000), []);
    assert_eq!(guard(&mut bench), [frame(0x705, &[5])]);
    assert_eq!(bench.pass(400), [(300_000, frame(0x85, &LOST_MASTER))]);
    // The error goes with guarding.
    let sent = bench.ask(0x605, &[0x2B, 0x17, 0x10, 0, 0xE8, 3, 0, 0]);
    assert!(sent.contains(&frame(0x85, &GONE)), "{sent:?}");
    assert_eq!(bench.read(0x1001, 0), Ok([0].into()));
}

// W11

#[cfg(feature = "guarding")]
#[test]
fn the_error_of_guarding_goes_with_its_times() {
    for (index, value) in [(0x100C, &[0, 0][..]), (0x100D, &[0]), (0x100C, &[200, 0]), (0x100D, &[9])] {
        let mut bench = guarded();
        assert_eq!(bench.pass(400).len(), 1);
        bench.write(index, 0, value).unwrap();
        assert_eq!(bench.read(0x1001, 0), Ok([0].into()), "{index:X}");
        assert_eq!(bench.pass(5000), [], "life guarding begins with a request");
    }
}

#[cfg(feature = "sync")]
#[test]
fn the_error_of_sync_goes_with_what_was_expected() {
    let changes: [&[(u16, &[u8])]; 4] = [
        &[(0x1005, &[0x90, 0, 0, 0])],
        &[(0x1019, &[10])],
        &[(0x1006, &[0x10, 0x27, 0, 0]), (0x1005, &[0x80, 0, 0, 0x40])],
        &[],
    ];
    for change in changes {
        let mut bench = bench();
        assert_eq!(bench.ask(0x80, &[1, 2]), [frame(0x85, &[0x40, 0x82, 0x11, 2, 0, 0, 0, 0])]);
        for (index, value) in change {
            bench.write(*index, 0, value).unwrap();
        }
        if change.is_empty() {
            bench.nmt(2);
            assert_eq!(bench.nmt(128), [frame(0x85, &GONE)]);
        }
        assert_eq!(bench.read(0x1001, 0), Ok([0].into()), "{change:X?}");
    }
}

#[cfg(feature = "heartbeat-consumer")]
#[test]
fn the_error_of_a_heartbeat_goes_with_its_entry() {
    for value in [[0, 0, 0, 0], [0x2C, 1, 99, 0], [0x2C, 1, 98, 0]] {
        let mut bench = bench();
        bench.write(0x1016, 1, &[100, 0, 99, 0]).unwrap();
        bench.ask(0x763, &[5]);
        assert_eq!(bench.pass(200).len(), 1);
        bench.write(0x1016, 1, &value).unwrap();
        assert_eq!(bench.read(0x1001, 0), Ok([0].into()));
        assert_eq!(bench.pass(1000), []);
    }
}

// U4

#[cfg(feature = "heartbeat-consumer")]
#[test]
fn a_boot_up_is_no_heartbeat_but_a_sign_of_life() {
    let mut bench = bench();
    bench.write(0x1016, 1, &[0x2C, 1, 20, 0]).unwrap();
    bench.nmt(1);
    bench.ask(0x714, &[0]);
    assert_eq!(bench.pass(1000), [], "monitoring begins with the first heartbeat");
    bench.ask(0x714, &[127]);
    bench.pass(200);
    bench.ask(0x714, &[0]);
    assert_eq!(bench.pass(250), [], "it counts for a node that is monitored");
    assert_eq!(bench.pass(100).len(), 1);
    assert_eq!(bench.ask(0x714, &[0]), [frame(0x85, &GONE)], "the node is there again");
    assert_eq!(bench.pass(1000), [], "and is monitored from its next heartbeat on");
}

// U6

#[test]
fn reserved_values_are_refused() {
    let mut bench = bench();
    for sub_index in [1, 2] {
        for value in 0..=255_u8 {
            let expected = if (3..0x80).contains(&value) { Err(0x0609_0030) } else { Ok(()) };
            assert_eq!(bench.write(0x1029, sub_index, &[value]), expected, "{value}");
        }
    }
    for bit in 24..32 {
        let value = 0x0014_0064_u32 | 1 << bit;
        assert_eq!(bench.write(0x1016, 1, &value.to_le_bytes()), Err(0x0609_0030));
    }
}

// U7

#[cfg(feature = "sync")]
#[test]
fn a_producer_without_a_period_takes_the_sync_of_others() {
    let mut bench = bench();
    bench.write(0x1005, 0, &[0x80, 0, 0, 0x40]).unwrap();
    bench.nmt(1);
    assert_eq!(bench.ask(0x80, &[]), [frame(0x185, &[0x34, 0x12])]);
    bench.write(0x1006, 0, &10_000_u32.to_le_bytes()).unwrap();
    assert_eq!(bench.ask(0x80, &[]), [], "it makes them itself");
    assert_eq!(bench.pass(10).len(), 2);
    bench.write(0x1006, 0, &[0; 4]).unwrap();
    assert_eq!(bench.ask(0x80, &[]).len(), 1);
}

// W7

/// Nothing but answers and the boot-up is sent, whatever comes.
fn is_silent(bench: &mut Bench) -> bool {
    bench.nmt(1);
    let mut sent = bench.ask(0x80, &[]);
    sent.extend(bench.receive(Frame::remote(CanId::standard(0x185).unwrap(), 2)));
    sent.extend(bench.pass(100).into_iter().map(|(_, frame)| frame));
    sent.is_empty()
}

#[cfg(feature = "sync")]
#[test]
fn a_cob_id_that_no_client_could_write_has_no_effect() {
    let restricted =
        [0, 1, 0x7F, 0x101, 0x180, 0x581, 0x5FF, 0x601, 0x67F, 0x6E0, 0x701, 0x77F, 0x7E4, 0x7FF];
    let others = [0x2000_0185, 0x0000_0985, 0x1000_0185];
    for value in restricted.into_iter().chain(others) {
        // As the file has it.
        let device = with_values().u32(0x1005, 0, RW, 0x80).pdo(0x1800, 0x185, 1, &[0x2000_0010]);
        let mut node = Bench::new(device.build());
        assert!(!is_silent(&mut node), "the test sees a TPDO");
        let mut device = device_with(0x1800, 1, value);
        assert!(is_silent(&mut device), "{value:X}");
        assert_eq!(device.node.why_not_sent(device.now, 1), NotSent::Disabled);
        assert_eq!(refused(&mut device), [(0x1800, 1)]);
        // What does not exist can be configured.
        device.write(0x1800, 1, &[0x85, 1, 0, 0]).unwrap();
        assert_eq!(device.ask(0x80, &[]), [frame(0x185, &[0x34, 0x12])]);
        assert_eq!(refused(&mut device), []);
    }
    // Bit 31 makes it a value that could be written.
    let mut device = device_with(0x1800, 1, 0x8000_0000);
    assert!(is_silent(&mut device) && refused(&mut device).is_empty());
}

/// A device with all services, of which one entry has another default.
fn device_with(index: u16, sub_index: u8, value: u32) -> Bench {
    Bench::new(device().with(index, sub_index, &value.to_le_bytes()).build())
}

fn refused(bench: &mut Bench) -> Vec<(u16, u8)> {
    let mut refused = Vec::new();
    let mut report = |entry: &Entry, _: AbortCode| refused.push((entry.index.0, entry.sub_index.0));
    bench.node.refused(&mut *bench.app, &mut report);
    refused
}

#[cfg(all(feature = "heartbeat-consumer", feature = "sync"))]
#[test]
fn every_value_of_a_service_is_looked_at() {
    let cases: [(u16, u8, u32); 12] = [
        (0x1005, 0, 0x0000_0001),
        (0x1012, 0, 0x8000_0701),
        (0x1012, 0, 0x4000_0100),
        (0x1014, 0, 0x0000_0000),
        (0x1014, 0, 0x2000_0085),
        (0x1016, 1, 0xFF14_0064),
        (0x1019, 0, 1),
        (0x1029, 1, 5),
        (0x1201, 1, 0x0000_0701),
        (0x1400, 1, 0x0000_0000),
        (0x1400, 2, 250),
        (0x1800, 6, 241),
    ];
    for (index, sub_index, value) in cases {
        let mut bench = device_with(index, sub_index, value);
        assert_eq!(refused(&mut bench), [(index, sub_index)]);
    }
    assert_eq!(refused(&mut bench()), []);

    let mut bench = device_with(0x1005, 0, 0x701);
    bench.nmt(1);
    assert_eq!(bench.ask(0x701, &[]), []);
    let mut bench = device_with(0x1014, 0, 0);
    bench.nmt(1);
    assert_eq!(bench.ask(0x205, &[1]), [], "an EMCY message on 000h would be a command");
    assert_eq!(bench.read(0x1001, 0), Ok([0x11].into()));
    let mut bench = device_with(0x1400, 1, 0x601);
    bench.nmt(1);
    bench.ask(0x601, &[9, 9]);
    assert_eq!(bench.read(0x2000, 0), Ok([0x34, 0x12].into()));
    let mut bench = device_with(0x1019, 0, 1);
    bench.nmt(1);
    assert_eq!(bench.ask(0x80, &[]).len(), 1, "no counter is expected");
    let mut bench = device_with(0x1016, 1, 0xFF14_0064);
    bench.ask(0x714, &[5]);
    assert_eq!(bench.pass(1000), []);
    // A node that two entries name is monitored by the first one.
    let twice = device().with(0x1016, 1, &[100, 0, 20, 0]).with(0x1016, 2, &[50, 0, 20, 0]);
    let mut bench = Bench::new(twice.build());
    bench.ask(0x714, &[5]);
    assert_eq!(bench.pass(200).iter().map(|(time, _)| *time).collect::<Vec<_>>(), [100_000]);
    assert_eq!(refused(&mut bench), [(0x1016, 2)]);
}

#[test]
fn the_history_and_the_register_begin_empty() {
    let device = plain_with_history().with(0x1003, 0, &[2]).with(0x1001, 0, &[0x81]);
    let mut bench = Bench::new(device.build());
    assert_eq!((bench.read(0x1003, 0), bench.read(0x1001, 0)), (Ok([0].into()), Ok([0].into())));
    assert_eq!(bench.read(0x1003, 1), Err(0x0800_0024));
}

fn plain_with_history() -> Builder {
    with_values().u8(0x1003, 0, RW, 0).u32(0x1003, 1, RW, 7).u32(0x1003, 2, RW, 7)
}

/// Refuses 7, and notes what was refused.
struct Picky(Rc<RefCell<Vec<(u16, u16, u32)>>>);

impl Application for Picky {
    fn before_write(&mut self, _: &mut Services<'_>, entry: &Entry, data: &[u8]) -> Result<(), AbortCode> {
        let is_refused = entry.index == Index(0x2000) && data == [7, 0];
        if is_refused { Err(AbortCode(0x0800_0021)) } else { Ok(()) }
    }

    fn rpdo_value_refused(&mut self, _: &mut Services<'_>, number: u16, entry: &Entry, code: AbortCode) {
        self.0.borrow_mut().push((number, entry.index.0, code.0));
    }
}

#[cfg(feature = "sync")]
#[test]
fn rules_hold_for_rpdos_and_refusals_are_told() {
    let noted = Rc::new(RefCell::new(Vec::new()));
    let device = with_values()
        .u32(0x1005, 0, RW, 0x80)
        .u16(0x100C, 0, RW.and(Flags::RPDO), 0)
        .pdo(0x1400, 0x200, 255, &[0x2000_0010, 0x2001_0008])
        .pdo(0x1401, 0x300, 1, &[0x2001_0008])
        .build();
    let mut bench = Bench::with(device, Box::new(NoStorage), Box::new(Picky(noted.clone())));
    bench.nmt(1);
    bench.ask(0x205, &[7, 0, 11]);
    assert_eq!(*noted.borrow(), [(1, 0x2000, 0x0800_0021), (1, 0x2001, 0x0609_0031)]);
    assert_eq!((bench.read(0x2000, 0), bench.read(0x2001, 0)), (Ok([0x34, 0x12].into()), Ok([7].into())));
    bench.ask(0x205, &[8, 0, 3]);
    assert_eq!((bench.read(0x2000, 0), bench.read(0x2001, 0)), (Ok([8, 0].into()), Ok([3].into())));
    bench.ask(0x305, &[0x80]);
    assert_eq!(noted.borrow().len(), 2);
    bench.ask(0x80, &[]);
    assert_eq!(noted.borrow()[2], (2, 0x2001, 0x0609_0032));
    assert_eq!(bench.node.refused_rpdo_values(), 3);
    assert_eq!(bench.write(0x2000, 0, &[7, 0]), Err(0x0800_0021), "as for a client");
}

#[test]
fn an_rpdo_brings_a_parameter_as_a_client_does() {
    let device = with_values()
        .u32(0x1014, 0, COB_ID, 0x80)
        .u16(0x1015, 0, RW.and(Flags::RPDO), 0)
        .u8(0x1019, 0, RW.and(Flags::RPDO), 0)
        .with(0x1017, 0, &[0, 0])
        .rights(0x1017, 0, RW.and(Flags::RPDO))
        .pdo(0x1400, 0x200, 255, &[0x1017_0010, 0x1019_0008])
        .build();
    let mut bench = Bench::new(device);
    bench.nmt(1);
    assert_eq!(bench.ask(0x205, &[100, 0, 241]), [frame(0x705, &[5])]);
    assert_eq!(bench.pass(200).len(), 2, "the heartbeat has begun");
    assert_eq!(bench.read(0x1019, 0), Ok([0].into()), "no client could write this");
    assert_eq!(bench.node.refused_rpdo_values(), 1);
}

#[cfg(feature = "sync")]
#[test]
fn mappings_have_the_granularity_of_the_device() {
    let settings = Settings { node_id: NodeId::new(5).ok(), granularity: 8, ..Settings::DEFAULT };
    let device = device().pdo(0x1801, 0x280, 1, &[0x2008_0001]).build();
    let mut bench = Bench::off(device, settings, Box::new(NoStorage));
    bench.poll();
    assert_eq!(bench.node.why_not_sent(bench.now, 2), NotSent::MappingInvalid);
    bench.write(0x1801, 1, &[0x85, 2, 0, 0x80]).unwrap();
    bench.write(0x1A01, 0, &[0]).unwrap();
    assert_eq!(bench.write(0x1A01, 1, &[1, 0, 8, 0x20]), Err(0x0604_0041));
    assert_eq!(bench.write(0x1A01, 1, &[8, 0, 8, 0x20]), Ok(()));
}
