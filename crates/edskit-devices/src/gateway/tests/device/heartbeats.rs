use super::*;

// GW-HB-02, GW-HB-03, GW-TIMING-12, GW-TIMING-14, GW-NOTE-06
#[test]
fn the_own_heartbeat_in_steps_of_16_ms() {
    for (setting, cycle) in [(1, GW), (15, GW), (31, GW), (32, 2 * GW), (100, 96_000), (1000, 992_000)] {
        let mut bench = Bench::new(&gateway(&[(429, setting)]));
        let times = bench.times_of(0x701, 5 * cycle);
        assert_eq!(times, [1, 2, 3, 4, 5].map(|nth| nth * cycle), "{setting} ms");
    }
}

// GW-HB-03, GW-HB-01
#[test]
fn without_a_cycle_none_is_sent_and_nobody_can_ask_for_one() {
    let mut bench = Bench::new(&[]);
    assert_eq!(bench.times_of(0x701, 100_000_000), []);
    let can_id = edskit_types::CanId::standard(0x701).unwrap();
    assert_eq!(bench.hand(&edskit_runtime::Frame::remote(can_id, 1)), [], "there is no node guarding");
}

// GW-TIMING-13
#[test]
fn the_longest_cycle() {
    let mut bench = Bench::new(&gateway(&[(429, 65_535)]));
    assert_eq!(bench.times_of(0x701, 140_000_000), [65_520_000, 131_040_000]);
}

// GW-HB-04, GW-HB-05, GW-TIMING-12, GW-TIMING-14, GW-APP-24, GW-NOTE-26, GW-NOTE-27
#[test]
fn the_partners_heartbeat_is_monitored_in_operational() {
    let settings = gateway(&[(428, 127), (429, 1000), (430, 100)]);
    let mut bench = Bench::new(&settings);
    let missing = |bench: &Bench| bench.gateway.can_open_errors().contains(CanOpenError::Heartbeat);
    bench.pass(10_000_000);
    assert!(!missing(&bench), "not in pre-operational");
    // The next main cycle of the gateway is at a multiple of 16 ms behind its start at 200 ms.
    bench.pass(GW - (bench.now.0 - 200_000) % GW);
    bench.nmt(1);
    bench.pass(6 * GW - 1);
    assert!(!missing(&bench));
    bench.pass(1);
    assert!(missing(&bench), "96 ms, to the microsecond, though no heartbeat has ever come");
    assert_eq!((bench.gateway.state(), bench.gateway.measured(12420)), (State::Operational, Some(1)));
    for time in [90_000_u64; 20] {
        bench.ask(0x77F, &[5]);
        bench.pass(GW);
        assert!(!missing(&bench), "it clears itself");
        bench.pass(time - GW);
    }
    bench.pass(100_000);
    assert_eq!(
        (missing(&bench), bench.gateway.state()),
        (true, State::Operational),
        "100 ms are too many for 96"
    );
    bench.nmt(128);
    bench.pass(GW);
    assert!(!missing(&bench));
}

// GW-HB-07
#[test]
fn only_heartbeats_of_the_partner_count() {
    let mut bench = Bench::started(&gateway(&[(428, 9), (430, 100)]));
    let missing = |bench: &Bench| bench.gateway.can_open_errors().contains(CanOpenError::Heartbeat);
    let mut alive_after = |can_id: u16, data: &[u8]| {
        bench.pass(1_000_000);
        assert_eq!((missing(&bench), bench.gateway.state()), (true, State::Operational));
        bench.ask(can_id, data);
        bench.pass(GW);
        !missing(&bench)
    };
    for code in [0x00, 0x04, 0x05, 0x7F] {
        assert!(alive_after(0x709, &[code]), "{code:02X}h");
    }
    assert!(!alive_after(0x70A, &[5]) && !alive_after(0x709, &[1]) && !alive_after(0x709, &[]));
    assert!(!alive_after(0x709, &[5, 5]));
}

// GW-HB-04
#[test]
fn without_a_time_or_a_partner_nobody_is_monitored() {
    for settings in [gateway(&[(428, 9)]), gateway(&[(428, 9), (430, 0)])] {
        let mut bench = Bench::started(&settings);
        bench.pass(100_000_000);
        assert!(bench.gateway.can_open_errors().is_empty());
    }
}
