//! Parameters of PDOs change while they run: what hangs on a parameter ends with it.

use super::device::{Builder, COB_ID, RW, with_values};
use super::{Bench, frame};
use crate::{Application, Entry, Frame, Instant, NoStorage, NotSent, Position, Services};
use edskit_types::{CanId, Index, SubIndex};
use std::boxed::Box;
use std::vec::Vec;

const TPDO: u16 = 0x1800;
const RPDO: u16 = 0x1400;
const TIME_OUT: [u8; 8] = [0x50, 0x82, 0x11, 1, 0, 0, 0, 0];
const TOO_SHORT: [u8; 8] = [0x10, 0x82, 0x11, 1, 0, 1, 0, 0];
const GONE: [u8; 8] = [0; 8];

fn device(transmission: u8) -> Builder {
    with_values()
        .u32(0x1005, 0, RW, 0x80)
        .u32(0x1006, 0, RW, 0)
        .u32(0x1007, 0, RW, 0)
        .u32(0x1014, 0, COB_ID, 0x80)
        .u8(0x1019, 0, RW, 0)
        .pdo(TPDO, 0x180, transmission, &[0x2000_0010])
        .pdo(RPDO, 0x200, transmission, &[0x2002_0020])
}

fn bench(transmission: u8) -> Bench {
    let mut bench = Bench::new(device(transmission).build());
    bench.nmt(1);
    bench.poll();
    bench
}

/// The value that the RPDO carries.
fn received(bench: &mut Bench) -> u32 {
    bench.node.objects().value(Index(0x2002), 0).unwrap()
}

fn set(bench: &mut Bench, index: u16, sub_index: u8, value: &[u8]) {
    bench.write(index, sub_index, value).unwrap();
}

fn invalid(bench: &mut Bench, pdo: u16) {
    let mut cob_id = bench.read(pdo, 1).unwrap();
    cob_id[3] |= 0x80;
    set(bench, pdo, 1, &cob_id);
}

fn valid(bench: &mut Bench, pdo: u16) {
    let mut cob_id = bench.read(pdo, 1).unwrap();
    cob_id[3] &= 0x7F;
    set(bench, pdo, 1, &cob_id);
}

fn sync(bench: &mut Bench) -> Vec<Frame> {
    bench.ask(0x80, &[])
}

/// A remote request for the TPDO.
fn request(bench: &mut Bench) -> Vec<Frame> {
    bench.receive(Frame::remote(CanId::standard(0x185).unwrap(), 8))
}

fn times(sent: &[(u64, Frame)]) -> Vec<u64> {
    sent.iter().filter(|(_, frame)| frame.can_id().raw() == 0x185).map(|(time, _)| *time).collect()
}

// W1

#[cfg(feature = "sync")]
#[test]
fn waiting_data_end_with_their_rpdo() {
    type Change = fn(&mut Bench);
    let changes: [(&str, Change); 8] = [
        ("invalid", |bench| invalid(bench, RPDO)),
        ("invalid and valid", |bench| {
            invalid(bench, RPDO);
            valid(bench, RPDO);
        }),
        ("another identifier", |bench| {
            invalid(bench, RPDO);
            set(bench, RPDO, 1, &[0x06, 2, 0, 0]);
        }),
        ("remapped", |bench| {
            invalid(bench, RPDO);
            set(bench, 0x1600, 0, &[0]);
            set(bench, 0x1600, 1, &[0x10, 0, 4, 0x20]);
            set(bench, 0x1600, 0, &[1]);
            valid(bench, RPDO);
        }),
        ("event-driven", |bench| set(bench, RPDO, 2, &[255])),
        ("event-driven and back", |bench| {
            set(bench, RPDO, 2, &[254]);
            set(bench, RPDO, 2, &[1]);
        }),
        ("pre-operational and back", |bench| {
            bench.nmt(128);
            bench.nmt(1);
        }),
        ("reset", |bench| {
            bench.nmt(130);
            bench.nmt(1);
        }),
    ];
    for (name, change) in changes {
        let mut bench = bench(1);
        bench.ask(0x205, &[0x11, 0x22, 0x33, 0x44]);
        change(&mut bench);
        sync(&mut bench);
        assert_eq!(received(&mut bench), 0, "{name}");
        assert_eq!(bench.read(0x2000, 0), Ok([0x34, 0x12].into()), "{name}");
    }
}

