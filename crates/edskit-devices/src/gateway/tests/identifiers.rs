use super::*;
use edskit_types::{Claim, IdentifierRules, Party, PdoDirection};

/// Settings that make TPDO 5 to 16 active, whose identifiers follow.
fn free_tpdos_active() -> Vec<(Owner, u16, i32)> {
    let assigned = (5..=16).map(|tpdo| Parameter::tpdo_assignment(tpdo, 0).unwrap());
    let mut settings: Vec<_> =
        assigned.map(|parameter| (Owner::Governor, parameter.number(), 2000)).collect();
    settings.extend((16461..=16472).map(|number| (Owner::Governor, number, 100)));
    // Free identifiers that nothing else uses.
    settings
        .extend((16404..=16415).map(|number| (Owner::Gateway, number, 0x680 + i32::from(number - 16404))));
    settings
}

/// Settings that make every PDO active.
fn all_active() -> Vec<(Owner, u16, i32)> {
    let mut settings = free_tpdos_active();
    settings.extend(governor(&[(14401, 1), (14402, 1), (16400, 2000), (16460, 100)]));
    for (nth, channel) in [(0, 1), (1, 5), (2, 9)] {
        settings.extend(governor(&[(900 + nth, channel), (4900 + nth, 3)]));
    }
    settings
}

#[test]
fn predefined_identifiers() {
    // GW-CFG-12, 7.2.4 table 4
    for node in 1..=127 {
        let table = table(&gateway(&[(427, node)]));
        let ids = |pdos: &[Pdo]| pdos.iter().map(|pdo| pdo.can_id.raw() as i32 - node).collect::<Vec<_>>();
        assert_eq!(ids(&table.rpdos), [0x200, 0x300, 0x400, 0x500]);
        assert_eq!(ids(&table.tpdos[..4]), [0x180, 0x280, 0x380, 0x480]);
    }
}

/// 7.2.4, example: the identifiers of TPDO 5, 8, 12 and 16.
const EXAMPLE: [(u16, i32); 4] = [(16404, 0x282), (16407, 0x382), (16411, 0x003), (16415, 0x57F)];

fn example(node_id: i32) -> Vec<(Owner, u16, i32)> {
    let mut settings = free_tpdos_active();
    settings.extend(gateway(&EXAMPLE));
    settings.push((Owner::Gateway, 427, node_id));
    settings
}

#[test]
fn identifiers_of_the_example() {
    // GW-CFG-13, GW-CFG-14, GW-NOTE-19: 003h is accepted.
    let table = table(&example(1));
    let cob_id = |tpdo: usize| table.tpdos[tpdo - 1].cob_id().0;
    assert_eq!([5, 8, 12, 16].map(cob_id), [0x282, 0x382, 0x003, 0x57F]);
    assert!(conflicts(&table).is_empty());
    // What CiA 301 says of it.
    let mut claims = table.claims();
    let restricted = edskit_types::conflicts(claims.as_mut_slice(), &IdentifierRules::CIA_301);
    let restricted: Vec<String> = restricted.map(|conflict| conflict.to_string()).collect();
    assert_eq!(restricted, ["TPDO12 on 003h, which is restricted: 001h to 07Fh (reserved)"]);
}

#[test]
fn the_example_on_node_2_collides_with_tpdo_2() {
    // GW-CFG-15
    let mut settings = example(2);
    assert!(conflicts(&table(&settings)).is_empty(), "TPDO 2 is not active");
    settings.extend(governor(&[(14401, 1)]));
    assert_eq!(conflicts(&table(&settings)), ["TPDO5 and TPDO2 on 282h"]);
}

#[test]
fn the_example_on_node_127_collides_with_rpdo_4() {
    // GW-CFG-16
    let mut settings = example(127);
    assert!(conflicts(&table(&settings)).is_empty(), "RPDO 4 is not active");
    settings.extend(governor(&[(900, 9), (4900, 3)]));
    assert_eq!(conflicts(&table(&settings)), ["TPDO16 and RPDO4 on 57Fh"]);
    settings.push((Owner::Gateway, 427, 1));
    assert!(conflicts(&table(&settings)).is_empty(), "with node-ID 1 it passes");
}

