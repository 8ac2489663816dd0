use super::*;
use crate::{CanId, NodeId, PdoDirection};
use std::collections::{BTreeMap, BTreeSet};
use std::string::{String, ToString};
use std::vec;
use std::vec::Vec;

const NO_RULES: IdentifierRules<'static> =
    IdentifierRules { restricted: &[], reserved: &[], rpdos_may_share: false };

fn standard(id: u16) -> CanId {
    CanId::standard(id).unwrap()
}

fn tpdo(number: u16) -> Party {
    Party::Pdo { direction: PdoDirection::Transmit, number }
}

fn rpdo(number: u16) -> Party {
    Party::Pdo { direction: PdoDirection::Receive, number }
}

fn server(number: u8, message: SdoMessage) -> Party {
    Party::Sdo { role: SdoRole::Server, number, message }
}

fn claim(can_id: u16, party: Party) -> Claim {
    Claim { can_id: standard(can_id), party }
}

fn found(claims: &[Claim], rules: &IdentifierRules<'_>) -> Vec<String> {
    conflicts(&mut claims.to_vec(), rules).map(|conflict| conflict.to_string()).collect()
}

#[test]
fn the_predefined_connection_set() {
    let node = NodeId::new(5).unwrap();
    let id = |party: Party| party.predefined_can_id(node).map(CanId::raw);
    assert_eq!([1, 2, 3, 4].map(|n| id(tpdo(n)).unwrap()), [0x185, 0x285, 0x385, 0x485]);
    assert_eq!([1, 2, 3, 4].map(|n| id(rpdo(n)).unwrap()), [0x205, 0x305, 0x405, 0x505]);
    assert_eq!([tpdo(0), tpdo(5), rpdo(0), rpdo(5), rpdo(512)].map(id), [None; 5]);
    assert_eq!([Party::Nmt, Party::Sync, Party::Time, Party::Emcy].map(id), [0, 0x80, 0x100, 0x85].map(Some));
    assert_eq!(id(server(1, SdoMessage::Response)), Some(0x585));
    assert_eq!(id(server(1, SdoMessage::Request)), Some(0x605));
    assert_eq!(id(server(2, SdoMessage::Request)), None);
    assert_eq!(id(Party::Sdo { role: SdoRole::Client, number: 1, message: SdoMessage::Request }), None);
    assert_eq!(
        [Party::Heartbeat, Party::HeartbeatOf(127), Party::HeartbeatOf(0)].map(id),
        [0x705, 0x77F, 0x700].map(Some)
    );
    assert_eq!([Party::HeartbeatOf(128), Party::EmcyOf(0), Party::EmcyOf(128)].map(id), [None; 3]);
    assert_eq!(
        [Party::EmcyOf(127), Party::LssRequest, Party::LssResponse].map(id),
        [0xFF, 0x7E5, 0x7E4].map(Some)
    );
    assert_eq!(tpdo(4).predefined_can_id(NodeId::MAX), Some(standard(0x4FF)));
}

#[test]
fn names() {
    let names = [
        (Party::Nmt, "NMT"),
        (Party::EmcyOf(3), "EMCY of node 3"),
        (server(1, SdoMessage::Request), "SDO server request"),
        (server(2, SdoMessage::Response), "SDO server 2 response"),
        (
            Party::Sdo { role: SdoRole::Client, number: 1, message: SdoMessage::Request },
            "SDO client 1 request",
        ),
        (Party::Heartbeat, "heartbeat"),
        (Party::HeartbeatOf(127), "heartbeat of node 127"),
        (rpdo(512), "RPDO512"),
    ];
    for (party, name) in names {
        assert_eq!(party.to_string(), name);
    }
    assert_eq!(claim(0x282, tpdo(5)).to_string(), "TPDO5 on 282h");
}

