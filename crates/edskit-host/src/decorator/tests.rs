use crate::*;
use edskit_runtime::{Frame, Instant, Microseconds};
use edskit_types::{Bitrate, CanId};
use proptest::prelude::*;
use std::io;

fn frame(id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(id).unwrap(), data)
}

/// Sends `count` numbered frames over a bus, one each millisecond, and says which arrive when.
fn through(mut from: impl Bus, mut to: impl Bus, bus: &VirtualBus, count: u8) -> Vec<(u64, u8)> {
    let mut arrived = Vec::new();
    for number in 0..count {
        from.send(&frame(0x181, &[number])).unwrap();
        let next = bus.now() + Microseconds(1_000);
        while bus.now() < next {
            to.wait(next).unwrap();
            from.receive().unwrap();
            arrived.extend(std::iter::from_fn(|| to.receive().unwrap()));
        }
    }
    arrived.iter().map(|received| (received.time.0, received.frame.data()[0])).collect()
}

fn pair() -> (VirtualBus, Participant, Participant) {
    let bus = VirtualBus::new(Bitrate::Kbit1000);
    let (a, b) = (bus.attach(), bus.attach());
    (bus, a, b)
}

#[test]
fn loss_takes_its_share_and_the_same_each_time() {
    let run = |probability, seed, on_sending: bool| {
        let (bus, a, b) = pair();
        if on_sending {
            through(Loss::new(a, probability, seed), b, &bus, 200)
        } else {
            through(a, Loss::new(b, probability, seed), &bus, 200)
        }
    };
    assert_eq!(run(0.0, 1, false).len(), 200);
    assert_eq!(run(1.0, 1, false).len(), 0);
    assert!((60..140).contains(&run(0.5, 1, false).len()));
    assert_eq!(run(0.5, 7, false), run(0.5, 7, false));
    assert_ne!(run(0.5, 7, true), run(0.5, 8, true));
}

#[test]
fn duplication_gives_the_same_frame_twice() {
    let (bus, a, b) = pair();
    let arrived = through(a, Duplication::new(b, 1.0, 1), &bus, 3);
    assert_eq!(arrived.iter().map(|(_, number)| *number).collect::<Vec<_>>(), [0, 0, 1, 1, 2, 2]);
    let (bus, a, b) = pair();
    let arrived = through(Duplication::new(a, 1.0, 1), b, &bus, 2);
    assert_eq!(arrived.iter().map(|(_, number)| *number).collect::<Vec<_>>(), [0, 0, 1, 1]);
    assert!(arrived[0].0 < arrived[1].0);
}

#[test]
fn a_fixed_delay_shifts_the_arrival() {
    let (bus, a, b) = pair();
    let undelayed = through(a, b, &bus, 10);
    let (bus, a, b) = pair();
    let delayed = through(a, Delay::new(b, Microseconds(300), Microseconds(0), 1), &bus, 10);
    let shifted: Vec<(u64, u8)> = undelayed.iter().map(|(time, number)| (time + 300, *number)).collect();
    assert_eq!(delayed, shifted);
}

#[test]
fn jitter_keeps_the_order() {
    let (bus, a, b) = pair();
    let arrived = through(a, Delay::new(b, Microseconds(0), Microseconds(5_000), 3), &bus, 100);
    assert!(arrived.len() > 90);
    assert!(arrived.windows(2).all(|pair| pair[0].1 + 1 == pair[1].1 && pair[0].0 <= pair[1].0));
}

#[test]
fn a_frame_that_is_sent_late_leaves_while_the_sender_waits() {
    let (bus, a, mut b) = pair();
    let mut late = Delay::new(a, Microseconds(2_000), Microseconds(0), 1);
    late.send(&frame(1, &[])).unwrap();
    late.wait(Instant(10_000)).unwrap();
    assert_eq!(bus.now(), Instant(2_000));
    b.wait(Instant(10_000)).unwrap();
    assert!(b.receive().unwrap().is_some_and(|received| received.time > Instant(2_000)));
}

