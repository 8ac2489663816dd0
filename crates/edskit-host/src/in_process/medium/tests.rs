use super::*;
use edskit_runtime::Microseconds;
use edskit_types::CanId;

fn frame(id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(id).unwrap(), data)
}

fn all(participant: &mut Participant) -> Vec<(u64, Frame)> {
    std::iter::from_fn(|| participant.receive().unwrap()).map(|got| (got.time.0, got.frame)).collect()
}

#[test]
fn a_frame_takes_its_bits_and_the_sender_does_not_hear_it() {
    let bus = VirtualBus::new(Bitrate::Kbit125);
    let (mut a, mut b, mut c) = (bus.attach(), bus.attach(), bus.attach());
    a.send(&frame(0, &[])).unwrap();
    // 53 bits, 3 of them intermission, 8 us each.
    assert_eq!(bus.next_event(), Instant(400));
    bus.advance(Instant(399));
    assert_eq!(all(&mut b), []);
    bus.advance(Instant(400));
    assert_eq!(all(&mut b), [(400, frame(0, &[]))]);
    assert_eq!(all(&mut c), [(400, frame(0, &[]))]);
    assert_eq!(all(&mut a), []);
    assert_eq!(bus.next_event(), Instant::NEVER);
}

#[test]
fn what_waits_at_the_same_time_goes_by_identifier() {
    let bus = VirtualBus::new(Bitrate::Kbit1000);
    let (mut a, mut b, mut listener) = (bus.attach(), bus.attach(), bus.attach());
    for id in [0x701, 0x581, 0x581] {
        a.send(&frame(id, &[id as u8])).unwrap();
    }
    b.send(&frame(0x80, &[])).unwrap();
    b.send(&Frame::remote(CanId::standard(0x581).unwrap(), 0)).unwrap();
    bus.advance(Instant(10_000));
    let ids: Vec<u32> = all(&mut listener).iter().map(|(_, frame)| frame.can_id().raw()).collect();
    assert_eq!(ids, [0x80, 0x581, 0x581, 0x581, 0x701]);
    assert_eq!(all(&mut a).iter().map(|(_, frame)| frame.is_remote()).collect::<Vec<_>>(), [false, true]);
}

#[test]
fn a_frame_under_way_is_not_interrupted() {
    let bus = VirtualBus::new(Bitrate::Kbit1000);
    let (mut a, mut b, mut listener) = (bus.attach(), bus.attach(), bus.attach());
    a.send(&frame(0x7FF, &[])).unwrap();
    bus.advance(Instant(1));
    b.send(&frame(0x000, &[])).unwrap();
    let first = u64::from(frame_bits(&frame(0x7FF, &[])));
    bus.advance(Instant(1_000));
    let expected = [(first - 3, frame(0x7FF, &[])), (first + 50, frame(0, &[]))];
    assert_eq!(all(&mut listener), expected);
}

#[test]
fn at_800_kbit_per_s_bits_are_no_whole_microseconds() {
    let bus = VirtualBus::new(Bitrate::Kbit800);
    let (mut a, mut b) = (bus.attach(), bus.attach());
    for _ in 0..2 {
        a.send(&frame(0, &[])).unwrap();
    }
    bus.advance(Instant(1_000));
    // 50 bits of 1.25 us, then 103.
    assert_eq!(all(&mut b).iter().map(|(time, _)| *time).collect::<Vec<_>>(), [63, 129]);
}

#[test]
fn a_participant_that_waits_moves_the_time() {
    let bus = VirtualBus::new(Bitrate::Kbit1000);
    let (mut a, mut b) = (bus.attach(), bus.attach());
    a.send(&frame(5, &[1])).unwrap();
    b.wait(Instant::NEVER).unwrap();
    let now = bus.now();
    assert!(now > Instant(40) && b.receive().unwrap().is_some());
    b.wait(now + Microseconds(7)).unwrap();
    assert_eq!(bus.now(), now + Microseconds(7));
    // Nothing is under way, so there is nothing to wait for.
    b.wait(Instant::NEVER).unwrap();
    assert_eq!(bus.now(), now + Microseconds(7));
}

#[test]
fn the_transmit_side_is_bounded_and_so_is_the_receive_side() {
    let bus = VirtualBus::new(Bitrate::Kbit1000);
    let (mut a, mut b) = (bus.attach(), bus.attach());
    let taken = (0..100).filter(|_| a.send(&frame(1, &[])).is_ok()).count();
    assert_eq!(taken, MOST_PENDING);
    for _ in 0..2 * MOST_UNTAKEN {
        bus.step(Instant::NEVER);
        a.send(&frame(1, &[])).unwrap();
    }
    assert_eq!(all(&mut b).len(), MOST_UNTAKEN);
    assert_eq!(b.event(), Some(Event::FramesLost(MOST_UNTAKEN as u64)));
    assert_eq!(b.event(), None);
}

#[test]
fn the_end_of_time_is_survived() {
    let bus = VirtualBus::new(Bitrate::Kbit10);
    let (mut a, mut b) = (bus.attach(), bus.attach());
    a.send(&frame(1, &[])).unwrap();
    bus.advance(Instant::NEVER);
    assert_eq!(all(&mut b).len(), 1);
    a.send(&frame(2, &[])).unwrap();
    bus.advance(Instant::NEVER);
    b.wait(Instant::NEVER).unwrap();
    assert_eq!(bus.now(), Instant::NEVER);
}

#[test]
fn who_leaves_receives_nothing_and_what_it_sent_arrives() {
    let bus = VirtualBus::new(Bitrate::Kbit1000);
    let (mut a, mut b) = (bus.attach(), bus.attach());
    a.send(&frame(1, &[])).unwrap();
    drop(a);
    b.send(&frame(2, &[])).unwrap();
    bus.advance(Instant(1_000));
    assert_eq!(all(&mut b).len(), 1);
    assert_eq!(bus.next_event(), Instant::NEVER);
}
