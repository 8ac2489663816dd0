use super::*;

// GW-CFG-32, GW-CFG-33, GW-CFG-34, GW-CFG-44, GW-CFG-45, GW-APP-39, GW-APP-38
#[test]
fn the_units_must_know_each_other() {
    for (settings, is_silent) in [
        (
            both(&[(400, 1000), (401, 1), (402, 1), (416, 250), (4400, 1)], &[(401, 1), (403, 1), (4406, 1)]),
            false,
        ),
        (both(&[(401, 2)], &[(403, 2)]), false),
        (both(&[(402, 31)], &[(401, 31)]), false),
        (both(&[(401, 2)], &[]), true),
        (both(&[(402, 2)], &[]), true),
        (both(&[], &[(4406, 0)]), true),
    ] {
        let mut bench = Bench::off(&settings);
        bench.pass(5_000_000);
        let silent: Vec<_> = bench.gateway.errors().collect();
        let expected =
            if is_silent { [GatewayError::CanComm1, GatewayError::CanOpen].to_vec() } else { [].into() };
        assert_eq!(silent, expected, "{settings:?}");
        assert_eq!(
            [2403, 2405].map(|number| bench.gateway.measured(number)),
            [Some(u32::from(is_silent)), Some(u32::from(!is_silent))]
        );
        let state = if is_silent { State::Undefined } else { State::PreOperational };
        assert_eq!(bench.gateway.state(), state);
    }
    let mut bench = Bench::off(&gateway(&[(4400, 0)]));
    bench.pass(5_000_000);
    assert!(
        !bench.gateway.errors().any(|error| error == GatewayError::CanComm1),
        "not switched on, not missed"
    );
    assert_eq!(bench.gateway.state(), State::Undefined);
}

/// What is shown where the bit rates of the two units are different.
fn clashes(bench: &Bench) -> bool {
    let errors: Vec<_> = bench.gateway.errors().collect();
    let can_open: Vec<_> = bench.gateway.can_open_errors().iter().collect();
    let is_shown = errors.contains(&GatewayError::CanBus1)
        && errors.contains(&GatewayError::CanOpen)
        && can_open.contains(&CanOpenError::GatewayCanBus1)
        && can_open.contains(&CanOpenError::GovernorCanBus);
    let [bus, open, of_governor, of_gateway] =
        [3070, 3074, 12414, 12421].map(|number| bench.gateway.measured(number) == Some(1));
    assert_eq!([bus, open, of_governor, of_gateway], [is_shown; 4]);
    is_shown
}

// GW-CFG-46, GW-APP-50, GW-NOTE-37, GW-NOTE-48
#[test]
fn the_units_must_have_one_bit_rate() {
    let manual: &[(u16, i32)] = &[(4416, 1), (410, 3)];
    for (of_gateway, of_governor, is_different) in [
        (&[(416, 500)][..], &[(416, 250)][..], true),
        (&[(416, 500)], &[], true),
        (&[], &[(416, 125)], true),
        (&[], &[(409, 1000)], true),
        (&[(416, 500)], &[(409, 500)], false),
        (&[(416, 500)], &[(416, 500)], false),
        (&[], &[(409, 250)], false),
        // Whether a manual timing fits cannot be computed.
        (&[(416, 500), (4416, 1)], &[], false),
        (&[(416, 500)], &[(4409, 1)], false),
        (manual, &[(4416, 1), (416, 1000)], false),
        // The bit rate of CANopen is another one.
        (&[(426, 1000)], &[], false),
    ] {
        let mut bench = Bench::off(&both(of_gateway, of_governor));
        let sent = bench.pass(5_000_000);
        let shown = (clashes(&bench), sent.is_empty(), bench.gateway.state() == State::Undefined);
        assert_eq!(shown, (is_different, is_different, is_different), "{of_gateway:?} {of_governor:?}");
        assert_eq!(bench.gateway.measured(2405), Some(u32::from(!is_different)));
        assert_eq!(bench.sdo([0x40, 0, 0x10, 0, 0, 0, 0, 0]).is_none(), is_different);
    }
}

