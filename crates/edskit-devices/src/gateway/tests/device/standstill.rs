use super::*;
use crate::gateway::Standstill;

fn after(settings: &[(Owner, u16, i32)], time: u64) -> Option<Standstill> {
    let mut bench = Bench::off(settings);
    bench.pass(time);
    bench.gateway.standstill()
}

// GW-CFG-48, GW-APP-14, GW-APP-48, GW-NMT-12
#[test]
fn there_is_always_a_reason() {
    assert_eq!(after(&[], 100_000), Some(Standstill::GatewayStarting));
    assert_eq!(after(&[], 200_000), Some(Standstill::Initialising));
    assert_eq!(after(&[], 231_250), None);
    for settings in [gateway(&[(401, 2)]), gateway(&[(416, 500)]), governor(&[(4406, 0)])] {
        for time in [300_000, 5_000_000] {
            assert_eq!(after(&settings, time), Some(Standstill::Apart), "{settings:?}");
        }
    }
    let refused = after(&gateway(&[(428, 1)]), 1_000_000);
    assert!(matches!(refused, Some(Standstill::Refused(Refusal::Conflict(_)))), "{refused:?}");
    let mut bench = Bench::started(&[]);
    let reason = |bench: &mut Bench, act: &mut dyn FnMut(&mut Bench)| {
        act(bench);
        let reason = bench.gateway.standstill();
        bench.gateway.faults().collect::<Vec<_>>().into_iter().for_each(|fault| {
            let now = bench.now;
            bench.gateway.remove(now, fault);
        });
        let now = bench.now;
        bench.gateway.clear_errors(now);
        for unit in [Owner::Gateway, Owner::Governor] {
            bench.gateway.set_eeprom_code(0_u16);
            bench.gateway.switch_off(now, unit);
            bench.gateway.switch_on(now, unit);
        }
        bench.pass(1_000_000);
        assert_eq!(bench.gateway.standstill(), None);
        reason
    };
    let inject = |bench: &mut Bench, fault| {
        let now = bench.now;
        bench.gateway.inject(now, fault);
    };
    for (fault, expected) in [
        (Fault::GatewayCanBus1, Standstill::Fault(Fault::GatewayCanBus1)),
        (Fault::GovernorCanComm, Standstill::GovernorError(CanOpenError::GovernorCanComm)),
        (Fault::DuplicateGateway, Standstill::Error(GatewayError::CanComm1)),
        (Fault::Intern, Standstill::Error(GatewayError::Intern)),
        (Fault::ReceiveBuffer2, Standstill::Initialising),
    ] {
        assert_eq!(reason(&mut bench, &mut |bench| inject(bench, fault)), Some(expected));
    }
    let commanded = reason(&mut bench, &mut |bench| {
        let now = bench.now;
        assert!(bench.gateway.command(now, State::Undefined));
    });
    assert_eq!(commanded, Some(Standstill::Commanded));
    for (unit, off, starting) in [
        (Owner::Gateway, Standstill::GatewayOff, Standstill::GatewayStarting),
        (Owner::Governor, Standstill::GovernorOff, Standstill::GovernorStarting),
    ] {
        let is_off = reason(&mut bench, &mut |bench| {
            let now = bench.now;
            bench.gateway.switch_off(now, unit);
            bench.pass(5_000_000);
        });
        let starts = reason(&mut bench, &mut |bench| {
            let now = bench.now;
            bench.gateway.reset(now, unit);
            bench.pass(100_000);
        });
        if unit == Owner::Gateway {
            assert_eq!((is_off, starts), (Some(off), Some(starting)));
        } else {
            // The gateway goes on until it misses the governor.
            assert_eq!((is_off, starts), (Some(off), None));
        }
    }
    let in_bootloader = reason(&mut bench, &mut |bench| {
        bench.gateway.set_eeprom_code(1_u16);
        let now = bench.now;
        bench.gateway.reset(now, Owner::Gateway);
    });
    assert_eq!(in_bootloader, Some(Standstill::InBootloader));
}
