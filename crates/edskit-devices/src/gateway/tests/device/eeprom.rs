use super::*;
use crate::gateway::EepromErrors;

/// Resets the gateway, whose start then finds this; the events of half a second.
fn start(bench: &mut Bench, code: u16) -> Vec<Event> {
    bench.gateway.set_eeprom_code(code);
    let now = bench.now;
    bench.gateway.reset(now, Owner::Gateway);
    bench.events();
    bench.pass(500_000);
    bench.events()
}

fn is_told(events: &[Event], code: u16) -> bool {
    events.contains(&Event::EepromErrors(EepromErrors(code)))
}

// GW-APP-47, GW-APP-35
#[test]
fn every_bit_is_shown_from_its_start_until_a_start_that_finds_none() {
    for bit in (0..16).filter(|bit| *bit != 0) {
        let code = 1 << bit;
        let mut bench = Bench::new(&[]);
        assert!(is_told(&start(&mut bench, code), code), "bit {bit}");
        let shown = |bench: &Bench| bench.gateway.measured(3099);
        assert_eq!((shown(&bench), bench.gateway.state()), (Some(code.into()), State::PreOperational));
        assert_eq!(bench.gateway.can_open_errors().0, 1 << 8, "12419 of the reset, and no other");
        let now = bench.now;
        bench.gateway.clear_errors(now);
        assert_eq!(bench.gateway.errors().count(), 0, "it is no error of CANopen: not 3074");
        assert_eq!((bench.read(0x2005, 0), bench.read(0x1001, 0)), (Ok(0), Ok(1)));
        // What the next start will find is not there yet.
        bench.gateway.set_eeprom_code(0_u16);
        assert_eq!(shown(&bench), Some(code.into()));
        assert!(start(&mut bench, code).contains(&Event::EepromErrors(EepromErrors(code))), "every start");
        let events = start(&mut bench, 0);
        assert!(!events.iter().any(|event| matches!(event, Event::EepromErrors(_))));
        assert_eq!((shown(&bench), bench.read(0x1018, 4)), (Some(0), Ok(261_100_001)), "all is well again");
    }
}

// GW-APP-48
#[test]
fn a_gateway_that_stays_in_its_bootloader_says_so() {
    let mut bench = Bench::new(&[]);
    bench.gateway.set_eeprom_code(1_u16);
    let now = bench.now;
    bench.gateway.reset(now, Owner::Gateway);
    assert!(is_told(&bench.events(), 1));
    assert!(bench.gateway.stays_in_bootloader() && !bench.gateway.is_running(Owner::Gateway));
    assert_eq!(bench.pass(5_000_000), []);
    assert_eq!((bench.gateway.measured(3099), bench.gateway.measured(2405)), (Some(1), Some(0)));
    assert!(!is_told(&start(&mut bench, 0), 1));
    assert!(bench.gateway.is_running(Owner::Gateway) && !bench.gateway.stays_in_bootloader());
}
