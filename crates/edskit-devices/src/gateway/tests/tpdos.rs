use super::*;
use edskit_types::CobId;

/// 7.1.2.1, example.
#[test]
fn errors_are_sent_and_the_status_is_not() {
    // GW-CFG-02, GW-PDO-01, GW-PDO-02
    let table = table(&governor(&[(14401, 1), (14402, 0)]));
    assert_eq!(active(&table), ["TPDO1", "TPDO2"]);
    assert_eq!(table.tpdos[0].activity, Activity::Selected);
    assert_eq!(table.tpdos[2].activity, Activity::NotSelected);
    assert_eq!(table.object_sizes().digital_outputs, 6);
}

#[test]
fn content_of_the_binary_tpdos() {
    // GW-CFG-01, GW-PDO-03, GW-PDO-13, GW-NOTE-04
    let table = table(&governor(&[(14401, 1), (14402, 1)]));
    let [first, second, third, ..] = &table.tpdos;
    assert_eq!([first, second, third].map(Pdo::bytes), [8, 4, 2]);
    assert_eq!(mapping(first), ["20000110h", "20000210h", "20000310h", "20000410h"]);
    assert_eq!(mapping(second), ["20000510h", "20000610h"]);
    assert_eq!(mapping(third), ["20000710h"]);
    assert_eq!(first.words()[3].source, Source::Errors { first: 48 });
    assert_eq!(second.words()[1].source, Source::Errors { first: 80 });
    assert_eq!(third.words()[0].source, Source::EngineStatus);
    // GW-OD-13: the engine status exists only where it is sent.
    assert_eq!(table.object_sizes().digital_outputs, 7);
}

/// 7.1.2.2, example.
#[test]
fn analogue_tpdos() {
    let mut settings = governor(&[(16400, 2000), (16401, 2031), (16402, 2300), (16403, 2330)]);
    settings.extend(governor(&[(16448, 2905), (16449, 2908), (16450, 2917), (16451, 0)]));
    settings.extend((16404..=16447).map(|number| (Owner::Governor, number, 0)));
    settings.extend(governor(&[(16460, 16), (16472, 100)]));
    let table = table(&settings);
    // GW-PDO-04, GW-PDO-10
    let fourth = &table.tpdos[3];
    assert_eq!((fourth.bytes(), signals(fourth)), (8, [2000, 2031, 2300, 2330].to_vec()));
    // GW-PDO-11
    let last = &table.tpdos[15];
    assert_eq!((last.bytes(), signals(last)), (6, [2905, 2908, 2917].to_vec()));
    assert_eq!(active(&table), ["TPDO4", "TPDO16"]);
    assert!(table.tpdos[4..15].iter().all(|pdo| pdo.activity == Activity::NeitherDataNorCycle));
    assert!(table.tpdos[4..15].iter().all(|pdo| pdo.words().is_empty() && pdo.bytes() == 0));
    // GW-NOTE-03: entries are counted as they come, those without and those with sign separately.
    assert_eq!(mapping(fourth), ["20010110h", "20010210h", "20010310h", "20010410h"]);
    assert_eq!(mapping(last), ["20010510h", "20020110h", "20010610h"]);
    let sizes = table.object_sizes();
    assert_eq!((sizes.unsigned_analog_outputs, sizes.signed_analog_outputs), (6, 1));
}

/// A governor with parameters 1, 3 and 4, and perhaps 2.
struct Four(Option<SignalType>);

impl Signals for Four {
    fn signal_type(&self, number: u16) -> Option<SignalType> {
        match number {
            1 => Some(SignalType::U16),
            2 => self.0,
            3 => Some(SignalType::I8),
            4 => Some(SignalType::U8),
            _ => None,
        }
    }
}