#[cfg(feature = "sync")]
#[test]
fn waiting_data_stay_where_nothing_is_another() {
    type Change = fn(&mut Bench);
    let changes: [Change; 4] = [
        |bench| set(bench, RPDO, 2, &[0]),
        |bench| set(bench, RPDO, 2, &[1]),
        |bench| set(bench, RPDO, 5, &[100, 0]),
        |bench| set(bench, RPDO, 1, &[5, 2, 0, 0]),
    ];
    for change in changes {
        let mut bench = bench(1);
        bench.ask(0x205, &[0x11, 0x22, 0x33, 0x44]);
        change(&mut bench);
        sync(&mut bench);
        assert_eq!(received(&mut bench), 0x4433_2211);
    }
}

// W2, W11

#[test]
fn monitoring_ends_with_what_is_monitored() {
    type Change = fn(&mut Bench);
    let changes: [Change; 4] = [
        |bench| invalid(bench, RPDO),
        |bench| {
            invalid(bench, RPDO);
            valid(bench, RPDO);
        },
        |bench| set(bench, RPDO, 5, &[0, 0]),
        |bench| drop(bench.nmt(128)),
    ];
    for change in changes {
        let mut bench = bench(255);
        set(&mut bench, RPDO, 5, &[200, 0]);
        bench.ask(0x205, &[0; 4]);
        change(&mut bench);
        assert_eq!(bench.pass(1000), [], "before the deadline");
        assert_eq!(bench.read(0x1001, 0), Ok([0].into()));

        let mut bench = self::bench(255);
        set(&mut bench, RPDO, 5, &[200, 0]);
        bench.ask(0x205, &[0; 4]);
        assert_eq!(bench.pass(300), [(200_000, frame(0x85, &TIME_OUT))]);
        change(&mut bench);
        assert_eq!(bench.read(0x1001, 0), Ok([0].into()), "after it");
        assert_eq!(bench.pass(1000), []);
    }
}

#[test]
fn the_error_of_an_old_time_is_none_of_the_new_one() {
    let mut bench = bench(255);
    set(&mut bench, RPDO, 5, &[200, 0]);
    bench.ask(0x205, &[0; 4]);
    bench.pass(300);
    let sent = bench.ask(0x605, &[0x2B, 0, 0x14, 5, 100, 0, 0, 0]);
    assert!(sent.contains(&frame(0x85, &GONE)), "{sent:?}");
    assert_eq!(bench.pass(1000), [], "monitoring begins with a frame");
    bench.ask(0x205, &[0; 4]);
    assert_eq!(bench.pass(150), [(100_000, frame(0x85, &TIME_OUT))]);
}

#[test]
fn a_wrong_length_ends_with_its_rpdo() {
    type Change = fn(&mut Bench);
    let changes: [Change; 3] = [
        |bench| invalid(bench, RPDO),
        |bench| {
            bench.nmt(128);
            invalid(bench, RPDO);
            valid(bench, RPDO);
        },
        |bench| {
            bench.nmt(128);
            assert_eq!(bench.read(0x1001, 0), Ok([0x11].into()), "the frame was too short in any state");
            bench.nmt(1);
            bench.ask(0x205, &[1, 2, 3, 4]);
        },
    ];
    for change in changes {
        let mut bench = bench(255);
        assert_eq!(bench.ask(0x205, &[1]), [frame(0x85, &TOO_SHORT)]);
        change(&mut bench);
        assert_eq!(bench.read(0x1001, 0), Ok([0].into()));
    }
}

// W3

#[cfg(all(feature = "rtr", feature = "sync"))]
#[test]
fn a_sample_ends_with_what_it_was_taken_for() {
    type Change = fn(&mut Bench);
    let changes: [Change; 5] = [
        |bench| {
            invalid(bench, TPDO);
            valid(bench, TPDO);
        },
        |bench| {
            invalid(bench, TPDO);
            set(bench, 0x1A00, 0, &[0]);
            set(bench, 0x1A00, 1, &[0x10, 0, 5, 0x20]);
            set(bench, 0x1A00, 0, &[1]);
            valid(bench, TPDO);
        },
        |bench| {
            set(bench, TPDO, 2, &[1]);
            set(bench, TPDO, 2, &[252]);
        },
        |bench| {
            set(bench, TPDO, 2, &[0]);
            set(bench, TPDO, 2, &[252]);
        },
        |bench| {
            bench.nmt(2);
            bench.nmt(1);
        },
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let mut bench = Bench::new(device(1).build());
        set(&mut bench, TPDO, 2, &[252]);
        bench.nmt(1);
        sync(&mut bench);
        assert_eq!(request(&mut bench), [frame(0x185, &[0x34, 0x12])]);
        change(&mut bench);
        assert_eq!(request(&mut bench), [], "{number}");
        sync(&mut bench);
        assert_eq!(request(&mut bench).len(), 1, "{number}");
    }
}

