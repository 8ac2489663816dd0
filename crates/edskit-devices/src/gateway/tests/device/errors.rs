use super::*;
use crate::gateway::Gateway;
use crate::gateway::testing::OneRecord;

fn errors(bench: &Bench) -> Vec<u16> {
    bench.gateway.errors().map(GatewayError::number).collect()
}

fn can_open(bench: &Bench) -> Vec<u16> {
    bench.gateway.can_open_errors().iter().map(CanOpenError::number).collect()
}

/// A gateway in operational that sends and heartbeats, so that silence can be seen.
fn busy() -> Bench {
    let mut bench = Bench::started(&[example(16, 0), gateway(&[(429, 100)])].concat());
    assert!(bench.pass(1_000_000).len() > 60);
    bench.events();
    bench
}

fn inject(bench: &mut Bench, fault: Fault) {
    let now = bench.now;
    bench.gateway.inject(now, fault);
}

fn remove(bench: &mut Bench, fault: Fault) {
    let now = bench.now;
    bench.gateway.remove(now, fault);
}

fn clear(bench: &mut Bench) {
    let now = bench.now;
    bench.gateway.clear_errors(now);
}

/// Frames of a second, which must begin with a boot-up message within three main cycles of the governor.
fn boots_up(bench: &mut Bench) {
    let sent = bench.pass(1_000_000);
    let (time, first) = sent.first().expect("it boots up");
    assert!(*time <= 3 * DC, "{time}");
    assert_eq!(*first, frame(0x701, &[0]));
    assert!(sent[1..].iter().all(|(_, frame)| frame.data() == [0x7F]), "pre-operational: heartbeats only");
    assert_eq!(bench.gateway.state(), State::PreOperational);
}

// GW-APP-21, GW-APP-22, GW-APP-25, GW-APP-26, GW-APP-31, GW-NMT-12, GW-NOTE-28
#[test]
fn faults_between_the_units_end_communication() {
    for (fault, error, number) in [
        (Fault::GovernorCanBus, None, 12414),
        (Fault::GovernorCanComm, None, 12415),
        (Fault::GatewayCanBus1, Some(3070), 12421),
        (Fault::GatewayTransmitBuffer1, Some(3071), 12422),
        (Fault::GatewayReceiveBuffer1, Some(3071), 12422),
        (Fault::DuplicateGateway, Some(3071), 12422),
    ] {
        let mut bench = busy();
        inject(&mut bench, fault);
        assert_eq!(bench.gateway.state(), State::Undefined, "{fault:?}");
        assert!(can_open(&bench).contains(&number));
        assert_eq!(errors(&bench), error.into_iter().chain([3074]).collect::<Vec<_>>());
        assert_eq!(bench.pass(10_000_000), [], "{fault:?}: nothing is sent");
        assert_eq!((bench.nmt(1), bench.sdo([0x40, 0, 0x10, 0, 0, 0, 0, 0])), ([].into(), None));
        clear(&mut bench);
        assert!(can_open(&bench).contains(&number), "{fault:?}: its cause is present");
        remove(&mut bench, fault);
        boots_up(&mut bench);
        assert!(can_open(&bench).contains(&number), "{fault:?}: it stays in pre-operational");
        clear(&mut bench);
        assert_eq!((errors(&bench), can_open(&bench)), ([].into(), [].into()));
    }
}

// GW-APP-17, GW-NMT-15
#[test]
fn operational_clears_what_has_no_cause() {
    let mut bench = busy();
    inject(&mut bench, Fault::GatewayCanBus1);
    bench.pass(2_000_000);
    remove(&mut bench, Fault::GatewayCanBus1);
    boots_up(&mut bench);
    assert!(!can_open(&bench).is_empty());
    bench.nmt(1);
    assert_eq!((errors(&bench), can_open(&bench)), ([].into(), [].into()));
    assert!(bench.pass(1_000_000).len() > 60, "the master has started it again");
}

// GW-APP-18, GW-NMT-15
#[test]
fn a_reset_of_the_governor_alone() {
    let mut bench = busy();
    let now = bench.now;
    bench.gateway.reset(now, Owner::Governor);
    let during = bench.pass(200_000);
    assert!(during.iter().all(|(_, frame)| frame.can_id().raw() != 0x481), "PDO traffic stops");
    boots_up(&mut bench);
    assert_eq!((errors(&bench), can_open(&bench)), ([3074].into(), [12411].into()));
    bench.nmt(1);
    assert_eq!(can_open(&bench), []);
}