#[test]
fn every_forbidden_identifier_is_found() {
    // GW-CFG-18, GW-CFG-19, GW-CFG-20, GW-CFG-21, GW-CFG-22, GW-CFG-23, GW-CFG-24, GW-CFG-25
    let forbidden = [
        (0x000, "NMT"),
        (0x080, "SYNC"),
        (0x100, "TIME"),
        (0x580 + 5, "SDO server response"),
        (0x600 + 5, "SDO server request"),
        (0x700 + 5, "heartbeat"),
        (0x700 + 9, "heartbeat of node 9"),
        (0x180 + 5, "TPDO1"),
        (0x480 + 5, "TPDO4"),
        (0x200 + 5, "RPDO1"),
        (0x500 + 5, "RPDO4"),
    ];
    let mut settings = all_active();
    settings.extend(gateway(&[(427, 5), (428, 9)]));
    assert_eq!(active(&table(&settings)).len(), 20);
    assert!(conflicts(&table(&settings)).is_empty());
    for tpdo in 5..=16 {
        let parameter = Parameter::tpdo_identifier(tpdo).unwrap();
        for (id, party) in forbidden {
            let mut settings = settings.clone();
            settings.push((Owner::Gateway, parameter.number(), id));
            let found = conflicts(&table(&settings));
            let expected = std::format!("TPDO{tpdo} and {party} on {id:03X}h");
            let reversed = std::format!("{party} and TPDO{tpdo} on {id:03X}h");
            assert!(
                found == [expected.as_str()] || found == [reversed.as_str()],
                "{found:?}, not {expected}"
            );
        }
        // GW-CFG-29: what belongs to other nodes is not looked at, nor are the ranges of CiA 301.
        for id in [0x001, 0x07F, 0x081, 0x0FF, 0x101, 0x180, 0x586, 0x606, 0x706, 0x780, 0x7E4, 0x7FF] {
            let mut settings = settings.clone();
            settings.push((Owner::Gateway, parameter.number(), id));
            assert!(conflicts(&table(&settings)).is_empty(), "TPDO{tpdo} {id:03X}h");
        }
    }
}

#[test]
fn node_ids_must_differ() {
    // GW-CFG-26
    let partners = |own| [0, 1, own, own % 127 + 1, 127];
    for (own, partner) in (1..=127).flat_map(|own| partners(own).map(|partner| (own, partner))) {
        let table = table(&gateway(&[(427, own), (428, partner)]));
        let expected = (own == partner)
            .then(|| std::format!("heartbeat of node {own} and heartbeat on {:03X}h", 0x700 + own));
        assert_eq!(conflicts(&table), Vec::from_iter(expected));
    }
}

#[test]
fn only_active_pdos_are_checked() {
    // GW-CFG-27: all identifiers at 000h, and nothing is active.
    assert!(conflicts(&table(&[])).is_empty());
    // GW-CFG-28: one of them becomes active.
    let settings = governor(&[(16404, 2000), (16461, 100)]);
    assert_eq!(conflicts(&table(&settings)), ["TPDO5 and NMT on 000h"]);
    let settings = governor(&[(16404, 2000)]);
    assert!(conflicts(&table(&settings)).is_empty(), "without a cycle time it is not");
}

#[test]
fn the_heartbeat_of_partner_0_is_taken() {
    // GW-NOTE-21, GW-CFG-25
    let mut settings = governor(&[(16404, 2000), (16461, 100)]);
    settings.extend(gateway(&[(16404, 0x700), (428, 0)]));
    assert_eq!(conflicts(&table(&settings)), ["TPDO5 and heartbeat of node 0 on 700h"]);
    settings.extend(gateway(&[(428, 2)]));
    assert!(conflicts(&table(&settings)).is_empty());
}

#[test]
fn all_claims_fit() {
    let table = table(&all_active());
    let mut claims = table.claims();
    let claims: &[Claim] = claims.as_mut_slice();
    assert_eq!(claims.len(), 24);
    let tpdo_16 = Party::Pdo { direction: PdoDirection::Transmit, number: 16 };
    assert!(claims.iter().any(|claim| claim.party == tpdo_16));
    assert_eq!(table.find(tpdo_16).map(|pdo| pdo.number), Some(16));
    assert_eq!(table.find(Party::Nmt), None);
}
