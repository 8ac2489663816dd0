use super::*;
use edskit_runtime::Frame;
use edskit_types::CanId;

// GW-EDS-02
#[test]
fn frames_with_29_bits_are_not_for_it() {
    let mut bench = Bench::started(&governor(&[(827, 1), (4827, 3)]));
    for (can_id, data) in
        [(0x000_u32, &[2, 0][..]), (0x601, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]), (0x201, &[1, 0])]
    {
        let frame = Frame::new(CanId::extended(can_id).unwrap(), data);
        assert_eq!(bench.hand(&frame), []);
    }
    bench.pass(DC);
    assert_eq!(bench.gateway.state(), State::Operational);
    let sent = bench.pass(1_000_000);
    assert!(sent.iter().all(|(_, frame)| !frame.can_id().is_extended()));
}

// GW-GAP-07, GW-HB-01
#[test]
fn remote_frames_are_ignored() {
    let mut bench = Bench::started(&[governor(&[(14401, 1)]), gateway(&[(429, 60_000)])].concat());
    bench.pass(100_000);
    for can_id in 0..0x800 {
        let frame = Frame::remote(CanId::standard(can_id).unwrap(), 8);
        assert_eq!(bench.hand(&frame), [], "{can_id:03X}h");
    }
    assert_eq!(bench.gateway.state(), State::Operational);
}

// GW-EDS-05
#[test]
fn lss_is_not_there() {
    let mut bench = Bench::new(&[]);
    for request in [[4, 1, 0, 0, 0, 0, 0, 0], [94, 0, 0, 0, 0, 0, 0, 0], [81, 0, 0, 0, 0, 0x80, 0, 0]] {
        assert_eq!(bench.ask(0x7E5, &request), []);
    }
}

// GW-OD-21, GW-HB-01
#[test]
fn neither_emcy_nor_sync_nor_time() {
    let mut bench = Bench::started(&[governor(&[(14401, 1)]), gateway(&[(428, 9), (430, 100)])].concat());
    bench.pass(1_000_000);
    assert_eq!(bench.ask(0x080, &[]), []);
    assert_eq!(bench.ask(0x100, &[0; 6]), []);
    let now = bench.now;
    bench.gateway.set_supply(now, 5_000);
    bench.gateway.inject(now, Fault::ReceiveBuffer2);
    let sent = bench.pass(1_000_000);
    assert!(sent.iter().all(|(_, frame)| frame.can_id().raw() != 0x081), "errors make no EMCY");
}

// GW-APP-02
#[test]
fn what_is_not_for_the_gateway_goes_nowhere() {
    let mut bench = Bench::started(&[]);
    let before = bench.gateway.all_errors();
    for can_id in (0x001..0x800).filter(|can_id| *can_id != 0x601) {
        assert_eq!(bench.ask(can_id, &[0xFF; 8]), [], "{can_id:03X}h");
    }
    bench.pass(1_000_000);
    assert_eq!((bench.gateway.all_errors(), bench.gateway.state()), (before, State::Operational));
}
