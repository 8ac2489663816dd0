//! What the gateway checks at its initialisation (7.3).

use super::table::PdoTable;
use edskit_types::{CanId, Claim, IdentifierRules, NodeId, Party, SdoMessage, SdoRole};

/// After so many failures the gateway gives up: its state stays undefined, there is no object dictionary and no
/// communication on CANopen (9.5; GW-APP-14).
pub const INITIALISATION_ATTEMPTS: u8 = 3;

/// The rules of 7.3: no two active PDOs of any direction on one identifier (GW-CFG-18), and none on 000h, 080h or 100h
/// (GW-CFG-19, GW-CFG-20, GW-CFG-21). SDO and heartbeats are among the [claims](PdoTable::claims).
///
/// What else CiA 301 restricts is not looked at (GW-CFG-29, GW-NOTE-19).
pub const RULES: IdentifierRules<'static> = IdentifierRules {
    restricted: &[],
    reserved: &[reserved(Party::Nmt), reserved(Party::Sync), reserved(Party::Time)],
    rpdos_may_share: false,
};

/// A service that has the same identifier on every node.
const fn reserved(party: Party) -> Claim {
    match Claim::predefined(party, NodeId::MIN) {
        Some(claim) => claim,
        None => panic!("the service has no identifier of its own"),
    }
}

const REQUEST: Party = Party::Sdo { role: SdoRole::Server, number: 1, message: SdoMessage::Request };
const RESPONSE: Party = Party::Sdo { role: SdoRole::Server, number: 1, message: SdoMessage::Response };

/// The identifiers that the gateway uses: at most those of 20 PDOs, of the SDO and of two heartbeats.
#[derive(Clone, Copy, Debug)]
pub struct Claims {
    claims: [Claim; Self::MOST],
    count: usize,
}

impl Claims {
    const MOST: usize = 24;

    fn push(&mut self, claim: Claim) {
        if let Some(place) = self.claims.get_mut(self.count) {
            *place = claim;
            self.count += 1;
        }
    }

    /// The claims, for [`conflicts`](edskit_types::conflicts).
    pub fn as_mut_slice(&mut self) -> &mut [Claim] {
        self.claims.get_mut(..self.count).unwrap_or_default()
    }
}

impl PdoTable {
    /// The identifiers that must differ: those of active PDOs (GW-CFG-18, GW-CFG-27), of the SDO (GW-CFG-22,
    /// GW-CFG-23), of the gateway's heartbeat (GW-CFG-24) and of its partner's (GW-CFG-25).
    ///
    /// The two heartbeats collide exactly if the node-IDs of gateway and partner are equal (GW-CFG-26). With partner 0
    /// the identifier 700h is taken, as 7.3 says, though nobody is monitored (GW-NOTE-21).
    #[must_use]
    pub fn claims(&self) -> Claims {
        let filler = Claim { can_id: CanId::NMT, party: Party::Nmt };
        let mut claims = Claims { claims: [filler; Claims::MOST], count: 0 };
        for pdo in self.iter().filter(|pdo| pdo.activity.is_active()) {
            claims.push(Claim { can_id: pdo.can_id, party: pdo.party() });
        }
        for party in [RESPONSE, REQUEST, Party::Heartbeat, Party::HeartbeatOf(self.partner_node_id)] {
            if let Some(claim) = Claim::predefined(party, self.node_id) {
                claims.push(claim);
            }
        }
        claims
    }
}