// GW-APP-23, GW-NMT-15, GW-NMT-02
#[test]
fn a_reset_of_the_gateway_alone() {
    let mut bench = busy();
    let now = bench.now;
    bench.gateway.reset(now, Owner::Gateway);
    assert_eq!(bench.gateway.state(), State::Undefined);
    assert_eq!(bench.pass(200_000), []);
    boots_up(&mut bench);
    assert_eq!((errors(&bench), can_open(&bench)), ([3074].into(), [12419].into()));
    clear(&mut bench);
    assert_eq!(errors(&bench), []);
}

// GW-APP-26, GW-APP-39, GW-APP-22
#[test]
fn a_unit_without_supply_is_missed() {
    let mut bench = busy();
    let now = bench.now;
    bench.gateway.switch_off(now, Owner::Governor);
    bench.pass(2_000_000);
    assert_eq!((bench.gateway.state(), can_open(&bench)), (State::Undefined, [12422].into()));
    assert_eq!(bench.gateway.measured(2403), Some(1));
    let now = bench.now;
    bench.gateway.switch_on(now, Owner::Governor);
    bench.pass(200_000);
    boots_up(&mut bench);
    assert_eq!(can_open(&bench), [12411, 12422]);
    // A broken wire: both miss the other.
    inject(&mut bench, Fault::LinkBroken);
    bench.pass(2_000_000);
    assert_eq!((bench.gateway.state(), can_open(&bench)), (State::Undefined, [12411, 12415, 12422].into()));
    remove(&mut bench, Fault::LinkBroken);
    clear(&mut bench);
    assert_eq!(can_open(&bench), [], "what is over can be cleared at once");
    boots_up(&mut bench);
}

// GW-APP-27, GW-APP-32, GW-APP-46, GW-NOTE-33
#[test]
fn a_faulty_canopen_bus_is_tried_every_half_second() {
    for (settings, state) in [(gateway(&[(429, 100)]), 0x7F), (gateway(&[]), 0x00)] {
        let mut bench = Bench::started(&[example(16, 0), settings].concat());
        bench.pass(1_000_000);
        inject(&mut bench, Fault::GatewayCanBus2);
        assert_eq!((bench.gateway.state(), can_open(&bench)), (State::PreOperational, [12423].into()));
        assert_eq!((errors(&bench), bench.gateway.measured(12405)), ([3072, 3074].into(), Some(0)));
        let sent = bench.pass(2_250_000);
        let expected: Vec<_> = [1, 2, 3, 4].map(|nth| (nth * 500_000, frame(0x701, &[state]))).into();
        assert_eq!(sent, expected);
        assert_eq!(
            (bench.nmt(1), bench.gateway.state()),
            ([].into(), State::PreOperational),
            "nothing arrives"
        );
        clear(&mut bench);
        assert_eq!(can_open(&bench), [12423]);
        remove(&mut bench, Fault::GatewayCanBus2);
        let sent = bench.pass(1_000_000);
        assert_eq!(
            sent.first(),
            Some(&(250_000, frame(0x701, &[state]))),
            "the next attempt finds it in order"
        );
        assert!(
            sent[1..].iter().all(|(_, frame)| frame.data() == [0x7F]),
            "it is not initialised anew: {sent:?}"
        );
        assert_eq!(can_open(&bench), [12423], "it stays in pre-operational");
        assert!(bench.read(0x2005, 0).is_ok_and(|errors| errors == 1 << 12));
        bench.nmt(1);
        assert_eq!((errors(&bench), can_open(&bench)), ([].into(), [].into()));
        assert!(bench.pass(1_000_000).len() > 60);
    }
}

// GW-APP-28, GW-APP-33, GW-NOTE-29, GW-NOTE-34, GW-NMT-15
#[test]
fn an_overflow_of_the_receive_buffer() {
    let mut bench = busy();
    inject(&mut bench, Fault::ReceiveBuffer2);
    assert_eq!((bench.gateway.state(), can_open(&bench)), (State::Undefined, [12424].into()));
    assert_eq!(errors(&bench), [3073, 3074], "and not 3071");
    boots_up(&mut bench);
    assert_eq!(bench.read(0x2005, 0), Ok(1 << 13));
    clear(&mut bench);
    assert_eq!(errors(&bench), []);
}

