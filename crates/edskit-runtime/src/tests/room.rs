//! More of something than there is room for: frames, errors, messages.

use super::device::{Builder, COB_ID, RO, RW, with_values};
use super::{Bench, frame};
use crate::{EmcyError, Flags, Frame};
use edskit_types::{CanId, Index, SubIndex};
use std::vec::Vec;

const OVERRUN: [u8; 8] = [0x10, 0x81, 0x11, 0, 0, 0, 0, 0];

fn device() -> Builder {
    let device = with_values()
        .u8(0x1003, 0, RW, 0)
        .u32(0x1003, 1, RO, 0)
        .u32(0x1005, 0, RW, 0x80)
        .u32(0x1006, 0, RW, 0)
        .u32(0x1007, 0, RW, 0)
        .u16(0x100C, 0, RW, 0)
        .u8(0x100D, 0, RW, 0)
        .u32(0x1014, 0, COB_ID, 0x80)
        .u16(0x1015, 0, RW, 0)
        .u8(0x1016, 0, Flags::READ, 40);
    (1..=40).fold(device, |device, sub_index| device.u32(0x1016, sub_index, RW, 0))
}

/// So many TPDOs of this type, from identifier 201h on.
fn with_tpdos(count: u16, transmission: u8) -> Bench {
    let tpdo = |device: Builder, number: u16| {
        device.pdo(0x1800 + number, 0x200 + u32::from(number), transmission, &[0x2000_0010])
    };
    let mut bench = Bench::new((0..count).fold(device(), tpdo).build());
    bench.nmt(1);
    bench.pass(0);
    bench
}

/// What is sent when the bus takes a few frames at a time.
fn drained(bench: &mut Bench, at_a_time: usize) -> Vec<Frame> {
    let mut sent = Vec::new();
    loop {
        bench.node.poll(bench.now, &mut *bench.app);
        let taken: Vec<Frame> = core::iter::from_fn(|| bench.node.transmit()).take(at_a_time).collect();
        if taken.is_empty() {
            return sent;
        }
        sent.extend(taken);
    }
}

fn identifiers(sent: &[Frame]) -> Vec<u32> {
    sent.iter().map(|frame| frame.can_id().raw()).collect()
}

// W6

#[cfg(feature = "sync")]
#[test]
fn every_synchronous_tpdo_follows_its_sync_once() {
    for count in [24, 40, 100] {
        for transmission in [1, 0] {
            let mut bench = with_tpdos(count, transmission);
            for round in 0..3 {
                if transmission == 0 {
                    (1..=count).for_each(|number| bench.node.services(bench.now).trigger(number));
                }
                bench.node.receive(bench.now, &frame(0x80, &[]), &mut *bench.app);
                let expected: Vec<u32> = (0..count).map(|number| 0x205 + u32::from(number)).collect();
                assert_eq!(identifiers(&drained(&mut bench, 3)), expected, "type {transmission}, {round}");
            }
        }
    }
}

#[test]
fn what_waits_for_room_has_the_values_of_its_sync() {
    let mut bench = with_tpdos(24, 1);
    bench.node.receive(bench.now, &frame(0x80, &[]), &mut *bench.app);
    bench.node.objects().set_value(Index(0x2000), 0, 0_u16);
    assert!(drained(&mut bench, 5).iter().all(|frame| frame.data() == [0x34, 0x12]));
}

#[cfg(feature = "sync")]
#[test]
fn what_is_not_sent_in_its_period_is_lost_and_told() {
    let mut bench = with_tpdos(24, 1);
    bench.node.receive(bench.now, &frame(0x80, &[]), &mut *bench.app);
    bench.node.receive(bench.now, &frame(0x80, &[]), &mut *bench.app);
    let sent = drained(&mut bench, 16);
    // Sixteen of the first period, told that eight were lost, all of the second one.
    assert_eq!(sent.iter().filter(|frame| frame.can_id().raw() >= 0x205).count(), 16 + 24);
    assert!(sent.contains(&frame(0x85, &OVERRUN)));
    assert_eq!(bench.read(0x1001, 0), Ok([0].into()));
    // Every second SYNC: nothing moves to one that is not its own.
    let mut bench = with_tpdos(24, 2);
    for _ in 0..3 {
        bench.node.receive(bench.now, &frame(0x80, &[]), &mut *bench.app);
    }
    let sent = drained(&mut bench, 16);
    assert_eq!(sent.iter().filter(|frame| frame.can_id().raw() >= 0x205).count(), 16);
    assert!(sent.contains(&frame(0x85, &OVERRUN)));
    // The period of what is synchronous ends with the window.
    let mut bench = with_tpdos(24, 1);
    bench.write(0x1007, 0, &[0xE8, 3, 0, 0]).unwrap();
    bench.node.receive(bench.now, &frame(0x80, &[]), &mut *bench.app);
    assert_eq!(bench.sent().len(), 16);
    bench.now.0 += 2_000;
    assert_eq!(bench.poll(), []);
    assert_eq!(bench.poll(), [frame(0x85, &OVERRUN)]);
}

