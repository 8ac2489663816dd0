use super::device::{Builder, COB_ID, RO, RW, with_values};
use super::{Bench, frame};
use crate::{Application, Frame, Instant, NotSent, Services};
use edskit_types::{CanId, Index, NmtState};
use std::boxed::Box;
use std::vec::Vec;

const TPDO: u16 = 0x1800;
const RPDO: u16 = 0x1400;

fn device() -> Builder {
    with_values()
        .u32(0x1005, 0, RW, 0x80)
        .u8(0x1003, 0, RW, 0)
        .u32(0x1003, 1, RO, 0)
        .u32(0x1014, 0, COB_ID, 0x80)
        .u8(0x1019, 0, RW, 0)
}

/// A node in operational with one TPDO and one RPDO of 2000h and 2001h.
fn bench(transmission: u8) -> Bench {
    let mapping = [0x2000_0010, 0x2001_0008];
    let device = device().pdo(TPDO, 0x180, transmission, &mapping).pdo(RPDO, 0x200, transmission, &mapping);
    let mut bench = Bench::new(device.build());
    bench.nmt(1);
    bench
}

fn sync(bench: &mut Bench) -> Vec<Frame> {
    bench.ask(0x80, &[])
}

const CONTENT: [u8; 3] = [0x34, 0x12, 7];

#[cfg(feature = "sync")]
#[test]
fn synchronous_tpdos() {
    for (every, expected) in [(1, [1, 1, 1, 1]), (2, [0, 1, 0, 1]), (240, [0; 4])] {
        let mut bench = bench(every);
        let counts = [0; 4].map(|_| sync(&mut bench).len());
        assert_eq!(counts, expected, "type {every}");
    }
    let mut bench = bench(1);
    assert_eq!(sync(&mut bench), [frame(0x185, &CONTENT)]);
    for command in [128, 2] {
        bench.nmt(command);
        assert!(sync(&mut bench).is_empty());
    }
}

#[cfg(feature = "sync")]
#[test]
fn an_acyclic_tpdo_needs_an_event_and_a_sync() {
    let mut bench = bench(0);
    assert_eq!(sync(&mut bench).len(), 1, "starting is an event");
    assert!(sync(&mut bench).is_empty());
    bench.node.services(bench.now).trigger(1);
    assert!(bench.poll().is_empty());
    assert_eq!(sync(&mut bench).len(), 1);
}

#[test]
fn events_timer_and_inhibit_time() {
    let mut bench = bench(255);
    bench.poll();
    assert!(bench.pass(5000).is_empty());
    bench.node.services(bench.now).trigger(1);
    assert_eq!(bench.poll(), [frame(0x185, &CONTENT)]);
    bench.write(TPDO, 5, &[100, 0]).unwrap();
    let times: Vec<u64> = bench.pass(350).iter().map(|(time, _)| *time).collect();
    assert_eq!(times, [100_000, 200_000, 300_000]);
    assert_eq!(bench.write(TPDO, 3, &[0xB8, 0x0B]), Err(0x0800_0022), "only while the PDO is not valid");
    bench.write(TPDO, 1, &[0x85, 1, 0, 0x80]).unwrap();
    bench.write(TPDO, 3, &[0xB8, 0x0B]).unwrap();
    bench.write(TPDO, 5, &[50, 0]).unwrap();
    bench.write(TPDO, 1, &[0x85, 1, 0, 0]).unwrap();
    let times: Vec<u64> = bench.pass(1000).iter().map(|(time, _)| *time).collect();
    assert!(times.windows(2).all(|pair| pair[1] - pair[0] >= 300_000) && times.len() >= 3, "{times:?}");
}

#[test]
fn a_changed_value_is_an_event_of_the_pdos_that_carry_it() {
    let mut bench = bench(254);
    bench.poll();
    let position =
        |bench: &mut Bench, index| bench.node.objects().table().find(Index(index), edskit_types::SubIndex(0));
    let (mapped, other) = (position(&mut bench, 0x2001).unwrap(), position(&mut bench, 0x2002).unwrap());
    bench.node.services(bench.now).changed(other);
    assert!(bench.poll().is_empty());
    bench.node.services(bench.now).changed(mapped);
    assert_eq!(bench.poll().len(), 1);
}

#[cfg(all(feature = "rtr", feature = "sync"))]
#[test]
fn remote_requests() {
    let request = Frame::remote(CanId::standard(0x185).unwrap(), 8);
    let mut bench = bench(253);
    assert_eq!(bench.receive(request), [frame(0x185, &CONTENT)]);
    let mut bench = self::bench(252);
    assert!(bench.receive(request).is_empty(), "nothing is sampled yet");
    sync(&mut bench);
    bench.write(0x2001, 0, &[9]).unwrap();
    assert_eq!(bench.receive(request), [frame(0x185, &CONTENT)], "as it was at the SYNC message");
    bench.write(TPDO, 1, &[0x85, 1, 0, 0xC0]).unwrap();
    bench.write(TPDO, 1, &[0x85, 1, 0, 0x40]).unwrap();
    assert!(bench.receive(request).is_empty(), "bit 30 forbids it");
}