// GW-APP-50
#[test]
fn a_bit_rate_counts_from_the_start_of_its_unit() {
    let rate = |owner| Parameter::find(owner, 416).unwrap();
    for unit in [Owner::Gateway, Owner::Governor] {
        let mut bench = Bench::started(&[]);
        bench.gateway.set_parameter(rate(unit), 500).unwrap();
        bench.gateway.store(unit);
        bench.pass(1_000_000);
        assert_eq!(bench.gateway.state(), State::Operational, "not in effect yet");
        let now = bench.now;
        bench.gateway.reset(now, unit);
        bench.pass(199_999);
        assert!(!clashes(&bench));
        bench.pass(1);
        assert!(clashes(&bench), "with the start of {unit:?}");
        assert_eq!((bench.pass(5_000_000), bench.gateway.state()), ([].into(), State::Undefined));
        let now = bench.now;
        bench.gateway.clear_errors(now);
        assert!(clashes(&bench), "its cause is present");
        // Mended in the other unit: stored, and started.
        let other = if unit == Owner::Gateway { Owner::Governor } else { Owner::Gateway };
        bench.gateway.set_parameter(rate(other), 500).unwrap();
        bench.gateway.store(other);
        assert_eq!(bench.pass(1_000_000), []);
        let now = bench.now;
        bench.gateway.reset(now, other);
        assert_eq!(bench.pass(300_000).len(), 1, "the boot-up message");
        assert_eq!(bench.gateway.state(), State::PreOperational);
        bench.nmt(1);
        assert!(bench.gateway.errors().next().is_none(), "the errors go as others do");
        // A unit without supply is no participant of the bus.
        bench.gateway.set_parameter(rate(other), 125).unwrap();
        bench.gateway.store(other);
        let now = bench.now;
        bench.gateway.reset(now, other);
        bench.pass(300_000);
        assert!(clashes(&bench));
        let now = bench.now;
        bench.gateway.switch_off(now, Owner::Governor);
        bench.gateway.clear_errors(now);
        assert!(!bench.gateway.errors().any(|error| error == GatewayError::CanBus1));
    }
}

// GW-CFG-31
#[test]
fn the_link_is_monitored_after_its_delay() {
    for (delay, time) in [(0, 200_000 + 32 * GW), (1000, 200_000 + 1_008_000 + 31 * GW)] {
        let mut bench = Bench::off(&both(&[(400, delay), (402, 2)], &[]));
        let silent = |bench: &Bench| bench.gateway.errors().any(|error| error == GatewayError::CanComm1);
        bench.pass(time - 1);
        assert!(!silent(&bench), "{delay} ms");
        bench.pass(1);
        assert!(silent(&bench), "{delay} ms");
    }
}

// GW-APP-40
#[test]
fn the_nodes_of_the_bus() {
    let mut bench = Bench::new(&[]);
    let nodes =
        |bench: &Bench| [2410, 2411, 2424, 2425].map(|number| bench.gateway.measured(number).unwrap());
    assert_eq!(nodes(&bench), [0, 0x0002, 0, 0]);
    let now = bench.now;
    bench.gateway.switch_off(now, Owner::Governor);
    assert_eq!(nodes(&bench), [0; 4]);
    let bench = Bench::new(&both(&[(402, 17)], &[(401, 17)]));
    assert_eq!(nodes(&bench), [0x0002, 0, 0, 0]);
}

// GW-APP-38, GW-NOTE-30, GW-NOTE-39
#[test]
fn what_the_heinzmann_bus_shows() {
    for (fault, number) in [
        (Fault::GatewayTransmitBuffer1, 2401),
        (Fault::GatewayReceiveBuffer1, 2402),
        (Fault::DuplicateGateway, 2404),
    ] {
        let mut bench = Bench::started(&[]);
        let now = bench.now;
        bench.gateway.inject(now, fault);
        assert_eq!(bench.gateway.measured(number), Some(1));
        assert!(bench.gateway.errors().any(|error| error == GatewayError::CanComm1), "any of them is 3071");
        assert_eq!(bench.gateway.state(), State::Undefined);
        bench.gateway.remove(now, fault);
        let is_latched = bench.gateway.measured(number) == Some(1);
        assert_eq!(is_latched, number != 2404, "buffer states stay until errors are cleared");
        bench.gateway.clear_errors(now);
        assert_eq!(bench.gateway.measured(number), Some(0));
        assert_eq!(bench.pass(2 * DC).len(), 1);
    }
}

// GW-NOTE-37
#[test]
fn two_numbers_of_the_governor_are_one_parameter() {
    for (first, second, value) in [(409, 416, 500), (416, 409, 125), (4409, 4416, 1), (4416, 4409, 1)] {
        let bench = Bench::off(&governor(&[(first, value)]));
        let shown = bench.gateway.shown(Owner::Governor, second).map(|amount| amount.value());
        assert_eq!(shown, Some(value), "{first} and {second}");
        let of_gateway = bench.gateway.shown(Owner::Gateway, 416).map(|amount| amount.value());
        assert_eq!(of_gateway, Some(250), "the gateway has its own");
    }
}

// GW-APP-01, GW-CFG-37, GW-CFG-39, GW-CFG-43, GW-NOTE-41
#[test]
fn the_bit_rate_of_canopen() {
    let kbit = |settings: &[(u16, i32)]| {
        Bench::off(&gateway(settings)).gateway.bit_rate().map(edskit_types::Bitrate::kbit_per_s)
    };
    assert_eq!(kbit(&[(427, 1), (426, 125), (4426, 0)]), Some(125));
    assert_eq!([250, 500, 1000].map(|rate| kbit(&[(426, rate)])), [Some(250), Some(500), Some(1000)]);
    assert_eq!(kbit(&[(426, 500), (416, 125)]), Some(500), "the HEINZMANN bus has its own");
    assert_eq!(kbit(&[(4426, 1), (420, 3)]), None, "manual timing has no formula");
}
