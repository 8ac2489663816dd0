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
