use super::*;
use crate::gateway::{MEASURED_VALUES, Quantity, parameters};
use std::string::ToString;

fn shown(bench: &Bench, unit: Owner, number: u16) -> Option<i32> {
    bench.gateway.shown(unit, number).map(|amount| amount.value())
}

// GW-APP-51, GW-NOTE-40
#[test]
fn every_measured_value_and_parameter_can_be_read() {
    let bench = Bench::started(&[]);
    for (number, name) in MEASURED_VALUES {
        let value = bench.gateway.shown(Owner::Gateway, *number);
        assert_eq!(value.is_some(), *number != 2406, "{number} {name}");
    }
    for parameter in parameters() {
        let value = bench.gateway.shown(parameter.owner(), parameter.number());
        let expected = parameter.amount(parameter.default_value()).to_string();
        assert_eq!(value.map(|amount| amount.to_string()), Some(expected));
    }
    for number in [12401, 12402, 12403, 12404, 3074, 12411, 12412, 12413, 12414, 12415, 12419, 12420, 12421] {
        assert_eq!(shown(&bench, Owner::Governor, number), shown(&bench, Owner::Gateway, number), "{number}");
    }
    for (unit, number) in [(Owner::Gateway, 2000), (Owner::Gateway, 9), (Owner::Governor, 2411)] {
        assert_eq!(bench.gateway.shown(unit, number), None, "{unit:?} {number}");
    }
}

// GW-APP-51, GW-APP-40, GW-APP-42
#[test]
fn values_have_the_unit_of_the_manual() {
    let mut bench = Bench::started(&governor(&[(827, -5)]));
    let now = bench.now;
    bench.gateway.set_supply(now, 7_250);
    bench.pass(10_000);
    let text = |unit, number| bench.gateway.shown(unit, number).unwrap().to_string();
    assert_eq!(text(Owner::Gateway, 3600), "7.25 V");
    assert_eq!(text(Owner::Gateway, 2411), "0002h");
    assert_eq!(text(Owner::Gateway, 3099), "0000h");
    assert_eq!(text(Owner::Gateway, 3865), "0.0 ms");
    assert_eq!(text(Owner::Gateway, 3897), "0200h");
    assert_eq!(text(Owner::Gateway, 12404), "1");
    assert_eq!(text(Owner::Gateway, 400), "1.0 s");
    assert_eq!((text(Owner::Governor, 827), text(Owner::Governor, 2031)), ("-5".into(), "1500".into()));
    let timer = bench.gateway.shown(Owner::Gateway, 3870).unwrap();
    assert_eq!((timer.quantity(), timer.quantity().per_unit()), (Quantity::Seconds, 1000));
}

// GW-APP-51, GW-APP-11
#[test]
fn errors_of_the_governor_are_its_own() {
    let settings = governor(&[(900, 1), (4900, 3)]);
    let mut bench = Bench::started(&settings);
    bench.pass(DC);
    let read = |bench: &Bench, numbers: [u16; 4]| numbers.map(|number| shown(bench, Owner::Governor, number));
    assert_eq!(read(&bench, [3005, 3006, 3070, 3071]), [Some(1), Some(0), Some(0), Some(0)]);
    let now = bench.now;
    bench.gateway.inject(now, Fault::GatewayCanBus1);
    assert_eq!(read(&bench, [3070, 3074, 12421, 12403]), [Some(0), Some(1), Some(1), Some(0)]);
    assert_eq!(shown(&bench, Owner::Gateway, 3070), Some(1));
    bench.gateway.inject(now, Fault::GovernorCanComm);
    assert_eq!(read(&bench, [3070, 3071, 12415, 12404]), [Some(0), Some(1), Some(1), Some(0)]);
}

// GW-APP-52
#[test]
fn the_pc_program_leaves_its_number() {
    let mut bench = Bench::new(&[]);
    let numbers = |bench: &Bench| [3850, 3851].map(|number| shown(bench, Owner::Gateway, number));
    assert_eq!(numbers(&bench), [Some(1), Some(0)], "nothing was stored yet");
    bench.gateway.connect_tool(4_711);
    assert_eq!(numbers(&bench), [Some(4_711), Some(0)]);
    bench.gateway.store(Owner::Governor);
    assert_eq!(numbers(&bench), [Some(4_711), Some(0)], "the other unit");
    bench.gateway.store(Owner::Gateway);
    bench.gateway.connect_tool(5);
    let now = bench.now;
    bench.gateway.reset(now, Owner::Gateway);
    bench.pass(300_000);
    assert_eq!(numbers(&bench), [Some(5), Some(4_711)], "it is kept");
}

// GW-APP-31, GW-APP-51
#[test]
fn a_full_stack_has_nothing_free() {
    let mut bench = Bench::new(&[]);
    let now = bench.now;
    bench.gateway.inject(now, Fault::Stack);
    assert_eq!(
        [3093, 3897, 3898].map(|number| shown(&bench, Owner::Gateway, number)),
        [Some(1), Some(0), Some(0)]
    );
}