// W4

#[test]
fn the_event_timer_follows_type_and_time_in_any_order() {
    let orders: [[(u8, &[u8]); 2]; 2] = [[(5, &[200, 0]), (2, &[254])], [(2, &[254]), (5, &[200, 0])]];
    for order in orders {
        for state in [1, 128] {
            let mut bench = bench(1);
            bench.nmt(state);
            sync(&mut bench);
            for (sub_index, value) in order {
                set(&mut bench, TPDO, sub_index, value);
            }
            let sent = bench.pass(700);
            let expected = if state == 1 { &[200_000, 400_000, 600_000][..] } else { &[] };
            assert_eq!(times(&sent), expected);
        }
    }
}

#[cfg(all(feature = "rtr", feature = "sync"))]
#[test]
fn every_change_of_class_ends_what_the_old_one_did() {
    for to in [0, 1, 240, 252, 253] {
        let mut bench = bench(255);
        set(&mut bench, TPDO, 5, &[100, 0]);
        assert_eq!(bench.pass(150).len(), 1);
        set(&mut bench, TPDO, 2, &[to]);
        assert_eq!(bench.pass(1000), [], "type {to} has no event timer");
        set(&mut bench, TPDO, 2, &[254]);
        assert_eq!(times(&bench.pass(250)), [100_000, 200_000], "from {to}");
        set(&mut bench, TPDO, 2, &[255]);
        assert_eq!(times(&bench.pass(100)), [50_000], "254 and 255 are one class: the timer goes on");
    }
    // Counting begins anew with another number.
    let mut bench = bench(3);
    sync(&mut bench);
    sync(&mut bench);
    set(&mut bench, TPDO, 2, &[2]);
    let counts: Vec<usize> = (0..4).map(|_| sync(&mut bench).len()).collect();
    assert_eq!(counts, [0, 1, 0, 1]);
    set(&mut bench, TPDO, 2, &[2]);
    assert_eq!(sync(&mut bench).len() + sync(&mut bench).len(), 1, "the same type changes nothing");
}

#[cfg(all(feature = "rtr", feature = "sync"))]
#[test]
fn an_event_stays_one_in_types_that_have_events_only() {
    for (through, is_kept) in [(0, true), (1, false), (253, false)] {
        let mut bench = bench(255);
        invalid(&mut bench, TPDO);
        set(&mut bench, TPDO, 3, &10_000_u16.to_le_bytes());
        valid(&mut bench, TPDO);
        bench.node.services(bench.now).trigger(1);
        assert_eq!(bench.poll(), [], "the inhibit time runs");
        set(&mut bench, TPDO, 2, &[through]);
        assert_eq!(bench.pass(500), []);
        set(&mut bench, TPDO, 2, &[255]);
        assert_eq!(bench.pass(600).len(), usize::from(is_kept), "{through}");
    }
    // An event of a type that has none is none.
    let mut bench = bench(1);
    bench.node.services(bench.now).trigger(1);
    set(&mut bench, TPDO, 2, &[255]);
    assert_eq!(bench.pass(100), []);
}

// W5

#[test]
fn an_old_inhibit_time_does_not_hold_a_new_pdo() {
    let mut bench = bench(255);
    invalid(&mut bench, TPDO);
    set(&mut bench, TPDO, 3, &30_000_u16.to_le_bytes());
    set(&mut bench, TPDO, 5, &[20, 0]);
    valid(&mut bench, TPDO);
    assert_eq!(bench.pass(2900), [], "three seconds");
    assert!(matches!(bench.node.why_not_sent(bench.now, 1), NotSent::Inhibited(_)));
    invalid(&mut bench, TPDO);
    set(&mut bench, TPDO, 3, &[0, 0]);
    let sent = bench.ask(0x605, &[0x23, 0, 0x18, 1, 0x85, 1, 0, 0]);
    assert!(sent.contains(&frame(0x185, &[0x34, 0x12])), "{sent:?}");
    assert_eq!(times(&bench.pass(60)), [20_000, 40_000, 60_000]);
}