#[cfg(all(feature = "rtr", feature = "sync"))]
#[test]
fn no_event_and_no_request_starves() {
    let mut bench = with_tpdos(40, 255);
    let mut counts = [0; 40];
    for _ in 0..20 {
        (1..=40).for_each(|number| bench.node.services(bench.now).trigger(number));
        bench.node.poll(bench.now, &mut *bench.app);
        // The bus takes ten frames until every value has changed again.
        for sent in core::iter::from_fn(|| bench.node.transmit()).take(10) {
            counts[sent.can_id().raw() as usize - 0x205] += 1;
        }
    }
    assert!(counts.iter().all(|count| (4..=6).contains(count)), "{counts:?}");

    for transmission in [253, 252, 255, 1] {
        let mut bench = with_tpdos(20, transmission);
        bench.ask(0x80, &[]);
        for number in 0..20 {
            let request = Frame::remote(CanId::standard(0x205 + number).unwrap(), 2);
            bench.node.receive(bench.now, &request, &mut *bench.app);
        }
        let mut asked = identifiers(&drained(&mut bench, 4));
        asked.sort_unstable();
        assert_eq!(asked, (0x205..0x205 + 20).collect::<Vec<u32>>(), "type {transmission}");
    }
}

/// Fills the queue with TPDOs that wait for the bus.
fn full() -> Bench {
    let mut bench = with_tpdos(16, 255);
    (1..=16).for_each(|number| bench.node.services(bench.now).trigger(number));
    bench.node.poll(bench.now, &mut *bench.app);
    bench
}

#[cfg(feature = "sync")]
#[test]
fn other_services_wait_for_room_too() {
    let mut bench = full();
    let request = frame(0x605, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]);
    bench.node.receive(bench.now, &request, &mut *bench.app);
    assert_eq!(drained(&mut bench, 16).last(), Some(&frame(0x585, &[0x43, 0, 0x10, 0, 0x91, 1, 1, 0])));

    let mut bench = full();
    let write = frame(0x605, &[0x2B, 0x17, 0x10, 0, 100, 0, 0, 0]);
    bench.node.receive(bench.now, &write, &mut *bench.app);
    bench.node.poll(bench.now, &mut *bench.app);
    assert!(bench.node.next_deadline(bench.now) > bench.now, "nothing keeps the main loop busy");
    let sent = drained(&mut bench, 16);
    assert!(
        sent.contains(&frame(0x705, &[5]))
            && sent.contains(&frame(0x585, &[0x60, 0x17, 0x10, 0, 0, 0, 0, 0]))
    );

    // The device makes itself a producer of SYNC.
    let mut bench = full();
    let mut objects = bench.node.objects();
    objects.set_value(Index(0x1006), 0, 1000_u32);
    objects.set_value(Index(0x1005), 0, 0x4000_0080_u32);
    let position = objects.table().find(Index(0x1005), SubIndex(0)).unwrap();
    bench.node.services(bench.now).update(position);
    bench.node.poll(bench.now, &mut *bench.app);
    bench.now.0 += 1000;
    bench.node.poll(bench.now, &mut *bench.app);
    assert_eq!(identifiers(&drained(&mut bench, 16)).iter().filter(|can_id| **can_id == 0x80).count(), 1);
}

#[cfg(feature = "guarding")]
#[test]
fn an_answer_that_is_not_sent_does_not_toggle() {
    let mut bench = full();
    let request = Frame::remote(CanId::standard(0x705).unwrap(), 1);
    bench.node.receive(bench.now, &request, &mut *bench.app);
    let sent = drained(&mut bench, 16);
    assert!(sent.contains(&frame(0x85, &OVERRUN)) && !identifiers(&sent).contains(&0x705));
    assert_eq!(bench.receive(request), [frame(0x705, &[5])]);
}

// W8

fn monitors(bench: &mut Bench, count: u8) {
    for place in 1..=count {
        bench.write(0x1016, place, &[0x2C, 1, 19 + place, 0]).unwrap();
        bench.ask(0x700 + 19 + u16::from(place), &[5]);
        bench.pass(1);
    }
}

