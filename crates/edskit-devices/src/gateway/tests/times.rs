use super::*;

/// 7.1.3, example.
#[test]
fn cycle_times_of_tpdos() {
    // GW-TIMING-06
    let mut settings: Vec<_> = (16460..=16472).map(|number| (Owner::Governor, number, 0)).collect();
    settings.extend(governor(&[(16460, 16), (16462, 200), (16472, 100)]));
    let configuration = configuration(&settings);
    for tpdo in 4..=16 {
        let expected = match tpdo {
            4 => Some((16, 1, 15_625)),
            6 => Some((200, 12, 187_500)),
            16 => Some((100, 6, 93_750)),
            _ => None,
        };
        let period = configuration.tpdo_cycle(tpdo);
        assert_eq!(period.map(|p| (p.setting_ms, p.cycles, p.micros())), expected, "TPDO{tpdo}");
    }
    // GW-TIMING-01: TPDO 1 to 3 have none.
    assert!((0..4).chain(17..20).all(|tpdo| configuration.tpdo_cycle(tpdo).is_none()));
}

/// 7.1.5, example.
#[test]
fn monitoring_times_of_rpdos() {
    // GW-TIMING-11, GW-TIMING-09, GW-TIMING-10, GW-NOTE-07
    let configuration = configuration(&governor(&[(16480, 0), (16481, 100), (16482, 200), (16483, 1000)]));
    let times = [1, 2, 3, 4].map(|rpdo| configuration.rpdo_monitoring(rpdo).map(|p| (p.cycles, p.micros())));
    assert_eq!(times, [None, Some((6, 93_750)), Some((12, 187_500)), Some((64, 1_000_000))]);
    assert_eq!(configuration.rpdo_monitoring(5), None);
}

/// 7.2.3, example.
#[test]
fn heartbeat_times() {
    // GW-TIMING-14, GW-HB-03, GW-HB-04
    let configuration = configuration(&gateway(&[(428, 127), (429, 1000), (430, 100)]));
    assert_eq!(configuration.partner_node_id(), 127);
    let own = configuration.heartbeat().unwrap();
    assert_eq!((own.cycles, own.micros()), (62, 992_000));
    let partner = configuration.heartbeat_monitoring().unwrap();
    assert_eq!((partner.cycles, partner.micros()), (6, 96_000));
    assert_eq!(Configuration::new().heartbeat(), None);
    assert_eq!(Configuration::new().heartbeat_monitoring(), None);
}

#[test]
fn the_formula_of_the_governor() {
    // GW-TIMING-02, GW-TIMING-03, GW-TIMING-05, GW-TIMING-07, GW-TIMING-08, GW-NOTE-06, GW-NOTE-08; GW-CFG-11: one
    // main cycle is the only minimum, for monitoring times too.
    assert_eq!(MainCycle::GOVERNOR.period(0), None);
    for setting in 1..=u16::MAX {
        let period = MainCycle::GOVERNOR.period(setting).unwrap();
        let (n, micros) = (u32::from(period.cycles), u32::from(setting) * 1000);
        assert!((1..=255).contains(&n));
        match setting {
            1..=15 => assert_eq!(n, 1),
            16..=3999 => assert!(n * 15_625 <= micros && micros < (n + 1) * 15_625, "{setting}"),
            4000.. => assert_eq!(n, 255),
            0 => unreachable!("the loop begins with 1"),
        }
        assert_eq!(period.is_capped, setting >= 4000, "{setting}");
        assert_eq!(period.setting_ms, setting);
    }
    assert_eq!(MainCycle::GOVERNOR.period(u16::MAX).unwrap().micros(), 3_984_375);
}

#[test]
fn the_formula_of_the_gateway() {
    // GW-TIMING-12, GW-TIMING-13, GW-NOTE-06, GW-NOTE-26
    assert_eq!(MainCycle::GATEWAY.period(0), None);
    for setting in 1..=u16::MAX {
        let period = MainCycle::GATEWAY.period(setting).unwrap();
        assert_eq!(period.cycles, (setting / 16).max(1), "{setting}");
        assert!(!period.is_capped, "{setting}");
    }
    assert_eq!(MainCycle::GATEWAY.period(u16::MAX).unwrap().micros(), 65_520_000);
}

#[test]
fn times_stand_in_the_table() {
    let mut settings = governor(&[(16400, 2000), (16460, 100), (16481, 100), (14401, 1)]);
    settings.extend(governor(&[(900, 1), (4900, 3)]));
    let table = table(&settings);
    assert_eq!(table.tpdos[3].period.map(Period::micros), Some(93_750));
    assert_eq!(table.rpdos[1].period.map(Period::micros), Some(93_750));
    assert_eq!((table.tpdos[0].period, table.rpdos[0].period), (None, None));
}