/// 7.1.2.2, the words before the example.
#[test]
fn invalid_assignments_are_left_out_and_the_rest_moves_up() {
    let assigned = governor(&[(16400, 1), (16401, 2), (16402, 3), (16403, 4), (16460, 100)]);
    // GW-PDO-08, GW-PDO-09, GW-PDO-05: parameter 2 does not exist, is a single bit, or is not assigned.
    let mut unassigned = assigned.clone();
    unassigned[1].2 = 0;
    let cases = [
        (&assigned, Four(None)),
        (&assigned, Four(Some(SignalType::Bit))),
        (&unassigned, Four(Some(SignalType::U16))),
    ];
    for (settings, parameters) in cases {
        let table = PdoTable::new(&configuration(settings), &parameters);
        let fourth = &table.tpdos[3];
        assert_eq!((fourth.bytes(), signals(fourth)), (6, [1, 3, 4].to_vec()));
        // GW-PDO-05, GW-PDO-06: 8 bits are widened and keep their sign.
        assert_eq!(mapping(fourth), ["20010110h", "20020110h", "20010210h"]);
    }
    let table = PdoTable::new(&configuration(&assigned), &Four(Some(SignalType::I16)));
    assert_eq!(mapping(&table.tpdos[3]), ["20010110h", "20020110h", "20020210h", "20010210h"]);
}

#[test]
fn data_and_cycle_time_make_an_analogue_tpdo_active() {
    // GW-CFG-03
    let activity = |settings: &[(u16, i32)]| table(&governor(settings)).tpdos[4].activity;
    assert_eq!(activity(&[]), Activity::NeitherDataNorCycle);
    assert_eq!(activity(&[(16464, 100)]), Activity::NeitherDataNorCycle, "P16464 is the cycle of TPDO 8");
    assert_eq!(activity(&[(16461, 100)]), Activity::NoData);
    assert_eq!(activity(&[(16461, 100), (16404, 999)]), Activity::NoData, "there is no parameter 999");
    assert_eq!(activity(&[(16404, 2000)]), Activity::NoCycle);
    assert_eq!(activity(&[(16407, 2000), (16461, 1)]), Activity::DataAndCycle);
}

/// 13 TPDOs of 4 words fill 2001h (GW-PDO-06).
#[test]
fn all_words_in_use() {
    let mut settings: Vec<_> = (16400..=16451).map(|number| (Owner::Governor, number, 2000)).collect();
    settings.extend((16460..=16472).map(|number| (Owner::Governor, number, 100)));
    let table = table(&settings);
    assert_eq!(table.object_sizes().unsigned_analog_outputs, 52);
    assert_eq!(mapping(&table.tpdos[15])[3], "20013410h");
    assert_eq!(active(&table).len(), 13);
}

#[test]
fn cob_ids_of_the_object_dictionary() {
    let inactive = table(&gateway(&[(427, 5), (16404, 0x282)]));
    // GW-OD-08, GW-OD-11, GW-NOTE-18, GW-GAP-08: bit 31 is set, and for TPDO 5 to 16 the rest is the node-ID.
    assert_eq!(inactive.tpdos[0].cob_id(), CobId(0x8000_0185));
    assert_eq!(inactive.tpdos[4].cob_id(), CobId(0x8000_0005));
    assert_eq!(inactive.rpdos[3].cob_id(), CobId(0x8000_0505));
    let mut settings = gateway(&[(427, 5), (16404, 0x282)]);
    settings.extend(governor(&[(16404, 2000), (16461, 100), (14401, 1)]));
    let active = table(&settings);
    assert_eq!(active.tpdos[0].cob_id(), CobId(0x0000_0185));
    assert_eq!(active.tpdos[4].cob_id(), CobId(0x0000_0282));
}

#[test]
fn parameters_behind_a_tpdo() {
    let table = table(&[]);
    let numbers = |pdo: &Pdo| pdo.activity_parameters().map(Parameter::number).collect::<Vec<_>>();
    assert_eq!(numbers(&table.tpdos[1]), [14401]);
    assert_eq!(numbers(&table.tpdos[2]), [14402]);
    assert_eq!(numbers(&table.tpdos[3]), [16400, 16401, 16402, 16403, 16460]);
    assert_eq!(numbers(&table.rpdos[3]), [0; 0]);
    assert_eq!(table.tpdos[3].identifier_parameter(), Parameter::MY_NODE_ID);
    assert_eq!(table.tpdos[4].identifier_parameter().number(), 16404);
    assert_eq!(table.tpdos[4].period_parameter().map(Parameter::number), Some(16461));
    assert_eq!(table.rpdos[3].period_parameter().map(Parameter::number), Some(16483));
    assert_eq!(table.rpdos[3].identifier_parameter(), Parameter::MY_NODE_ID);
    assert_eq!(table.tpdos[2].period_parameter(), None);
}