#[test]
fn rpdos_count_in_operational_only() {
    let mut bench = bench(255);
    bench.poll();
    bench.ask(0x205, &[1, 2, 3]);
    assert_eq!((bench.read(0x2000, 0), bench.read(0x2001, 0)), (Ok([1, 2].into()), Ok([3].into())));
    bench.nmt(128);
    bench.ask(0x205, &[9, 9, 9]);
    assert_eq!(bench.read(0x2000, 0), Ok([1, 2].into()));
}

#[cfg(feature = "sync")]
#[test]
fn a_synchronous_rpdo_counts_from_the_sync_on() {
    let mut bench = bench(1);
    bench.ask(0x205, &[1, 2, 3]);
    assert_eq!(bench.read(0x2000, 0), Ok([0x34, 0x12].into()));
    sync(&mut bench);
    assert_eq!(bench.read(0x2000, 0), Ok([1, 2].into()));
}

#[test]
fn lengths_of_rpdos() {
    let mut bench = bench(255);
    bench.poll();
    assert_eq!(bench.ask(0x205, &[1, 2]), [frame(0x85, &[0x10, 0x82, 0x11, 1, 0, 2, 0, 0])]);
    assert_eq!(bench.read(0x2000, 0), Ok([0x34, 0x12].into()));
    assert_eq!(bench.ask(0x205, &[1, 2, 3, 4, 5]), [frame(0x85, &[0; 8])], "the leading bytes count");
    assert_eq!(bench.read(0x2000, 0), Ok([1, 2].into()));
}

#[test]
fn limits_hold_for_rpdos_too() {
    let mut bench = bench(255);
    bench.ask(0x205, &[1, 2, 11]);
    assert_eq!((bench.read(0x2000, 0), bench.read(0x2001, 0)), (Ok([1, 2].into()), Ok([7].into())));
}

#[test]
fn an_rpdo_that_does_not_come_in_time() {
    let mut bench = bench(255);
    bench.poll();
    bench.write(RPDO, 5, &[150, 0]).unwrap();
    assert!(bench.pass(1000).is_empty(), "the first one starts the timer");
    bench.ask(0x205, &CONTENT);
    assert_eq!(bench.pass(500), [(150_000, frame(0x85, &[0x50, 0x82, 0x11, 1, 0, 0, 0, 0]))]);
    assert_eq!(bench.ask(0x205, &CONTENT), [frame(0x85, &[0; 8])]);
}

/// Makes TPDO 1 invalid, writes its mapping, and makes it valid again.
fn remap(bench: &mut Bench, pdo: u16, mapping: &[u32]) -> Result<(), u32> {
    let cob_id = bench.read(pdo, 1).unwrap();
    let mut off = cob_id.clone();
    off[3] |= 0x80;
    bench.write(pdo, 1, &off)?;
    bench.write(pdo + 0x200, 0, &[0])?;
    for (place, entry) in mapping.iter().enumerate() {
        bench.write(pdo + 0x200, place as u8 + 1, &entry.to_le_bytes())?;
    }
    bench.write(pdo + 0x200, 0, &[mapping.len() as u8])?;
    bench.write(pdo, 1, &cob_id)
}

#[cfg(feature = "sync")]
#[test]
fn mappings_can_change() {
    let mut bench = bench(1);
    remap(&mut bench, TPDO, &[0x2005_0010, 0x2001_0008, 0x2002_0020]).unwrap();
    assert_eq!(sync(&mut bench), [frame(0x185, &[0xAA, 0x55, 7, 0, 0, 0, 0])]);
    remap(&mut bench, TPDO, &[0x2008_0001, 0x2008_0001, 0x2000_0010]).unwrap();
    bench.write(0x2008, 0, &[1]).unwrap();
    assert_eq!(sync(&mut bench), [frame(0x185, &[0b1101_0011, 0b0100_1000, 0])], "bit by bit");
    remap(&mut bench, RPDO, &[0x0005_0008, 0x2000_0010]).unwrap();
    bench.ask(0x205, &[0xFF, 1, 2]);
    sync(&mut bench);
    assert_eq!(bench.read(0x2000, 0), Ok([1, 2].into()), "a dummy fills the first byte");
}

#[test]
fn mappings_that_cannot_be() {
    let mut bench = bench(1);
    for (mapping, code) in [
        (&[0x5FFE_0008][..], 0x0602_0000),
        (&[0x1018_7708], 0x0609_0011),
        (&[0x1017_0010], 0x0604_0041),
        (&[0x2004_0010], 0x0604_0041),
        (&[0x0005_0008], 0x0604_0041),
        (&[0x2000_0018], 0x0607_0010),
        (&[0x2000_0008], 0x0607_0010),
        (&[0x2000_0000], 0x0607_0010),
        (&[0x200A_0040, 0x2001_0008], 0x0604_0042),
    ] {
        assert_eq!(remap(&mut bench, TPDO, mapping), Err(code), "{mapping:08X?}");
    }
    assert_eq!(remap(&mut bench, RPDO, &[0x2005_0010]), Err(0x0604_0041));
    assert_eq!(bench.write(0x1A00, 0, &[9]), Err(0x0604_0042), "there are eight places");
}

