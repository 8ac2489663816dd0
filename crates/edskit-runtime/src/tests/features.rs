//! What a node without a service does where its dictionary claims the service.
//!
//! A value that would need the service is refused, wherever it comes from, and has no effect.

use super::device::{Builder, RW, with_values};
use super::{Bench, frame};

const INVALID_VALUE: u32 = 0x0609_0030;

/// A device whose EDS claims every service.
fn claims() -> Builder {
    with_values()
        .u32(0x1005, 0, RW, 0x80)
        .u32(0x1006, 0, RW, 1000)
        .u32(0x1010, 1, RW, 1)
        .u32(0x1011, 1, RW, 1)
        .u16(0x100C, 0, RW, 100)
        .u8(0x100D, 0, RW, 3)
        .u32(0x1012, 0, RW, 0x8000_0100)
        .u32(0x1016, 1, RW, 0x0007_0064)
        .u8(0x1019, 0, RW, 0)
        .u32(0x1201, 1, RW, 0x641)
        .u32(0x1201, 2, RW, 0x5C1)
        .pdo(0x1800, 0x180, 0xFF, &[0x2000_0010])
}

/// A client reads the default of an entry, and cannot write it again: it would need the service.
fn reads_only(index: u16, sub_index: u8, default: &[u8], unused: &[u8]) {
    let mut bench = Bench::new(claims().build());
    assert_eq!(bench.read(index, sub_index).as_deref(), Ok(default), "{index:X}");
    assert_eq!(bench.write(index, sub_index, default), Err(INVALID_VALUE), "{index:X}");
    assert_eq!(bench.write(index, sub_index, unused), Ok(()), "{index:X}");
    let mut refused = std::vec::Vec::new();
    let mut bench = Bench::new(claims().build());
    bench.node.refused(&mut *bench.app, &mut |entry, code| refused.push((entry.index.0, code.0)));
    assert!(refused.contains(&(index, INVALID_VALUE)), "{refused:X?}");
}

#[test]
#[cfg(not(feature = "guarding"))]
fn nobody_is_guarded() {
    reads_only(0x100C, 0, &[100, 0], &[0, 0]);
    let mut bench = Bench::new(claims().build());
    assert_eq!(bench.receive(crate::Frame::remote(super::frame(0x705, &[]).can_id(), 1)), []);
    assert_eq!(bench.pass(10_000), []);
}

#[test]
#[cfg(not(feature = "heartbeat-consumer"))]
fn nobody_is_monitored() {
    reads_only(0x1016, 1, &[0x64, 0, 7, 0], &[0, 0, 7, 0]);
    let mut bench = Bench::new(claims().build());
    assert_eq!(bench.ask(0x707, &[5]), []);
    assert_eq!(bench.pass(10_000), []);
}

#[test]
#[cfg(not(feature = "time"))]
fn no_time_is_taken() {
    reads_only(0x1012, 0, &[0, 1, 0, 0x80], &[0, 1, 0, 0]);
    let mut bench = Bench::new(claims().build());
    assert_eq!(bench.write(0x1012, 0, &[0, 1, 0, 0x40]), Err(INVALID_VALUE));
}

#[test]
#[cfg(not(feature = "sync"))]
fn no_pdo_is_synchronous() {
    let mut bench = Bench::new(claims().build());
    for transmission in [0, 1, 240, 252] {
        assert_eq!(bench.write(0x1800, 2, &[transmission]), Err(INVALID_VALUE), "{transmission}");
    }
    assert_eq!(bench.write(0x1800, 2, &[254]), Ok(()));
    assert_eq!(bench.write(0x1005, 0, &[0x80, 0, 0, 0x40]), Err(INVALID_VALUE));
    assert_eq!(bench.write(0x1019, 0, &[10]), Err(INVALID_VALUE));
    // A PDO whose default is synchronous does not exist.
    let mut bench = Bench::new(with_values().pdo(0x1800, 0x180, 1, &[0x2000_0010]).build());
    assert_eq!(bench.nmt(1), []);
    assert_eq!(bench.ask(0x80, &[]), []);
    assert_eq!(bench.node.why_not_sent(bench.now, 1), crate::NotSent::Disabled);
}

#[test]
#[cfg(not(feature = "rtr"))]
fn no_request_is_answered() {
    let mut bench = Bench::new(claims().build());
    for transmission in [252, 253] {
        assert_eq!(bench.write(0x1800, 2, &[transmission]), Err(INVALID_VALUE), "{transmission}");
    }
    assert_eq!(bench.nmt(1), [frame(0x185, &[0x34, 0x12])]);
    assert_eq!(bench.receive(crate::Frame::remote(frame(0x185, &[]).can_id(), 2)), []);
}

#[test]
#[cfg(not(feature = "block-transfer"))]
fn block_transfer_is_an_unknown_command() {
    let mut bench = Bench::new(claims().build());
    for command in [0xA0, 0xA4, 0xC0, 0xC2, 0xC6] {
        assert_eq!(bench.sdo([command, 0x00, 0x20, 0, 127, 0, 0, 0]), Err(0x0504_0001), "{command:X}");
    }
    assert_eq!(bench.read(0x2000, 0), Ok([0x34, 0x12].to_vec()));
}

#[test]
#[cfg(not(feature = "storage"))]
fn nothing_is_saved() {
    let mut bench = Bench::new(claims().build());
    assert_eq!(bench.write(0x1010, 1, b"evas"), Err(0x0800_0020));
    assert_eq!(bench.write(0x1010, 1, b"save"), Err(0x0606_0000));
    // There is nothing to be forgotten.
    assert_eq!(bench.write(0x1011, 1, b"load"), Ok(()));
}

#[test]
#[cfg(not(feature = "lss"))]
fn lss_gets_no_answer() {
    let mut bench = Bench::new(claims().build());
    for request in [[0x04, 1, 0, 0, 0, 0, 0, 0], [0x5E, 0, 0, 0, 0, 0, 0, 0], [0x4C, 0, 0, 0, 0, 0, 0, 0]] {
        assert_eq!(bench.ask(0x7E5, &request), []);
    }
}

#[test]
#[cfg(not(feature = "further-sdo-servers"))]
fn there_is_one_sdo_server() {
    reads_only(0x1201, 1, &[0x41, 6, 0, 0], &[0x41, 6, 0, 0x80]);
    let mut bench = Bench::new(claims().build());
    assert_eq!(bench.ask(0x641, &[0x40, 0x00, 0x10, 0, 0, 0, 0, 0]), []);
}
