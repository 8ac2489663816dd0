use super::*;
use std::collections::BTreeSet;
use std::format;

#[test]
fn numbers_and_names_find_their_parameter() {
    let mut seen = BTreeSet::new();
    for (position, parameter) in parameters().enumerate() {
        assert_eq!(parameter.position(), position);
        assert_eq!(Parameter::find(parameter.owner(), parameter.number()), Some(parameter));
        assert!(seen.insert((parameter.owner(), parameter.number())), "{parameter:?} stands twice");
        assert!(parameter.values().contain(parameter.default_value()), "{parameter:?}");
        if let Some(name) = parameter.name() {
            let found = Parameter::by_name(parameter.owner(), &name.to_string()).unwrap();
            // The manual gives the governor's bit rate two numbers (GW-NOTE-37).
            let doubled = [416, 4416].contains(&parameter.number()) && parameter.owner() == Owner::Governor;
            assert_eq!(found == parameter, !doubled, "{parameter:?}");
        }
    }
    assert_eq!(Parameter::find(Owner::Gateway, 14401), None);
    assert_eq!(Parameter::find(Owner::Governor, 427), None);
    assert_eq!(Parameter::by_name(Owner::Gateway, "CanOpenMyNodeI"), None);
    assert_eq!(Parameter::by_name(Owner::Gateway, "CanOpenMyNodeID2"), None);
}

/// What the lists print: number, name, level, range.
#[test]
fn lists_of_the_manual() {
    let shown = |owner, number| {
        let parameter = Parameter::find(owner, number).unwrap();
        let level = parameter.level().map_or("-".to_string(), |level| level.to_string());
        format!("{parameter} | {level} | {}", parameter.allowed())
    };
    let gateway = [
        // GW-CFG-31, GW-CFG-32, GW-CFG-33, GW-CFG-34
        "P400 CanStartTimeOutDelay | 6 | 0.0 to 100.0 s",
        "P401 CanMyNodeNumber | 6 | 1 to 31",
        "P402 CanDCNodeNumber | 6 | 1 to 31",
        "P4400 HzmCanCommDCOn | 6 | 0 or 1",
        // GW-CFG-35, GW-CFG-36, GW-CFG-39
        "P416 HzmCanBaudrate | 6 | 125, 250, 500 or 1000 kbit/s",
        "P4416 HzmCanSegmOrBaudrate | 6 | 0 or 1",
        "P410 HzmCanPrescaler | 6 | 0 to 63",
        "P411 HzmCanSyncJumpWidth | 6 | 0 to 3",
        "P412 HzmCanSamplingMode | 6 | 0 or 1",
        "P413 HzmCanPhaseSegment1 | 6 | 0 to 7",
        "P414 HzmCanPhaseSegment2 | 6 | 0 to 7",
        "P415 HzmCanPropSegment | 6 | 0 to 7",
        // GW-CFG-37, GW-CFG-38, GW-CFG-39, GW-NOTE-43
        "P426 CanOpenBaudrate | 6 | 125, 250, 500 or 1000 kbit/s",
        "P4426 CanOpSegmOrBaudrate | 6 | 0 or 1",
        "P420 CanOpenPrescaler | 6 | 0 to 63",
        "P421 CanOpenSyncJumpWidth | 6 | 0 to 3",
        "P422 CanOpenSamplingMode | 6 | 0 or 1",
        "P423 CanOpenPhaseSegment1 | 6 | 0 to 7",
        "P424 CanOpenPhaseSegment2 | 6 | 0 to 7",
        "P425 CanOpenPropSegment | 6 | 0 to 7",
        // GW-CFG-40
        "P1800 Level | 1 | 1 to 7",
        // GW-CFG-41
        "P427 CanOpenMyNodeID | 6 | 1 to 127",
        "P428 CanOpenPartnerNodeID | 6 | 0 to 127",
        "P429 CanOpHeartBeatTxTime | 6 | 0 to 65535 ms",
        "P430 CanOpHeartBeatRxTime | 6 | 0 to 65535 ms",
        // GW-CFG-13, GW-CFG-42
        "P16404 CanOpTPDO5-16ID(0) | 6 | 000h to 7FFh",
        "P16415 CanOpTPDO5-16ID(11) | 6 | 000h to 7FFh",
    ];
    let governor = [
        "P403 CanCMNodeNumber | - | 1 to 31",
        "P4406 CanCommCMOn | - | 0 or 1",
        // GW-CFG-01
        "P14401 CanOpenSendErrors | - | 0 or 1",
        "P14402 CanOpenSendStatus | - | 0 or 1",
        // GW-PDO-12, GW-NOTE-20
        "P16400 CanOpTPDO4Assign(0) | - | 0 to 65535",
        "P16404 CanOpTPDO5Assign(0) | - | 0 to 65535",
        "P16415 CanOpTPDO7Assign(3) | - | 0 to 65535",
        "P16451 CanOpTPDO16Assign(3) | - | 0 to 65535",
        // GW-TIMING-04, GW-TIMING-09
        "P16460 CanOpTPDO4-16Cyc(0) | - | 0 to 65535 ms",
        "P16472 CanOpTPDO4-16Cyc(12) | - | 0 to 65535 ms",
        "P16480 CanOpRPDO1-4Cyc(0) | - | 0 to 65535 ms",
        "P16483 CanOpRPDO1-4Cyc(3) | - | 0 to 65535 ms",
        // GW-CFG-04, GW-CFG-07, GW-NOTE-09, GW-NOTE-10
        "P811 FunctIdleSpeed | - | -32768 to 32767",
        "P812 | - | -32768 to 32767",
        "P827 FunctSetpoint2Or1 | - | -32768 to 32767",
        "P4835 Type_LoadEnable | - | 0 to 255",
        "P917 AssignIn_CurrentLoad | - | -32768 to 32767",
        "P4901 ChanType_Setp2Ext | - | 0 to 255",
    ];
    for (owner, lines) in [(Owner::Gateway, &gateway[..]), (Owner::Governor, &governor[..])] {
        for line in lines {
            let number = line[1..].split(' ').next().unwrap().parse().unwrap();
            assert_eq!(shown(owner, number), *line);
        }
    }
    assert_eq!(parameters().filter(|parameter| parameter.owner() == Owner::Gateway).count(), 37);
}

