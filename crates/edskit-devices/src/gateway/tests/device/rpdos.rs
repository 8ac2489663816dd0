use super::*;
use crate::gateway::Sensor;

/// The example of 7.1.4.2, with sensors in RPDO 2 to 4, and switch functions 1 and -5 (7.1.4.1).
fn inputs(monitoring: &[(u16, i32)]) -> Vec<(Owner, u16, i32)> {
    let sensors = [(900, 1), (4900, 3), (901, 2), (4901, 3), (906, 7), (4906, 3), (917, 12), (4917, 3)];
    let functions = [(827, 1), (4827, 3), (835, -5), (4835, 3)];
    [governor(&sensors), governor(&functions), governor(monitoring)].concat()
}

fn parameter(number: u16) -> Parameter {
    Parameter::find(Owner::Governor, number).unwrap()
}

/// What the governor makes of a sensor, after its next main cycle.
fn sensor(bench: &mut Bench, number: u16) -> Sensor {
    bench.pass(DC);
    bench.gateway.inputs().sensor(parameter(number)).expect("it comes from CANopen")
}

fn function(bench: &mut Bench, number: u16) -> bool {
    bench.pass(DC);
    bench.gateway.inputs().switch_function(parameter(number)).expect("it comes from CANopen")
}

// GW-PDO-14, GW-PDO-15, GW-PDO-16, GW-PDO-18, GW-CFG-07, GW-CFG-08, GW-CFG-09, GW-CFG-10, GW-APP-07, GW-NOTE-11,
// GW-NOTE-13
#[test]
fn sensors_come_from_their_channels() {
    let mut bench = Bench::started(&inputs(&[]));
    bench.ask(0x301, &[1, 0x11, 2, 0x22, 3, 0x33, 4, 0x44]);
    bench.ask(0x401, &[0, 0, 0, 0, 7, 0x77]);
    bench.ask(0x501, &[0, 0, 0, 0, 0, 0, 12, 0xCC]);
    bench.ask(0x201, &[0, 0, 0, 0, 0, 0]);
    let values = [900, 901, 906, 917].map(|number| sensor(&mut bench, number));
    assert_eq!(values, [0x1101, 0x2202, 0x7707, 0xCC0C].map(Sensor::Valid));
    // One flag for each: bit 0 is channel 1, bit 6 channel 7, bit 11 channel 12.
    for (flags, faulty) in [(1_u16 << 0, 900), (1 << 1, 901), (1 << 6, 906), (1 << 11, 917), (0xF000, 0)] {
        let [low, high] = flags.to_le_bytes();
        bench.ask(0x201, &[0, 0, 0, 0, low, high]);
        for number in [900, 901, 906, 917] {
            assert_eq!(
                sensor(&mut bench, number) == Sensor::Faulty,
                number == faulty,
                "flags {flags:04X}h, P{number}"
            );
        }
    }
    assert_eq!(bench.gateway.inputs().sensor(parameter(902)), None, "it does not come from CANopen");
}

// GW-CFG-04, GW-CFG-06, GW-APP-13, GW-NOTE-12
#[test]
fn switch_functions_are_high_or_low_active() {
    let mut bench = Bench::started(&[inputs(&[]), governor(&[(811, 0), (4811, 3)])].concat());
    for (word, setpoint_2, load_enable) in
        [(0x0000_u16, false, true), (0x0001, true, true), (0x0010, false, false), (0x0011, true, false)]
    {
        let [low, high] = word.to_le_bytes();
        bench.ask(0x201, &[low, high, 0, 0, 0, 0]);
        assert_eq!(function(&mut bench, 827), setpoint_2, "{word:04X}h");
        assert_eq!(function(&mut bench, 835), load_enable, "{word:04X}h");
        assert!(!function(&mut bench, 811), "not assigned: always 0");
    }
}

// GW-PDO-17, GW-GAP-11
#[test]
fn a_short_frame_is_ignored_and_of_a_long_one_the_beginning_counts() {
    let mut bench = Bench::started(&inputs(&[]));
    assert_eq!(bench.ask(0x201, &[1, 0, 0, 0, 0]), [], "there is no EMCY");
    assert!(!function(&mut bench, 827));
    bench.ask(0x201, &[1, 0, 0, 0, 0, 0, 9, 9]);
    assert!(function(&mut bench, 827));
    assert_eq!(bench.read(0x1001, 0), Ok(0));
}

// GW-APP-10, GW-APP-12, GW-NMT-14, GW-NOTE-15
#[test]
fn outside_operational_nothing_can_be_believed() {
    let mut bench = Bench::new(&inputs(&[]));
    let all_faulty = |bench: &mut Bench| {
        let sensors = [900, 901, 906, 917].map(|number| sensor(bench, number) == Sensor::Faulty);
        let functions = [827, 835].map(|number| !function(bench, number));
        sensors == [true; 4] && functions == [true; 2]
    };
    let deliver = |bench: &mut Bench| {
        bench.ask(0x201, &[1, 0, 0, 0, 0, 0]);
        for can_id in [0x301, 0x401, 0x501] {
            bench.ask(can_id, &[1; 8]);
        }
    };
    deliver(&mut bench);
    assert!(all_faulty(&mut bench), "pre-operational");
    bench.nmt(1);
    assert!(
        all_faulty(&mut bench),
        "not received since operational began, not even for a low-active function"
    );
    deliver(&mut bench);
    assert!(!all_faulty(&mut bench) && function(&mut bench, 827) && function(&mut bench, 835));
    bench.nmt(2);
    assert!(all_faulty(&mut bench), "stopped");
    bench.nmt(1);
    assert!(all_faulty(&mut bench), "operational has begun anew");
}