#[test]
fn who_is_bus_off_neither_sends_nor_receives() {
    let (bus, a, mut b) = pair();
    let mut a = BusOff::new(a);
    let switch = a.switch();
    switch.set(true);
    assert!(switch.is_off());
    assert!(matches!(a.send(&frame(1, &[])), Err(SendError::BusOff)));
    b.send(&frame(2, &[])).unwrap();
    bus.advance(Instant(1_000));
    assert_eq!(a.receive().unwrap(), None);
    switch.set(false);
    b.send(&frame(3, &[])).unwrap();
    bus.advance(Instant(2_000));
    assert_eq!(a.receive().unwrap().map(|received| received.frame), Some(frame(3, &[])));
    a.send(&frame(1, &[])).unwrap();
}

const TIME: Instant = Instant(1_700_000_000_123_456);

#[test]
fn candump_lines() {
    let mut log = Vec::new();
    let mut candump = Candump::new(&mut log, "my bus");
    for frame in [
        frame(0x601, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]),
        frame(0x80, &[]),
        Frame::new(CanId::extended(0x80).unwrap(), &[0xAB]),
        Frame::remote(CanId::standard(0x701).unwrap(), 1),
        Frame::remote(CanId::standard(0x701).unwrap(), 0),
    ] {
        candump.record(TIME, &frame).unwrap();
    }
    let expected = "\
(1700000000.123456) my_bus 601#4000100000000000
(1700000000.123456) my_bus 080#
(1700000000.123456) my_bus 00000080#AB
(1700000000.123456) my_bus 701#R1
(1700000000.123456) my_bus 701#R
";
    assert_eq!(String::from_utf8(log).unwrap(), expected);
}

#[test]
fn pcap_bytes() {
    let mut file = Vec::new();
    let mut pcap = Pcap::new(&mut file).unwrap();
    pcap.record(TIME, &Frame::new(CanId::extended(0x1234_5678).unwrap(), &[9, 8])).unwrap();
    pcap.record(Instant(1), &Frame::remote(CanId::standard(0x701).unwrap(), 1)).unwrap();
    #[rustfmt::skip]
    let expected = [
        0xD4, 0xC3, 0xB2, 0xA1, 2, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 0, 0, 227, 0, 0, 0,
        0x00, 0xF1, 0x53, 0x65, 0x40, 0xE2, 1, 0, 10, 0, 0, 0, 10, 0, 0, 0,
        0x92, 0x34, 0x56, 0x78, 2, 0, 0, 0, 9, 8,
        0, 0, 0, 0, 1, 0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0,
        0x40, 0, 0x07, 0x01, 1, 0, 0, 0,
    ];
    assert_eq!(file, expected);
}

/// A disk that is full after some bytes.
struct Small(usize);

impl io::Write for Small {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_trace_that_cannot_be_written_ends_once_and_the_bus_goes_on() {
    let (bus, a, mut b) = pair();
    let mut traced = Trace::new(a, Candump::new(Small(40), "can0"));
    for _ in 0..3 {
        traced.send(&frame(1, &[1])).unwrap();
        b.send(&frame(2, &[2])).unwrap();
        bus.advance(bus.now() + Microseconds(1_000));
        assert!(traced.receive().unwrap().is_some());
    }
    assert!(matches!(traced.event(), Some(Event::TraceEnded(_))));
    assert_eq!(traced.event(), None);
}

proptest! {
    #[test]
    fn any_frame_at_any_time_is_recorded(
        id in 0u32..0x2000_0000, is_extended: bool, is_remote: bool, time: u64,
        data in proptest::collection::vec(any::<u8>(), 0..=8),
    ) {
        let id = if is_extended { CanId::extended(id) } else { CanId::standard((id & 0x7FF) as u16) }.unwrap();
        let frame = if is_remote { Frame::remote(id, data.len() as u8) } else { Frame::new(id, &data) };
        let (mut log, mut file) = (Vec::new(), Vec::new());
        Candump::new(&mut log, "can0").record(Instant(time), &frame).unwrap();
        Pcap::new(&mut file).unwrap().record(Instant(time), &frame).unwrap();
        prop_assert!(log.ends_with(b"\n"));
        prop_assert_eq!(file.len(), 24 + 16 + 8 + frame.data().len());
    }
}
