use super::*;
use std::string::{String, ToString};

/// Why the attempts of the last second have failed, and how often frames were sent.
fn failures(bench: &mut Bench) -> (Vec<(u8, String)>, usize) {
    let sent = bench.pass(1_000_000).len();
    let failures = bench.events().into_iter().filter_map(|event| match event {
        Event::InitialisationFailed { attempt, reason: Refusal::Conflict(conflict) } => {
            Some((attempt, conflict.to_string()))
        }
        Event::InitialisationFailed { attempt, reason: Refusal::Structure(error) } => {
            Some((attempt, error.to_string()))
        }
        _ => None,
    });
    (failures.collect(), sent)
}

/// Settings of both units.
type Settings = Vec<(Owner, u16, i32)>;

/// TPDO 5 active, with this identifier.
fn tpdo_5(can_id: i32) -> Settings {
    both(&[(16404, can_id)], &[(16404, 2000), (16461, 100)])
}

/// Each configuration that 7.3 refuses, by its check, with what the device says.
fn wrong() -> Vec<(u8, Settings, &'static str)> {
    let node_2 = |more: Vec<_>| [gateway(&[(427, 2)]), more].concat();
    let sensors = [(900, 9), (4900, 3)];
    std::vec![
        (1, node_2([tpdo_5(0x282), governor(&[(14401, 1)])].concat()), "TPDO5 and TPDO2 on 282h"),
        (
            1,
            [both(&[(427, 127), (16415, 0x57F)], &[(16448, 2000), (16472, 100)]), governor(&sensors),]
                .concat(),
            "TPDO16 and RPDO4 on 57Fh",
        ),
        (2, tpdo_5(0x000), "TPDO5 and NMT on 000h"),
        (3, tpdo_5(0x080), "TPDO5 and SYNC on 080h"),
        (4, tpdo_5(0x100), "TPDO5 and TIME on 100h"),
        (5, tpdo_5(0x581), "TPDO5 and SDO server response on 581h"),
        (6, tpdo_5(0x601), "TPDO5 and SDO server request on 601h"),
        (7, tpdo_5(0x701), "TPDO5 and heartbeat on 701h"),
        (8, [tpdo_5(0x70A), gateway(&[(428, 10)])].concat(), "TPDO5 and heartbeat of node 10 on 70Ah"),
        (9, gateway(&[(427, 10), (428, 10)]), "heartbeat of node 10 and heartbeat on 70Ah"),
    ]
}

// GW-CFG-15, GW-CFG-16, GW-CFG-17, GW-CFG-18, GW-CFG-19, GW-CFG-20, GW-CFG-21, GW-CFG-22, GW-CFG-23, GW-CFG-24,
// GW-CFG-25, GW-CFG-26, GW-CFG-28, GW-APP-14, GW-APP-19
#[test]
fn a_wrong_configuration_ends_after_three_attempts() {
    for (check, settings, reason) in wrong() {
        let mut bench = Bench::off(&settings);
        let (failed, sent) = failures(&mut bench);
        assert_eq!(failed, [1, 2, 3].map(|attempt| (attempt, reason.to_string())), "check {check} of 7.3");
        assert_eq!((bench.gateway.state(), sent), (State::Undefined, 0));
        assert!(bench.gateway.pdos().is_none(), "there is no object dictionary");
        assert_eq!(bench.gateway.errors().collect::<Vec<_>>(), [GatewayError::CanOpen]);
        assert_eq!(bench.gateway.can_open_errors().iter().collect::<Vec<_>>(), [CanOpenError::Init]);
        assert_eq!([3074, 12412].map(|number| bench.gateway.measured(number)), [Some(1); 2]);
        let node_id = u16::from(bench.gateway.parameters().node_id().get());
        assert_eq!(bench.ask(0x600 + node_id, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]), []);
        assert_eq!(bench.pass(10_000_000), [], "it never boots up by itself");
    }
}