// GW-APP-49, GW-NOTE-29
#[test]
fn an_overflow_of_the_canopen_buffer_of_the_heinzmann_side() {
    let mut bench = busy();
    inject(&mut bench, Fault::CanOpenBuffer1);
    assert_eq!((bench.gateway.state(), can_open(&bench)), (State::Undefined, [12422].into()));
    assert_eq!(errors(&bench), [3071, 3074], "and not 3073");
    assert_eq!(
        [2401, 2402].map(|number| bench.gateway.measured(number)),
        [Some(0); 2],
        "it is another buffer"
    );
    assert!(bench.gateway.faults().next().is_none(), "it is over at once");
    boots_up(&mut bench);
    assert_eq!(bench.read(0x2005, 0), Ok(1 << 11));
    bench.nmt(1);
    assert_eq!(errors(&bench), []);
    inject(&mut bench, Fault::CanOpenBuffer1);
    boots_up(&mut bench);
    clear(&mut bench);
    assert_eq!((errors(&bench), bench.gateway.error_count(GatewayError::CanComm1)), ([].into(), 2));
}

// GW-APP-29, GW-APP-33, GW-NMT-10
#[test]
fn an_overflow_of_the_sdo_transmit_buffer() {
    let mut bench = busy();
    inject(&mut bench, Fault::TransmitBuffer2);
    assert_eq!((bench.gateway.state(), can_open(&bench)), (State::Stopped, [12424].into()));
    let sent = bench.pass(1_000_000);
    assert!(
        !sent.is_empty() && sent.iter().all(|(_, frame)| frame.data() == [4]),
        "heartbeats only: {sent:?}"
    );
    assert_eq!(bench.sdo([0x40, 0, 0x10, 0, 0, 0, 0, 0]), None);
    bench.nmt(128);
    assert_eq!(bench.read(0x2005, 0), Ok(1 << 13));
    bench.nmt(1);
    assert_eq!(errors(&bench), []);
}

// GW-APP-29
#[test]
fn a_bus_that_takes_nothing_overflows_the_buffer_in_truth() {
    let mut bench = Bench::new(&[]);
    // Answers that nobody takes: sixteen fit, the server holds the next one back, and one more is lost.
    for _ in 0..18 {
        let request = frame(0x601, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]);
        edskit_runtime::Device::receive(&mut bench.gateway, bench.now, &request);
    }
    edskit_runtime::Device::poll(&mut bench.gateway, bench.now);
    assert_eq!((bench.gateway.state(), errors(&bench)), (State::Stopped, [3073, 3074].into()));
    assert_eq!(bench.sent(), [], "the buffer is emptied");
}

// GW-APP-31, GW-NOTE-31
#[test]
fn errors_of_the_unit_itself_must_be_cleared() {
    for (fault, number) in [
        (Fault::ParamStore, 3076),
        (Fault::ProgramTest, 3077),
        (Fault::RamTest, 3078),
        (Fault::Data, 3090),
        (Fault::Stack, 3093),
        (Fault::Intern, 3094),
    ] {
        let mut bench = busy();
        inject(&mut bench, fault);
        assert_eq!((bench.gateway.state(), errors(&bench)), (State::Undefined, [number].into()));
        assert!(can_open(&bench).is_empty(), "they are no errors of CANopen");
        remove(&mut bench, fault);
        assert_eq!(bench.pass(5_000_000), [], "{number} stays");
        clear(&mut bench);
        boots_up(&mut bench);
        assert_eq!(errors(&bench), []);
    }
}

// GW-APP-34, GW-APP-42
#[test]
fn a_low_supply_is_a_message_only() {
    let mut bench = busy();
    for (millivolts, is_present) in [(7_500, false), (7_499, true), (24_000, false)] {
        let now = bench.now;
        bench.gateway.set_supply(now, millivolts);
        assert_eq!(errors(&bench) == [3085], is_present);
        assert_eq!(bench.gateway.measured(3600), Some(u32::from(millivolts) / 1000));
        assert_eq!(bench.gateway.state(), State::Operational);
    }
    assert!(bench.pass(1_000_000).len() > 60);
}

// GW-APP-16, GW-APP-36
#[test]
fn both_units_show_and_clear_the_same_errors() {
    let mut bench = busy();
    inject(&mut bench, Fault::GovernorCanBus);
    assert_eq!(bench.gateway.all_errors(), 1 << 70 | 1 << 74, "3070 of the governor, 3074 of both");
    assert_eq!([3070, 3074].map(|number| bench.gateway.measured(number)), [Some(0), Some(1)]);
    remove(&mut bench, Fault::GovernorCanBus);
    clear(&mut bench);
    assert_eq!(bench.gateway.all_errors(), 0);
}

