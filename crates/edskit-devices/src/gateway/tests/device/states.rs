use super::*;
use edskit_runtime::Device as _;

/// The measured values of the state, 12401 to 12405.
fn shown(bench: &Bench) -> [Option<u32>; 5] {
    [12401, 12402, 12403, 12404, 12405].map(|number| bench.gateway.measured(number))
}

// GW-NMT-02, GW-NMT-05, GW-NMT-06, GW-NMT-07, GW-TIMING-15, GW-APP-04, GW-GAP-12
#[test]
fn from_the_supply_to_the_boot_up_message() {
    let mut bench = Bench::off(&[]);
    assert_eq!(bench.gateway.state(), State::Undefined);
    assert_eq!(bench.pass(200_000), [], "the start of the units");
    assert_eq!(bench.pass(DC - 1), []);
    assert_eq!(bench.gateway.state(), State::Undefined);
    assert_eq!(bench.pass(1), [], "the governor commands init");
    assert_eq!(bench.gateway.state(), State::Init);
    assert_eq!(bench.pass(DC), [(DC, frame(0x701, &[0]))], "the boot-up message follows pre-operational");
    assert_eq!(bench.gateway.state(), State::PreOperational);
    let states: Vec<Event> = bench.events();
    assert_eq!(
        states,
        [
            Event::Started(Owner::Governor),
            Event::Started(Owner::Gateway),
            Event::State(State::Init),
            Event::State(State::PreOperational),
        ]
    );
}

// GW-APP-05, GW-APP-06, GW-NMT-01, GW-NOTE-40
#[test]
fn measured_values_show_the_state() {
    let mut bench = Bench::off(&[]);
    assert_eq!(shown(&bench), [Some(0); 5]);
    assert_eq!(bench.gateway.measured(12400), Some(0));
    bench.pass(200_000 + DC);
    assert_eq!(shown(&bench), [Some(0), Some(1), Some(0), Some(0), Some(0)]);
    bench.pass(DC);
    assert_eq!(shown(&bench), [Some(0), Some(0), Some(1), Some(0), Some(1)]);
    bench.nmt(1);
    assert_eq!(shown(&bench), [Some(0), Some(0), Some(0), Some(1), Some(1)]);
    bench.nmt(2);
    assert_eq!(shown(&bench), [Some(1), Some(0), Some(0), Some(0), Some(1)]);
    assert_eq!(bench.gateway.measured(12400), Some(4));
}

// GW-NMT-03, GW-NMT-08, GW-NMT-09, GW-NMT-10
#[test]
fn the_master_starts_and_stops() {
    let mut bench = Bench::new(&[]);
    for (command, state) in [
        (1, State::Operational),
        (128, State::PreOperational),
        (2, State::Stopped),
        (1, State::Operational),
        (2, State::Stopped),
        (128, State::PreOperational),
    ] {
        assert_eq!(bench.nmt(command), []);
        assert_eq!(bench.gateway.state(), state);
    }
}

// GW-NMT-04
#[test]
fn the_master_is_not_heard_in_undefined_and_init() {
    let mut bench = Bench::off(&[]);
    for (time, state) in [(0, State::Undefined), (200_000, State::Undefined), (DC, State::Init)] {
        bench.pass(time);
        for command in [1, 2, 128, 129, 130] {
            assert_eq!(bench.nmt(command), []);
            assert_eq!(bench.gateway.state(), state);
        }
    }
    assert_eq!(bench.pass(DC), [(DC, frame(0x701, &[0]))]);
}

// GW-NMT-11, GW-NOTE-01
#[test]
fn the_masters_resets_are_its_command_init() {
    for before in [128, 1, 2] {
        for reset in [129, 130] {
            let mut bench = Bench::new(&[]);
            bench.nmt(before);
            assert_eq!(bench.nmt(reset), []);
            assert_eq!(bench.gateway.state(), State::Init);
            assert_eq!(bench.pass(DC), [], "the governor sends its telegrams");
            assert_eq!(bench.pass(DC), [(DC, frame(0x701, &[0]))]);
            assert_eq!(bench.gateway.state(), State::PreOperational);
        }
    }
}