// GW-APP-14, GW-APP-19, GW-CFG-30
#[test]
fn mended_parameters_need_storing_a_reset_and_then_it_boots_up() {
    for (check, settings, _) in wrong() {
        let mut bench = Bench::off(&settings);
        failures(&mut bench);
        for (owner, number, _) in settings {
            let parameter = Parameter::find(owner, number).unwrap();
            bench.gateway.set_parameter(parameter, parameter.default_value()).unwrap();
        }
        let now = bench.now;
        bench.gateway.clear_errors(now);
        assert_eq!(
            failures(&mut bench).0.len(),
            3,
            "check {check}: clearing errors gives three new attempts"
        );
        bench.gateway.store(Owner::Gateway);
        bench.gateway.store(Owner::Governor);
        let now = bench.now;
        bench.gateway.clear_errors(now);
        assert_eq!(failures(&mut bench).0.len(), 3, "stored, but not in effect");
        let now = bench.now;
        bench.gateway.reset(now, Owner::Governor);
        bench.gateway.reset(now, Owner::Gateway);
        assert_eq!(bench.pass(231_250), [(231_250, frame(0x701, &[0]))]);
        assert_eq!(bench.gateway.state(), State::PreOperational);
        assert!(bench.gateway.can_open_errors().is_empty());
    }
}

// GW-APP-14, GW-APP-17, GW-APP-19
#[test]
fn after_a_reset_of_the_governor_alone_the_error_is_cleared_on_command() {
    let mut bench = Bench::off(&tpdo_5(0x080));
    failures(&mut bench);
    // Without TPDO 5 the governor's telegrams are harmless.
    bench.gateway.set_parameter(Parameter::tpdo_cycle(5).unwrap(), 0).unwrap();
    bench.gateway.store(Owner::Governor);
    let now = bench.now;
    bench.gateway.reset(now, Owner::Governor);
    assert_eq!(bench.pass(231_250 + GW).len(), 1);
    assert_eq!(bench.gateway.state(), State::PreOperational);
    let errors: Vec<_> = bench.gateway.can_open_errors().iter().collect();
    assert_eq!(errors, [CanOpenError::GovernorReset, CanOpenError::Init], "they stay in pre-operational");
    let now = bench.now;
    bench.gateway.clear_errors(now);
    assert!(bench.gateway.errors().next().is_none());
}

// GW-CFG-17, GW-APP-17
#[test]
fn broken_telegrams_are_refused_and_whole_ones_taken() {
    let mut bench = Bench::off(&[]);
    let now = bench.now;
    bench.gateway.inject(now, Fault::InitTelegrams);
    let (failed, _) = failures(&mut bench);
    assert_eq!(failed.len(), 3);
    assert_eq!(failed[2], (3, StructureError::OutOfOrder.to_string()));
    let now = bench.now;
    bench.gateway.remove(now, Fault::InitTelegrams);
    assert_eq!(failures(&mut bench), ([].into(), 0), "it has given up");
    let now = bench.now;
    bench.gateway.clear_errors(now);
    assert_eq!(failures(&mut bench), ([].into(), 1));
    assert_eq!(bench.gateway.state(), State::PreOperational);
}

// GW-CFG-27, GW-CFG-29, GW-NOTE-19, GW-NOTE-20
#[test]
fn what_7_3_does_not_look_at_is_accepted() {
    // Identifiers of inactive TPDOs, those of other nodes' SDO and heartbeat, and reserved ones below 080h.
    for settings in [tpdo_5(0x003), tpdo_5(0x582), tpdo_5(0x602), tpdo_5(0x703), gateway(&[(16404, 0)])] {
        let bench = Bench::new(&settings);
        assert_eq!(bench.gateway.state(), State::PreOperational);
    }
}

// GW-NOTE-21
#[test]
fn partner_0_takes_700h() {
    let mut bench = Bench::off(&tpdo_5(0x700));
    assert_eq!(failures(&mut bench).0[0].1, "TPDO5 and heartbeat of node 0 on 700h");
}