#[cfg(feature = "sync")]
#[test]
fn the_order_of_writes_is_prescribed_in_every_state() {
    for command in [1, 128] {
        let mut bench = bench(1);
        bench.nmt(command);
        assert_eq!(bench.write(0x1A00, 0, &[0]), Err(0x0601_0000), "the PDO is valid");
        assert_eq!(bench.write(TPDO, 1, &[0x86, 1, 0, 0]), Err(0x0609_0030));
        bench.write(TPDO, 1, &[0x85, 1, 0, 0x80]).unwrap();
        assert_eq!(bench.write(0x1A00, 1, &[0x10, 0, 0, 0x20]), Err(0x0601_0000), "entries count");
        for restricted in [0, 0x7F, 0x180, 0x601, 0x6E0, 0x701, 0x7E4] {
            let value = u32::to_le_bytes(restricted);
            assert_eq!(bench.write(TPDO, 1, &value), Err(0x0609_0030), "{restricted:X}");
        }
        assert_eq!(bench.write(TPDO, 1, &[0x85, 1, 0, 0x20]), Err(0x0609_0030), "29 bits");
        for reserved in [241, 251] {
            assert_eq!(bench.write(TPDO, 2, &[reserved]), Err(0x0609_0030));
            assert_eq!(bench.write(RPDO, 2, &[reserved + 1]), Err(0x0609_0030));
        }
    }
}

#[cfg(feature = "sync")]
#[test]
fn the_start_value_of_sync() {
    let mut bench = bench(2);
    bench.write(0x1019, 0, &[10]).unwrap();
    bench.write(TPDO, 1, &[0x85, 1, 0, 0x80]).unwrap();
    assert_eq!(bench.write(TPDO, 6, &[241]), Err(0x0609_0030));
    bench.write(TPDO, 6, &[4]).unwrap();
    bench.write(TPDO, 1, &[0x85, 1, 0, 0]).unwrap();
    assert_eq!(bench.node.why_not_sent(bench.now, 1), NotSent::WaitsForSyncStart(4));
    let sent: Vec<u8> = (1..=10).filter(|counter| !bench.ask(0x80, &[*counter]).is_empty()).collect();
    assert_eq!(sent, [4, 6, 8, 10]);
}

#[cfg(all(feature = "rtr", feature = "sync"))]
#[test]
fn why_a_tpdo_is_not_sent() {
    let why = |bench: &mut Bench| bench.node.why_not_sent(bench.now, 1);
    let mut bench = bench(3);
    assert_eq!(why(&mut bench), NotSent::WaitsForSync(3));
    sync(&mut bench);
    assert_eq!(why(&mut bench), NotSent::WaitsForSync(2));
    bench.nmt(128);
    assert_eq!(why(&mut bench), NotSent::NotOperational(NmtState::PreOperational));
    remap(&mut bench, TPDO, &[]).unwrap();
    assert_eq!(why(&mut bench), NotSent::NothingMapped);
    bench.write(TPDO, 1, &[0x85, 1, 0, 0x80]).unwrap();
    assert_eq!(why(&mut bench), NotSent::Disabled);
    let mut bench = self::bench(255);
    bench.poll();
    assert_eq!(why(&mut bench), NotSent::NoEvent(Instant::NEVER));
    let mut bench = self::bench(253);
    assert_eq!(why(&mut bench), NotSent::WaitsForRequest);
    let wrong = device().pdo(TPDO, 0x180, 1, &[0x5555_0010]).build();
    assert_eq!(why(&mut Bench::new(wrong)), NotSent::MappingInvalid);
}

#[cfg(feature = "sync")]
#[test]
fn a_reset_brings_the_configuration_back() {
    let mut bench = bench(1);
    remap(&mut bench, TPDO, &[0x2001_0008]).unwrap();
    bench.write(TPDO, 2, &[5]).unwrap();
    bench.nmt(130);
    bench.nmt(1);
    assert_eq!(sync(&mut bench), [frame(0x185, &CONTENT)]);
}

/// Brings a value up to date when a PDO is about to carry it, and doubles what it receives.
struct Doubling;

impl Application for Doubling {
    fn tpdo_due(&mut self, node: &mut Services<'_>, _: u16) {
        node.objects.set_value(Index(0x2001), 0, 10_u8);
    }

    fn rpdo_received(&mut self, node: &mut Services<'_>, _: u16) {
        let value: u16 = node.objects.value(Index(0x2000), 0).unwrap();
        node.objects.set_value(Index(0x2000), 0, 2 * value);
    }
}

#[cfg(feature = "sync")]
#[test]
fn hooks_see_pdos_come_and_go() {
    let mapping = [0x2000_0010, 0x2001_0008];
    let device = device().pdo(TPDO, 0x180, 1, &mapping).pdo(RPDO, 0x200, 255, &mapping).build();
    let mut bench = Bench::with(device, Box::new(crate::NoStorage), Box::new(Doubling));
    bench.nmt(1);
    bench.ask(0x205, &[4, 0, 1]);
    assert_eq!(sync(&mut bench), [frame(0x185, &[8, 0, 10])]);
}