#[cfg(feature = "sync")]
#[test]
fn a_window_that_runs_follows_its_parameter() {
    let cases: [(u32, bool); 3] = [(50_000, true), (0, false), (200_000, false)];
    for (window, is_late) in cases {
        let mut bench = bench(1);
        set(&mut bench, 0x1007, 0, &300_000_u32.to_le_bytes());
        sync(&mut bench);
        bench.pass(100);
        set(&mut bench, 0x1007, 0, &window.to_le_bytes());
        bench.ask(0x205, &[1, 0, 0, 0]);
        sync(&mut bench);
        assert_eq!(received(&mut bench), u32::from(!is_late), "{window}");
    }
    // Another SYNC message has had no period yet.
    let mut bench = bench(1);
    set(&mut bench, 0x1007, 0, &10_000_u32.to_le_bytes());
    sync(&mut bench);
    bench.pass(100);
    set(&mut bench, 0x1005, 0, &[0xA0, 0, 0, 0]);
    bench.ask(0x205, &[1, 0, 0, 0]);
    bench.ask(0xA0, &[]);
    assert_eq!(received(&mut bench), 1);
}

#[test]
fn the_device_changes_a_parameter_itself() {
    let mut bench = bench(255);
    let change = |bench: &mut Bench, index: u16, sub_index: u8, value: u32| {
        let mut objects = bench.node.objects();
        objects.set_value(Index(index), sub_index, value);
        let position = objects.table().find(Index(index), SubIndex(sub_index)).unwrap();
        bench.node.services(bench.now).update(position);
    };
    change(&mut bench, TPDO, 5, 100);
    assert_eq!(times(&bench.pass(200)), [100_000, 200_000]);
    change(&mut bench, TPDO, 3, 5000);
    assert_eq!(times(&bench.pass(1000)), [0, 500_000, 1_000_000], "the PDO begins anew");
    change(&mut bench, TPDO, 1, 0x190);
    assert!(bench.poll().contains(&frame(0x190, &[0x34, 0x12])));
    change(&mut bench, TPDO, 1, 0x601);
    assert_eq!(bench.pass(1000), [], "a client could not write this one");
    change(&mut bench, 0x1017, 0, 500);
    assert_eq!(bench.poll(), [frame(0x705, &[5])]);
    assert_eq!(bench.pass(500), [(500_000, frame(0x705, &[5]))]);
}

// U3

/// Every write is an event.
struct Eventful;

impl Application for Eventful {
    fn write_is_event(&mut self, _: &Services<'_>, _: &Entry) -> bool {
        true
    }
}

#[cfg(feature = "sync")]
#[test]
fn a_written_value_is_an_event_where_the_device_says_so() {
    for transmission in [255, 254, 0, 1] {
        let mut bench = Bench::with(device(transmission).build(), Box::new(NoStorage), Box::new(Eventful));
        bench.nmt(1);
        sync(&mut bench);
        let count = |sent: &[Frame]| sent.iter().filter(|frame| frame.can_id().raw() == 0x185).count();
        let at_once = usize::from(transmission >= 254);
        let sent = bench.ask(0x605, &[0x2B, 0, 0x20, 0, 9, 9, 0, 0]);
        assert_eq!(count(&sent), at_once, "{transmission}");
        let sent = bench.ask(0x605, &[0x2B, 0, 0x20, 0, 9, 9, 0, 0]);
        assert_eq!(count(&sent), 0, "the same value again");
        assert_eq!(count(&sync(&mut bench)), usize::from(transmission < 254));
        assert_eq!(count(&sync(&mut bench)), usize::from(transmission == 1));
    }
    let mut bench = bench(255);
    let sent = bench.ask(0x605, &[0x2B, 0, 0x20, 0, 9, 9, 0, 0]);
    assert_eq!(sent.len(), 1, "by default the application says what is an event");
}

/// The positions of all values that two TPDOs carry, and others, are told apart.
#[test]
fn a_changed_value_finds_its_tpdos() {
    let words: Vec<u32> = (0..40_u32).map(|number| 0x2100_0008 | number << 16).collect();
    let mut device = device(255);
    for number in 0..40 {
        device = device.u8(0x2100 + number, 0, RW.and(crate::Flags::TPDO), 0);
    }
    for (number, mapping) in words.chunks(8).enumerate() {
        device = device.pdo(0x1810 + number as u16, 0x8000_0000, 254, mapping);
    }
    let mut bench = Bench::new(device.build());
    for number in 0..5 {
        set(&mut bench, 0x1810 + number, 1, &(0x300 + u32::from(number)).to_le_bytes());
    }
    bench.nmt(1);
    for number in 0..40_u16 {
        let found = bench.node.objects().table().find(Index(0x2100 + number), SubIndex(0)).unwrap();
        bench.node.services(bench.now).changed(found);
        let sent: Vec<u32> = bench.poll().iter().map(|frame| frame.can_id().raw()).collect();
        assert_eq!(sent, [0x300 + u32::from(number) / 8]);
    }
    bench.node.services(Instant(0)).changed(Position(0));
    assert_eq!(bench.poll(), []);
}