// GW-APP-10, GW-NOTE-16
#[test]
fn each_rpdo_counts_for_its_sensors_only() {
    let mut bench = Bench::started(&inputs(&[]));
    bench.ask(0x301, &[5; 8]);
    let faulty = [900, 901, 906, 917].map(|number| sensor(&mut bench, number) == Sensor::Faulty);
    assert_eq!(faulty, [false, false, true, true], "RPDO 1 has never come, and its flags read 0");
}

// GW-TIMING-09, GW-TIMING-10, GW-TIMING-11, GW-APP-08, GW-APP-09, GW-APP-20
#[test]
fn monitoring_triggers_in_main_cycles_and_clears_itself() {
    let settings = inputs(&[(16480, 0), (16481, 100), (16482, 200), (16483, 1000)]);
    for (rpdo, can_id, number, cycles) in [(2, 0x301, 900, 6), (3, 0x401, 906, 12), (4, 0x501, 917, 64)] {
        let mut bench = Bench::started(&settings);
        let keep_alive = |bench: &mut Bench| {
            for other in [0x201_u16, 0x301, 0x401, 0x501].into_iter().filter(|other| *other != can_id) {
                bench.ask(other, &[0; 8]);
            }
        };
        let wait = |bench: &mut Bench, cycles: u64| {
            for _ in 0..cycles {
                keep_alive(bench);
                bench.pass(DC);
            }
            bench.gateway.can_open_errors().contains(CanOpenError::TimeControl)
        };
        bench.ask(can_id, &[9; 8]);
        assert!(!wait(&mut bench, cycles - 1), "RPDO{rpdo} is in time");
        keep_alive(&mut bench);
        bench.pass(DC - 1);
        assert!(!bench.gateway.can_open_errors().contains(CanOpenError::TimeControl));
        bench.pass(1);
        assert!(
            bench.gateway.can_open_errors().contains(CanOpenError::TimeControl),
            "RPDO{rpdo}, to the microsecond"
        );
        assert_eq!(bench.gateway.state(), State::Operational);
        assert_eq!(bench.gateway.inputs().sensor(parameter(number)), Some(Sensor::Faulty));
        assert_eq!(bench.gateway.measured(12413), Some(1));
        bench.ask(can_id, &[9; 8]);
        assert!(!wait(&mut bench, 1), "it clears itself");
        assert_eq!(bench.gateway.inputs().sensor(parameter(number)), Some(Sensor::Valid(0x0909)));
        assert!(bench.gateway.errors().next().is_none());
        // Outside operational nothing is monitored.
        assert!(wait(&mut bench, cycles));
        bench.nmt(128);
        assert!(!wait(&mut bench, cycles + 1));
        // Between two main cycles: never early, at most a main cycle late.
        bench.pass(7_000);
        bench.nmt(1);
        assert!(!wait(&mut bench, cycles));
        keep_alive(&mut bench);
        bench.pass(DC - 7_000);
        assert!(bench.gateway.can_open_errors().contains(CanOpenError::TimeControl));
    }
}

// GW-NOTE-47, GW-APP-10, GW-APP-12
#[test]
fn before_the_first_rpdo_nothing_has_a_value() {
    for (number, can_id) in [(900, 0x301), (901, 0x301), (906, 0x401), (917, 0x501)] {
        for time in [16, 100, 3_984] {
            let mut bench = Bench::new(&inputs(&[(16481, time), (16482, time), (16483, time), (16480, 0)]));
            // Each entry into operational begins anew, whatever was received before.
            for _ in 0..3 {
                bench.nmt(1);
                let value = bench.gateway.inputs().sensor(parameter(number));
                assert_eq!(value, Some(Sensor::Awaited), "P{number} with {time} ms");
                assert_eq!(bench.gateway.inputs().errors(), 0, "and that is no error");
                bench.ask(can_id, &[9; 8]);
                let value = bench.gateway.inputs().sensor(parameter(number));
                assert_eq!(value, Some(Sensor::Valid(0x0909)));
                bench.nmt(128);
                assert_eq!(sensor(&mut bench, number), Sensor::Faulty);
            }
            bench.nmt(1);
            bench.pass(4_100_000);
            assert_eq!(sensor(&mut bench, number), Sensor::Faulty, "the monitoring has triggered");
        }
    }
    // A low-active function is not active because of a bit that nobody has sent.
    let mut bench = Bench::started(&inputs(&[(16480, 3_000)]));
    assert!(!function(&mut bench, 835) && !function(&mut bench, 827));
    bench.ask(0x201, &[0; 6]);
    assert!(function(&mut bench, 835) && !function(&mut bench, 827));
    // Nor is a sensor faulty because of a flag of the last time.
    bench.ask(0x201, &[0, 0, 0, 0, 1, 0]);
    bench.ask(0x301, &[9; 8]);
    assert_eq!(sensor(&mut bench, 900), Sensor::Faulty);
    bench.nmt(128);
    bench.nmt(1);
    bench.ask(0x301, &[9; 8]);
    assert_eq!(sensor(&mut bench, 900), Sensor::Valid(0x0909));
}

