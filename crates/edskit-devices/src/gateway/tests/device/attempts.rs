use super::*;
use edskit_runtime::Frame;

fn fault(bench: &mut Bench, is_present: bool) {
    let now = bench.now;
    match is_present {
        true => bench.gateway.inject(now, Fault::GatewayCanBus2),
        false => bench.gateway.remove(now, Fault::GatewayCanBus2),
    }
}

/// When something was sent, all frames being the same.
fn times(sent: &[(u64, Frame)], expected: &Frame) -> Vec<u64> {
    assert!(sent.iter().all(|(_, frame)| frame == expected), "{sent:?}");
    sent.iter().map(|(time, _)| *time).collect()
}

/// Settings, and what an attempt sends with them.
type Attempt = (Vec<(Owner, u16, i32)>, Frame);

/// Several cycles of the heartbeat.
fn cycles() -> [Attempt; 4] {
    let heartbeat = frame(0x701, &[0x7F]);
    [
        (gateway(&[(429, 0)]), frame(0x701, &[0])),
        (gateway(&[(429, 100)]), heartbeat),
        (gateway(&[(429, 1_000)]), heartbeat),
        (gateway(&[(429, 65_535)]), heartbeat),
    ]
}

// GW-APP-45, GW-APP-27, GW-APP-37
#[test]
fn a_bus_that_is_faulty_at_the_start_is_tried_from_the_start_on() {
    for (settings, expected) in cycles() {
        let mut bench = Bench::off(&settings);
        fault(&mut bench, true);
        let sent = bench.pass(200_000 + 2_600_000);
        assert_eq!(times(&sent, &expected), [700_000, 1_200_000, 1_700_000, 2_200_000, 2_700_000]);
        assert_eq!(bench.gateway.state(), State::PreOperational, "the governor has initialised it");
        let errors: Vec<_> = bench.gateway.can_open_errors().iter().collect();
        assert_eq!(errors, [CanOpenError::GatewayCanBus2], "shown from the start on");
    }
}

// GW-APP-45, GW-APP-46
#[test]
fn the_first_attempt_on_a_mended_bus_is_on_the_wire() {
    for (settings, expected) in cycles() {
        let mut bench = Bench::off(&settings);
        fault(&mut bench, true);
        bench.pass(3_000_000);
        fault(&mut bench, false);
        assert_eq!(bench.gateway.measured(12405), Some(0), "it does not know yet");
        assert_eq!(bench.nmt(1), []);
        assert_eq!(bench.gateway.state(), State::PreOperational);
        let sent = bench.pass(200_000);
        assert_eq!(sent, [(200_000, expected)], "at 3.2 s, half a second after the last one");
        assert_eq!(bench.gateway.measured(12405), Some(1));
        bench.nmt(1);
        assert_eq!(bench.gateway.state(), State::Operational);
        assert!(bench.gateway.errors().next().is_none());
        let later = bench.pass(300_000);
        assert!(later.iter().all(|(_, frame)| frame.data() != [0]), "no second boot-up: {later:?}");
    }
}

// GW-APP-45
#[test]
fn any_order_of_fault_and_supply() {
    let boot_up = frame(0x701, &[0]);
    // The gateway is off, the fault comes, the gateway is on.
    let mut bench = Bench::new(&[]);
    let now = bench.now;
    bench.gateway.switch_off(now, Owner::Gateway);
    fault(&mut bench, true);
    assert_eq!(bench.pass(2_000_000), []);
    let now = bench.now;
    bench.gateway.switch_on(now, Owner::Gateway);
    assert_eq!(times(&bench.pass(1_300_000), &boot_up), [700_000, 1_200_000]);
    // A reset during the fault: the attempts begin anew with the program, and those of the last one are over.
    bench.pass(100_000);
    let now = bench.now;
    bench.gateway.reset(now, Owner::Gateway);
    assert_eq!(times(&bench.pass(1_300_000), &boot_up), [700_000, 1_200_000]);
    // A reset of the governor: the program of the gateway goes on, and so do its attempts.
    let now = bench.now;
    bench.gateway.reset(now, Owner::Governor);
    assert_eq!(times(&bench.pass(1_000_000), &boot_up), [400_000, 900_000]);
    // It comes again before the next attempt, so that the gateway never learns that it was gone.
    fault(&mut bench, false);
    bench.pass(100_000);
    fault(&mut bench, true);
    assert_eq!(times(&bench.pass(1_000_000), &boot_up), [300_000, 800_000]);
    // It goes while the gateway is off.
    let now = bench.now;
    bench.gateway.switch_off(now, Owner::Gateway);
    fault(&mut bench, false);
    bench.pass(1_000_000);
    let now = bench.now;
    bench.gateway.switch_on(now, Owner::Gateway);
    let times = times(&bench.pass(2_000_000), &boot_up);
    assert!(matches!(times[..], [200_000..250_000]), "one boot-up, and no attempt: {times:?}");
}

// GW-APP-45, GW-APP-46
#[test]
fn a_fault_that_goes_while_the_gateway_starts() {
    for (gone, expected) in [(100_000, 231_250), (210_000, 700_000), (231_250, 700_000)] {
        let mut bench = Bench::off(&[]);
        fault(&mut bench, true);
        assert_eq!(bench.pass(gone), []);
        fault(&mut bench, false);
        let sent = bench.pass(3_000_000);
        assert_eq!(times(&sent, &frame(0x701, &[0])), [expected - gone], "gone after {gone} µs");
    }
}

// GW-APP-45
#[test]
fn without_the_governor_nothing_is_sent() {
    let mut bench = Bench::off(&governor(&[(4406, 0)]));
    fault(&mut bench, true);
    assert_eq!(bench.pass(5_000_000), [], "the state is undefined");
    fault(&mut bench, false);
    assert_eq!(bench.pass(5_000_000), []);
}

// GW-APP-45, GW-APP-27
#[test]
fn a_reset_by_the_governor_on_a_faulty_bus() {
    let mut bench = Bench::started(&[]);
    fault(&mut bench, true);
    bench.pass(490_000);
    // The initialisation runs while an attempt is due, and the boot-up message of its end is lost.
    let now = bench.now;
    assert!(bench.gateway.command(now, State::Init));
    let sent = bench.pass(1_100_000);
    assert_eq!(times(&sent, &frame(0x701, &[0])), [510_000, 1_010_000]);
}