#[test]
fn restricted_can_ids_of_cia_301_are_exactly_these() {
    let restricted = |id: u16| IdentifierRules::CIA_301.restriction(standard(id)).is_some();
    let free: Vec<u16> = (0..=0x7FF).filter(|&id| !restricted(id)).collect();
    let expected = (0x080..=0x100).chain(0x181..=0x580).chain([0x600]).chain(0x680..=0x6DF).chain([0x700]);
    assert_eq!(free, expected.collect::<Vec<u16>>());
    let long = CanId::extended(0x003).unwrap();
    assert_eq!(IdentifierRules::CIA_301.restriction(long), None);
}

#[test]
fn restrictions_bind_what_is_configurable() {
    let client = Party::Sdo { role: SdoRole::Client, number: 1, message: SdoMessage::Request };
    let bound = [tpdo(1), rpdo(1), Party::Sync, Party::Time, Party::Emcy, server(2, SdoMessage::Request)];
    for party in bound {
        assert_eq!(found(&[claim(0x605, party)], &IdentifierRules::CIA_301).len(), 1, "{party}");
    }
    let free = [
        Party::Nmt,
        server(1, SdoMessage::Request),
        client,
        Party::Heartbeat,
        Party::HeartbeatOf(5),
        Party::LssRequest,
    ];
    for party in free {
        assert!(found(&[claim(0x605, party)], &IdentifierRules::CIA_301).is_empty(), "{party}");
    }
}

#[test]
fn the_predefined_set_of_a_node_is_free_of_conflicts() {
    for id in 1..=127 {
        let node = NodeId::new(id).unwrap();
        let pdos = (1..=4).flat_map(|number| [tpdo(number), rpdo(number)]);
        let services = [
            Party::Nmt,
            Party::Sync,
            Party::Time,
            Party::Emcy,
            server(1, SdoMessage::Request),
            server(1, SdoMessage::Response),
            Party::Heartbeat,
            Party::LssRequest,
            Party::LssResponse,
        ];
        let partners = (1..=127).filter(|&other| other != id);
        let partners = partners.flat_map(|other| [Party::HeartbeatOf(other), Party::EmcyOf(other)]);
        let all = pdos.chain(services).chain(partners);
        let claims: Vec<Claim> = all.map(|party| Claim::predefined(party, node).unwrap()).collect();
        assert!(found(&claims, &IdentifierRules::CIA_301).is_empty(), "{id}");
    }
}

#[test]
fn both_parties_are_named_and_the_pdo_comes_first() {
    let node = NodeId::new(1).unwrap();
    let heartbeat = Claim::predefined(Party::Heartbeat, node).unwrap();
    for claims in [[heartbeat, claim(0x701, tpdo(5))], [claim(0x701, tpdo(5)), heartbeat]] {
        assert_eq!(found(&claims, &NO_RULES), ["TPDO5 and heartbeat on 701h"]);
    }
    assert_eq!(
        found(&[claim(0x200, rpdo(1)), claim(0x200, tpdo(1))], &NO_RULES),
        ["TPDO1 and RPDO1 on 200h"]
    );
}

#[test]
fn reserved_can_ids_are_taken_without_a_claim() {
    let reserved = [claim(0x080, Party::Sync), claim(0x100, Party::Time)];
    let rules = IdentifierRules { reserved: &reserved, ..NO_RULES };
    let claims =
        [claim(0x080, Party::Sync), claim(0x080, rpdo(2)), claim(0x100, tpdo(6)), claim(0x101, tpdo(7))];
    assert_eq!(found(&claims, &rules), ["RPDO2 and SYNC on 080h", "TPDO6 and TIME on 100h"]);
    assert_eq!(found(&claims[1..], &rules), ["RPDO2 and SYNC on 080h", "TPDO6 and TIME on 100h"]);
}

#[test]
fn rpdos_share_where_the_rules_allow_it() {
    let claims = [claim(0x205, rpdo(1)), claim(0x205, rpdo(2))];
    assert_eq!(found(&claims, &NO_RULES), ["RPDO2 and RPDO1 on 205h"]);
    assert!(found(&claims, &IdentifierRules::CIA_301).is_empty());
    let claims = [claims[0], claims[1], claim(0x205, tpdo(9))];
    let expected = ["TPDO9 and RPDO1 on 205h", "TPDO9 and RPDO2 on 205h"];
    assert_eq!(found(&claims, &IdentifierRules::CIA_301), expected);
}