// GW-NOTE-47
#[test]
fn the_engine_goes_on_until_canopen_brings_a_setpoint() {
    let settings = governor(&[(900, 1), (4900, 3), (16481, 100), (16400, 2031), (16460, 16)]);
    let mut bench = Bench::new(&settings);
    bench.gateway.governor_mut().set_setpoint(1_300);
    let setpoints = |bench: &mut Bench| {
        bench.nmt(1);
        let sent = bench.pass(8 * DC);
        let words = sent.iter().filter(|(_, frame)| frame.can_id().raw() == 0x481);
        words.map(|(_, frame)| u16::from_le_bytes([frame.data()[0], frame.data()[1]])).collect::<Vec<_>>()
    };
    assert_eq!(setpoints(&mut bench), [1_300; 8], "before the monitoring triggers and after it");
    bench.ask(0x301, &900_u16.to_le_bytes());
    bench.nmt(128);
    assert_eq!(setpoints(&mut bench), [1_300; 8], "not the one of the last time either");
}

// GW-TIMING-11
#[test]
fn without_a_time_nothing_is_monitored() {
    let mut bench = Bench::started(&inputs(&[]));
    bench.pass(100_000_000);
    assert!(bench.gateway.can_open_errors().is_empty());
}

// GW-APP-10, GW-APP-12
#[test]
fn monitoring_of_rpdo_1_makes_everything_faulty() {
    let mut bench = Bench::started(&inputs(&[(16480, 100)]));
    bench.ask(0x201, &[1, 0, 0, 0, 0, 0]);
    bench.ask(0x301, &[5; 8]);
    assert!(function(&mut bench, 827) && sensor(&mut bench, 900) == Sensor::Valid(0x0505));
    bench.pass(6 * DC);
    assert!(!function(&mut bench, 827) && !function(&mut bench, 835));
    assert_eq!(sensor(&mut bench, 900), Sensor::Faulty);
    bench.ask(0x201, &[1, 0, 0, 0, 0, 0]);
    assert!(function(&mut bench, 827) && sensor(&mut bench, 900) == Sensor::Valid(0x0505));
}

// GW-APP-10, GW-APP-12, GW-HB-05, GW-APP-24
#[test]
fn a_missing_heartbeat_makes_everything_faulty() {
    let mut bench = Bench::started(&[inputs(&[]), gateway(&[(428, 9), (430, 100)])].concat());
    bench.ask(0x201, &[1, 0, 0, 0, 0, 0]);
    bench.ask(0x301, &[5; 8]);
    assert!(function(&mut bench, 827) && sensor(&mut bench, 900) == Sensor::Valid(0x0505));
    bench.pass(10 * GW);
    assert!(!function(&mut bench, 827) && sensor(&mut bench, 900) == Sensor::Faulty);
    assert_eq!(bench.gateway.state(), State::Operational, "the state does not change");
    bench.ask(0x709, &[5]);
    bench.pass(GW);
    assert!(function(&mut bench, 827) && sensor(&mut bench, 900) == Sensor::Valid(0x0505));
}

// GW-APP-11
#[test]
fn faulty_sensors_are_errors_from_3005_on() {
    let mut bench = Bench::started(&inputs(&[]));
    bench.pass(DC);
    assert_eq!(bench.gateway.all_errors(), 1 << 5 | 1 << 6 | 1 << 11 | 1 << 22);
    assert_eq!((bench.read(0x2000, 1), bench.read(0x2000, 2)), (Ok(1 << 5 | 1 << 6 | 1 << 11), Ok(1 << 6)));
    bench.ask(0x301, &[5; 8]);
    bench.pass(DC);
    assert_eq!(bench.gateway.all_errors(), 1 << 11 | 1 << 22);
}

// GW-CFG-06, GW-CFG-08
#[test]
fn the_engine_follows_canopen() {
    let mut bench = Bench::started(&inputs(&[]));
    let [low, high] = 1200_u16.to_le_bytes();
    let [low_2, high_2] = 900_u16.to_le_bytes();
    bench.ask(0x301, &[low, high, low_2, high_2, 0, 0, 0, 0]);
    bench.pass(60_000_000);
    assert!(bench.gateway.governor().value(2000).abs_diff(1200) <= 2);
    bench.ask(0x201, &[0x11, 0, 0, 0, 0, 0]);
    bench.pass(60_000_000);
    assert!(bench.gateway.governor().value(2000).abs_diff(900) <= 2, "setpoint 2 is chosen");
}
