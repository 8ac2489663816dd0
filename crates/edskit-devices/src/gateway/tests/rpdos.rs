use super::*;

/// 7.1.4.1, example.
#[test]
fn switch_functions_from_rpdo_1() {
    // GW-CFG-06, GW-NOTE-09
    let settings = governor(&[(827, 1), (835, -5), (4827, 3), (4835, 3)]);
    let configuration = configuration(&settings);
    let functions: Vec<(u16, Target)> =
        configuration.switch_functions().map(|input| (input.assignment.number(), input.target)).collect();
    assert_eq!(
        functions,
        [
            (827, Target::Bit { number: 1, low_active: false }),
            (835, Target::Bit { number: 5, low_active: true })
        ]
    );
    let table = table(&settings);
    assert_eq!(active(&table), ["RPDO1"]);
    // GW-CFG-09, GW-PDO-17: switch functions alone need one entry.
    assert_eq!(table.rpdos[0].activity, Activity::SwitchFunctions);
    assert_eq!(mapping(&table.rpdos[0]), ["20030110h"]);
    assert_eq!(table.object_sizes().digital_inputs, 1);
}

/// 7.1.4.2, example.
#[test]
fn sensors_from_rpdo_2_to_4() {
    // GW-CFG-08, GW-NOTE-10
    let assigned = [(900, 1), (901, 2), (906, 7), (917, 12)];
    let mut settings = governor(&assigned);
    settings.extend(governor(&[(4900, 3), (4901, 3), (4906, 3), (4917, 3)]));
    let configuration = configuration(&settings);
    let sensors: Vec<(u16, Target)> =
        configuration.sensors().map(|input| (input.assignment.number(), input.target)).collect();
    assert_eq!(sensors, assigned.map(|(number, channel)| (number, Target::Channel(channel as u8))));
    let table = table(&settings);
    assert_eq!(active(&table), ["RPDO1", "RPDO2", "RPDO3", "RPDO4"]);
    let [flags, second, third, fourth] = &table.rpdos;
    // GW-CFG-09, GW-CFG-10, GW-APP-07
    assert_eq!(flags.activity, Activity::SensorFlags);
    assert_eq!(second.activity, Activity::Sensors);
    // GW-PDO-14, GW-PDO-17
    assert_eq!(mapping(flags), ["20030110h", "00060010h", "20030210h"]);
    assert_eq!(flags.words()[2].source, Source::SensorFlags);
    // GW-PDO-15, GW-PDO-16, GW-PDO-18, GW-NOTE-13
    assert_eq!(mapping(second), ["20040110h", "20040210h"]);
    assert_eq!(mapping(third), ["00060010h", "00060010h", "20040710h"]);
    assert_eq!(mapping(fourth), ["00060010h", "00060010h", "00060010h", "20040C10h"]);
    assert_eq!(third.words()[2].source, Source::Sensor { channel: 7 });
    assert_eq!([flags, second, third, fourth].map(Pdo::bytes), [6, 4, 6, 8]);
    let sizes = table.object_sizes();
    assert_eq!((sizes.digital_inputs, sizes.analog_inputs), (2, 12));
}

#[test]
fn only_the_type_canopen_counts() {
    // GW-CFG-04, GW-CFG-07
    for kind in (0..=255).filter(|kind| *kind != 3) {
        let settings = governor(&[(811, 1), (4811, kind), (900, 1), (4900, kind)]);
        assert!(active(&table(&settings)).is_empty(), "{kind}");
    }
}

#[test]
fn unassigned_and_impossible_inputs_make_nothing_active() {
    // GW-CFG-04
    let targets = |settings: &[(u16, i32)]| {
        let configuration = configuration(&governor(settings));
        let inputs = configuration.switch_functions().chain(configuration.sensors());
        inputs.map(|input| input.target).collect::<Vec<_>>()
    };
    assert_eq!(targets(&[(4811, 3)]), [Target::Unassigned]);
    assert_eq!(targets(&[(811, 17), (4811, 3)]), [Target::Nowhere(17)]);
    assert_eq!(targets(&[(811, -17), (4811, 3)]), [Target::Nowhere(-17)]);
    assert_eq!(targets(&[(811, -16), (4811, 3)]), [Target::Bit { number: 16, low_active: true }]);
    assert_eq!(targets(&[(999, 13), (4999, 3)]), [Target::Nowhere(13)]);
    assert_eq!(targets(&[(999, -1), (4999, 3)]), [Target::Nowhere(-1)]);
    let settings = governor(&[(4811, 3), (812, 17), (4812, 3), (4900, 3), (901, 13), (4901, 3)]);
    let table = table(&settings);
    assert!(active(&table).is_empty());
    assert_eq!([0, 1].map(|nth| table.rpdos[nth].activity), [Activity::NoInputs, Activity::NoSensors]);
}

#[test]
fn the_engine_stop_is_no_canopen_function() {
    // GW-CFG-05
    let settings = governor(&[(810, 1), (4810, 3)]);
    assert!(configuration(&settings).engine_stop_from_canopen());
    assert!(active(&table(&settings)).is_empty());
    assert!(!Configuration::new().engine_stop_from_canopen());
}

#[test]
fn both_kinds_of_inputs() {
    // GW-CFG-09
    let table = table(&governor(&[(811, 16), (4811, 3), (903, 4), (4903, 3)]));
    assert_eq!(table.rpdos[0].activity, Activity::SwitchFunctionsAndSensorFlags);
    assert_eq!(active(&table), ["RPDO1", "RPDO2"]);
    assert_eq!(table.rpdos[1].bytes(), 8);
}