#[test]
fn the_same_claim_twice_is_one_claim() {
    let twice =
        [claim(0x705, Party::HeartbeatOf(5)), claim(0x705, Party::HeartbeatOf(5)), claim(0x7F0, tpdo(1))];
    let twice = [twice[0], twice[1], twice[2], twice[2]];
    assert_eq!(found(&twice, &NO_RULES), Vec::<String>::new());
    assert_eq!(found(&twice, &IdentifierRules::CIA_301).len(), 1);
}

#[test]
fn the_width_makes_another_identifier() {
    let long = Claim { can_id: CanId::extended(0x282).unwrap(), party: tpdo(5) };
    assert!(found(&[long, claim(0x282, tpdo(2))], &NO_RULES).is_empty());
    let other = Claim { party: tpdo(6), ..long };
    assert_eq!(found(&[long, other], &NO_RULES), ["TPDO6 and TPDO5 on 00000282h"]);
}

#[test]
fn a_thousand_pdos_on_one_identifier_give_one_conflict_each() {
    let all = (1..=512).flat_map(|number| [tpdo(number), rpdo(number)]);
    let mut claims: Vec<Claim> = all.map(|party| claim(0x281, party)).collect();
    let named: BTreeSet<Party> = conflicts(&mut claims, &NO_RULES)
        .flat_map(|conflict| match conflict.with {
            Opponent::Party(other) => [conflict.party, other],
            Opponent::Restricted(_) => [conflict.party; 2],
        })
        .collect();
    assert_eq!(named.len(), 1024);
    assert_eq!(conflicts(&mut claims, &NO_RULES).count(), 1023);
    assert_eq!(conflicts(&mut claims, &IdentifierRules::CIA_301).count(), 1023, "each RPDO meets a TPDO");
}

/// Compares with the obvious check of each pair over many small lists.
#[test]
fn agrees_with_a_comparison_of_all_pairs() {
    let parties = [
        tpdo(1),
        tpdo(2),
        tpdo(7),
        rpdo(1),
        rpdo(2),
        rpdo(9),
        Party::Sync,
        Party::Heartbeat,
        Party::HeartbeatOf(3),
    ];
    let ids = [0x080, 0x181, 0x282, 0x701, 0x77F];
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut next = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    for rules in [NO_RULES, IdentifierRules { rpdos_may_share: true, ..NO_RULES }] {
        for _ in 0..5_000 {
            let claims: Vec<Claim> = vec![(); next(8)]
                .iter()
                .map(|()| claim(ids[next(ids.len())], parties[next(parties.len())]))
                .collect();
            let collide = |a: &Claim, b: &Claim| {
                let both_rpdos = a.party.is_rpdo() && b.party.is_rpdo();
                a.can_id == b.can_id && a.party != b.party && !(rules.rpdos_may_share && both_rpdos)
            };
            let mut expected: BTreeMap<CanId, BTreeSet<Party>> = BTreeMap::new();
            for a in &claims {
                for b in claims.iter().filter(|b| collide(a, b)) {
                    expected.entry(a.can_id).or_default().extend([a.party, b.party]);
                }
            }
            let mut named: BTreeMap<CanId, BTreeSet<Party>> = BTreeMap::new();
            let mut sorted = claims.clone();
            for conflict in conflicts(&mut sorted, &rules) {
                let Opponent::Party(other) = conflict.with else { panic!("no ranges are restricted") };
                assert!(
                    collide(
                        &Claim { can_id: conflict.can_id, party: conflict.party },
                        &Claim { can_id: conflict.can_id, party: other }
                    ),
                    "{conflict}"
                );
                named.entry(conflict.can_id).or_default().extend([conflict.party, other]);
            }
            assert_eq!(named, expected, "{claims:?}");
        }
    }
}