// GW-APP-30, GW-APP-36, GW-APP-37
#[test]
fn counters_survive_a_restart_and_errors_do_not() {
    let mut bench = busy();
    for _ in 0..3 {
        inject(&mut bench, Fault::GatewayCanBus2);
        remove(&mut bench, Fault::GatewayCanBus2);
        clear(&mut bench);
    }
    inject(&mut bench, Fault::GatewayCanBus2);
    assert_eq!(
        [3072, 3172, 3174, 3170].map(|number| bench.gateway.measured(number)),
        [Some(1), Some(4), Some(4), Some(0)]
    );
    remove(&mut bench, Fault::GatewayCanBus2);
    let now = bench.now;
    bench.gateway.reset(now, Owner::Gateway);
    bench.gateway.reset(now, Owner::Governor);
    bench.pass(300_000);
    assert_eq!([3072, 3172, 3174].map(|number| bench.gateway.measured(number)), [Some(0), Some(4), Some(4)]);
    // What is still wrong is shown again at once.
    inject(&mut bench, Fault::RamTest);
    let now = bench.now;
    bench.gateway.reset(now, Owner::Gateway);
    bench.pass(200_000);
    assert_eq!((errors(&bench), bench.gateway.measured(3178)), ([3078].into(), Some(2)));
    assert_eq!(bench.gateway.error_count(GatewayError::CanBus2), 4);
}

// GW-APP-30
#[test]
fn counters_outlive_the_device() {
    let storage = OneRecord::default();
    let mut first = Bench::new(&[]);
    first.gateway = Gateway::new(Default::default(), Default::default(), storage.clone());
    first.pass(300_000);
    inject(&mut first, Fault::GatewayCanBus1);
    let second: Gateway<crate::gateway::Engine, _> =
        Gateway::new(Default::default(), Default::default(), storage);
    assert_eq!(second.error_count(GatewayError::CanBus1), 1);
}

// GW-APP-35
#[test]
fn bad_pages_of_the_eeprom() {
    let start = |code: u8| {
        let mut bench = Bench::new(&gateway(&[(427, 9)]));
        inject(&mut bench, Fault::GatewayCanBus2);
        remove(&mut bench, Fault::GatewayCanBus2);
        bench.gateway.set_eeprom_code(code);
        let now = bench.now;
        bench.gateway.reset(now, Owner::Gateway);
        let sent = bench.pass(300_000);
        let can_ids: Vec<u32> = sent.iter().map(|(_, frame)| frame.can_id().raw()).collect();
        let serial = bench.gateway.measured(3845);
        (can_ids, bench.gateway.error_count(GatewayError::CanBus2), serial, bench.gateway.measured(3099))
    };
    assert_eq!(start(0), ([0x709].into(), 1, Some(1), Some(0)));
    assert_eq!(start(1 << 0), ([].into(), 1, Some(1), Some(1)), "it stays in the bootloader");
    assert_eq!(start(1 << 3), ([0x709].into(), 1, Some(0), Some(8)), "the serial number is lost");
    assert_eq!(start(1 << 4), ([0x709].into(), 0, Some(1), Some(16)), "the error memory is cleared");
    assert_eq!(start(1 << 5), ([0x701].into(), 1, Some(1), Some(32)), "the defaults are used");
    assert_eq!(start(1 << 6), ([0x709].into(), 1, Some(1), Some(64)));
}

// GW-NOTE-36, GW-OD-02, GW-OD-19, GW-APP-15
#[test]
fn the_error_register_and_2005h() {
    let mut bench = Bench::started(&[]);
    let registers = |bench: &mut Bench| (bench.read(0x1001, 0).unwrap(), bench.read(0x2005, 0).unwrap());
    assert_eq!(registers(&mut bench), (0, 0));
    let now = bench.now;
    bench.gateway.set_supply(now, 7_000);
    assert_eq!(registers(&mut bench), (1, 0), "an error, but none of communication");
    bench.gateway.set_supply(now, 24_000);
    bench.gateway.reset(now, Owner::Governor);
    bench.pass(300_000);
    assert_eq!(registers(&mut bench), (1, 1 << 0));
    inject(&mut bench, Fault::ReceiveBuffer2);
    bench.pass(300_000);
    assert_eq!(registers(&mut bench), (0x11, 1 << 0 | 1 << 13));
}

// GW-APP-42, GW-NOTE-44
#[test]
fn the_timer_runs_in_milliseconds_and_begins_anew() {
    let mut bench = Bench::new(&[]);
    let timer = |bench: &Bench| bench.gateway.measured(3870).unwrap();
    bench.pass(GW - (bench.now.0 - 200_000) % GW + 60_000_000);
    let before = timer(&bench);
    bench.pass(1_000 * GW);
    assert_eq!((before + 16_000) % 65_536, timer(&bench));
    assert_eq!(bench.gateway.measured(2406), None, "the manual lists it and does not describe it");
}