#[test]
fn series_of_pdos() {
    let number = |parameter: Option<Parameter>| parameter.map(Parameter::number);
    // GW-CFG-13: P = 16404 + t - 5. GW-TIMING-04: P = 16460 + t - 4. GW-PDO-12: P = 16400 + 4 (t - 4) + w.
    for tpdo in 0..=20_u8 {
        let nth = u16::from(tpdo);
        assert_eq!(number(Parameter::tpdo_identifier(tpdo)), (5..=16).contains(&nth).then(|| 16399 + nth));
        assert_eq!(number(Parameter::tpdo_cycle(tpdo)), (4..=16).contains(&nth).then(|| 16456 + nth));
        for word in 0..6 {
            let expected = ((4..=16).contains(&nth) && word < 4).then(|| 16384 + 4 * nth + u16::from(word));
            assert_eq!(number(Parameter::tpdo_assignment(tpdo, word)), expected, "TPDO{tpdo} {word}");
        }
        assert_eq!(number(Parameter::rpdo_monitoring(tpdo)), (1..=4).contains(&nth).then(|| 16479 + nth));
    }
}

#[test]
fn values_out_of_range_are_refused_and_change_nothing() {
    let mut configuration = Configuration::new();
    let mut refused = |parameter: Parameter, value| {
        let before = configuration.get(parameter);
        let error = configuration.set(parameter, value).unwrap_err();
        assert_eq!(configuration.get(parameter), before);
        error.to_string()
    };
    // GW-CFG-41
    assert_eq!(refused(Parameter::MY_NODE_ID, 0), "P427 CanOpenMyNodeID cannot be 0, only 1 to 127");
    assert_eq!(refused(Parameter::MY_NODE_ID, 128), "P427 CanOpenMyNodeID cannot be 128, only 1 to 127");
    assert_eq!(
        refused(Parameter::PARTNER_NODE_ID, -1),
        "P428 CanOpenPartnerNodeID cannot be -1, only 0 to 127"
    );
    // GW-CFG-39: the rates in between are not supported.
    assert_eq!(
        refused(Parameter::BIT_RATE, 800),
        "P426 CanOpenBaudrate cannot be 800 kbit/s, only 125, 250, 500 or 1000 kbit/s"
    );
    // GW-CFG-42
    let identifier = Parameter::tpdo_identifier(5).unwrap();
    assert_eq!(refused(identifier, 0x800), "P16404 CanOpTPDO5-16ID(0) cannot be 800h, only 000h to 7FFh");
    let delay = Parameter::find(Owner::Gateway, 400).unwrap();
    assert_eq!(refused(delay, 100_001), "P400 CanStartTimeOutDelay cannot be 100.001 s, only 0.0 to 100.0 s");
    assert_eq!(configuration, Configuration::default());
}

#[test]
fn times_in_seconds_have_as_many_digits_as_they_need() {
    let delay = Parameter::find(Owner::Gateway, 400).unwrap();
    let shown = [0, 1000, 1500, 1250, 1234, -50].map(|value| delay.amount(value).to_string());
    assert_eq!(shown, ["0.0 s", "1.0 s", "1.5 s", "1.25 s", "1.234 s", "-0.05 s"]);
}

/// 7.2.2, example.
#[test]
fn can_open_set_up() {
    // GW-CFG-43
    let configuration = configuration(&gateway(&[(427, 1), (426, 125), (4426, 0)]));
    assert_eq!(configuration.node_id().get(), 1);
    assert_eq!(configuration.bit_rate().map(|rate| rate.kbit_per_s()), Some(125));
    // GW-GAP-13
    assert_eq!(configuration, Configuration::new());
}

#[test]
fn manual_bit_timing_hides_the_bit_rate() {
    // GW-CFG-37, GW-CFG-38, GW-NOTE-41
    let configuration = configuration(&gateway(&[(4426, 1), (426, 500), (420, 63), (421, 3)]));
    assert_eq!(configuration.bit_rate(), None);
}

/// 7.1.1 and 7.2.1, examples.
#[test]
fn heinzmann_bus_set_up() {
    // GW-CFG-44, GW-CFG-45
    let mut settings = gateway(&[(400, 1000), (401, 1), (402, 1), (416, 250), (4400, 1), (4416, 0)]);
    settings.extend(governor(&[(400, 1000), (401, 1), (403, 1), (4406, 1), (409, 250), (4409, 0)]));
    assert_eq!(configuration(&settings), Configuration::new());
}