// GW-NMT-03, GW-NMT-09, GW-NMT-11, GW-NMT-12, GW-NOTE-02
#[test]
fn the_governor_commands() {
    let mut bench = Bench::started(&[]);
    let now = bench.now;
    assert!(!bench.gateway.command(now, State::Operational) && !bench.gateway.command(now, State::Stopped));
    assert!(bench.gateway.command(now, State::PreOperational));
    assert_eq!(bench.gateway.state(), State::PreOperational);
    bench.nmt(2);
    assert!(bench.gateway.command(now, State::PreOperational));
    assert_eq!(bench.gateway.state(), State::PreOperational);
    assert!(bench.gateway.command(now, State::Undefined));
    assert_eq!(bench.gateway.state(), State::Undefined);
    assert!(!bench.gateway.command(now, State::PreOperational), "there is no direct way");
    assert_eq!(bench.pass(1_000_000), [], "undefined lasts until the governor wants otherwise");
    let now = bench.now;
    assert!(bench.gateway.command(now, State::Init));
    assert_eq!(bench.gateway.state(), State::Init);
    assert!(!bench.gateway.command(now, State::PreOperational), "not before the telegrams");
    assert_eq!(bench.pass(2 * DC).len(), 1);
    assert_eq!(bench.gateway.state(), State::PreOperational);
    bench.nmt(1);
    let now = bench.now;
    assert!(bench.gateway.command(now, State::Init), "re-initialisation");
    assert_eq!(bench.pass(2 * DC).len(), 1);
    assert_eq!(bench.gateway.state(), State::PreOperational);
}

// GW-NMT-13, GW-HB-06
#[test]
fn sdo_and_heartbeat_by_state() {
    let request = [0x40, 0x00, 0x10, 0, 0, 0, 0, 0];
    let mut bench = Bench::off(&gateway(&[(429, 16)]));
    let mut alive = Vec::new();
    for (command, time) in
        [(None, 200_000), (None, DC), (None, DC), (Some(1), 0), (Some(2), 0), (Some(128), 0)]
    {
        if let Some(command) = command {
            bench.nmt(command);
        }
        bench.pass(time);
        let is_answered = bench.sdo(request).is_some();
        let before = bench.gateway.state();
        let beats = bench.gateway.next_deadline(bench.now);
        let sent = if before.communicates() { bench.pass(GW) } else { [].into() };
        assert!(beats > bench.now || !sent.is_empty() || !before.communicates());
        alive.push((before, is_answered, sent.last().map(|(_, frame)| frame.data().to_vec())));
    }
    assert_eq!(
        alive,
        [
            (State::Undefined, false, None),
            (State::Init, false, None),
            (State::PreOperational, true, Some([0x7F].into())),
            (State::Operational, true, Some([5].into())),
            (State::Stopped, false, Some([4].into())),
            (State::PreOperational, true, Some([0x7F].into())),
        ]
    );
}

// GW-NMT-12, GW-NMT-15, GW-CFG-30
#[test]
fn a_power_cycle_begins_anew() {
    let mut bench = Bench::started(&gateway(&[(429, 100)]));
    let now = bench.now;
    bench.gateway.set_parameter(Parameter::MY_NODE_ID, 9).unwrap();
    assert_eq!(bench.gateway.effective_parameters().node_id().get(), 1);
    bench.gateway.store(Owner::Gateway);
    bench.gateway.switch_off(now, Owner::Gateway);
    bench.gateway.switch_off(now, Owner::Governor);
    assert_eq!(bench.pass(1_000_000), [], "no supply");
    bench.gateway.reset(now, Owner::Gateway);
    assert!(!bench.gateway.is_powered(Owner::Gateway), "a reset brings no supply");
    assert_eq!(bench.nmt(1), []);
    let now = bench.now;
    bench.gateway.switch_on(now, Owner::Governor);
    bench.gateway.switch_on(now, Owner::Gateway);
    let sent = bench.pass(400_000);
    assert_eq!(sent[0], (231_250, frame(0x709, &[0])));
    assert_eq!(sent[1], (231_250 + 6 * GW, frame(0x709, &[0x7F])));
    assert!(bench.gateway.errors().next().is_none(), "both were off: no unit misses the other");
}