#[cfg(feature = "heartbeat-consumer")]
#[test]
fn any_number_of_errors_is_present() {
    let mut bench = Bench::new(device().build());
    bench.nmt(1);
    monitors(&mut bench, 40);
    let told = bench.pass(400);
    assert_eq!(told.iter().filter(|(_, frame)| frame.data().starts_with(&[0x30, 0x81, 0x11])).count(), 40);
    for node in 20..=59_u16 {
        let register = if node < 59 { 0x11 } else { 0 };
        assert_eq!(bench.ask(0x700 + node, &[5]), [frame(0x85, &[0, 0, register, 0, 0, 0, 0, 0])]);
        assert_eq!(bench.read(0x1001, 0), Ok([register].into()));
    }
}

#[cfg(feature = "heartbeat-consumer")]
#[test]
fn the_device_has_room_for_its_own_errors_whatever_the_services_find() {
    let mut bench = Bench::new(device().build());
    bench.nmt(1);
    monitors(&mut bench, 40);
    bench.pass(400);
    let error = |number: u16| EmcyError { code: 0x4200 + number, register: 8 };
    for number in 0..32 {
        bench.node.services(bench.now).raise(error(number), number, [0; 5]);
        bench.node.services(bench.now).raise(error(number), number, [0; 5]);
    }
    drained(&mut bench, 16);
    assert_eq!(bench.read(0x1001, 0), Ok([0x19].into()));
    (20..60).for_each(|node| drop(bench.ask(0x700 + node, &[5])));
    assert_eq!(bench.read(0x1001, 0), Ok([0x09].into()));
    for number in (0..32).rev() {
        assert_eq!(bench.read(0x1001, 0), Ok([0x09].into()));
        bench.node.services(bench.now).clear(error(number), number);
    }
    assert_eq!(bench.read(0x1001, 0), Ok([0].into()));
}

// W9

#[test]
fn the_last_message_tells_what_is() {
    for rounds in [1, 3, 5, 10] {
        for ends_present in [false, true] {
            let device = device().pdo(0x1400, 0x200, 255, &[0x2000_0010]).build();
            let mut bench = Bench::new(device);
            bench.write(0x1015, 0, &1000_u16.to_le_bytes()).unwrap();
            bench.nmt(1);
            let mut told = Vec::new();
            for _ in 0..rounds {
                told.extend(bench.ask(0x205, &[1]));
                told.extend(bench.ask(0x205, &[1, 2]));
            }
            if ends_present {
                told.extend(bench.ask(0x205, &[1]));
            }
            told.extend(bench.pass(3000).into_iter().map(|(_, frame)| frame));
            let register = bench.read(0x1001, 0).unwrap()[0];
            assert_eq!(register, if ends_present { 0x11 } else { 0 });
            let last = told.last().unwrap().data();
            assert_eq!((last[2], last[0] != 0), (register, ends_present), "{rounds} rounds");
        }
    }
}

#[test]
fn what_happens_while_there_is_no_emcy_is_told_when_there_is_one() {
    let hot = EmcyError { code: 0x4210, register: 8 };
    for (raises, register) in [(1, 9), (2, 0)] {
        let mut bench = Bench::new(device().build());
        bench.write(0x1014, 0, &[0x85, 0, 0, 0x80]).unwrap();
        bench.node.services(bench.now).raise(hot, 0, [0; 5]);
        if raises == 2 {
            bench.node.services(bench.now).clear(hot, 0);
        }
        assert_eq!(bench.pass(100), []);
        let sent = bench.ask(0x605, &[0x23, 0x14, 0x10, 0, 0x99, 0, 0, 0]);
        let told: Vec<&Frame> = sent.iter().filter(|frame| frame.can_id().raw() == 0x99).collect();
        assert!(matches!(told[..], [frame] if frame.data()[2] == register), "{sent:?}");
    }
}

#[test]
fn the_inhibit_time_of_emcy_follows_its_parameter() {
    let hot = EmcyError { code: 0x4210, register: 8 };
    for (time, expected) in [(0_u16, 0), (1000, 50_000), (5000, 450_000)] {
        let mut bench = Bench::new(device().build());
        bench.write(0x1015, 0, &30_000_u16.to_le_bytes()).unwrap();
        bench.node.services(bench.now).raise(hot, 0, [0; 5]);
        bench.node.services(bench.now).clear(hot, 0);
        assert_eq!(bench.poll().len(), 1);
        bench.pass(50);
        let request = [0x2B, 0x15, 0x10, 0, time.to_le_bytes()[0], time.to_le_bytes()[1], 0, 0];
        let at_once = bench.ask(0x605, &request).contains(&frame(0x85, &[0; 8]));
        assert_eq!(at_once, expected == 0);
        let later = bench.pass(3000);
        assert_eq!(later.first().map(|(time, _)| *time), (!at_once).then_some(expected), "{time}");
    }
}
