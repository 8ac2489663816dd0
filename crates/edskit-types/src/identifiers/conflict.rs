//! The check.

use super::{Claim, IdentifierRules, Party, Restriction};
use crate::CanId;
use core::fmt;

/// Two that cannot have one CAN-ID.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Conflict {
    /// The CAN-ID.
    pub can_id: CanId,
    /// The claim that should move: of two claims the later one in the order of [`Party`], so a PDO before a service.
    pub party: Party,
    /// What is in its way.
    pub with: Opponent,
}

/// What is in the way of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Opponent {
    /// Another claim, or a reserved CAN-ID of the rules.
    Party(Party),
    /// A restricted range of the rules.
    Restricted(Restriction),
}

/// `TPDO5 and TPDO2 on 282h`, `TPDO12 on 003h, which is restricted: 001h to 07Fh (reserved)`.
impl fmt::Display for Conflict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.with {
            Opponent::Party(other) => write!(f, "{} and {other} on {}", self.party, self.can_id),
            Opponent::Restricted(range) => {
                write!(f, "{} on {}, which is restricted: {range}", self.party, self.can_id)
            }
        }
    }
}

/// Every conflict among `claims`, in ascending order of the CAN-IDs.
///
/// Sorts the claims. Of several claims on one CAN-ID each is reported against one of them, so that each is named and
/// n claims give at most n − 1 conflicts with each other. A claim that stands twice in the list is one claim.
///
/// Nothing is allocated. The work is that of sorting n claims, and n times the length of the lists of `rules`.
///
/// ```
/// use edskit_types::{CanId, Claim, IdentifierRules, NodeId, Party, PdoDirection, conflicts};
///
/// let node = NodeId::new(2)?;
/// let tpdo = |number| Party::Pdo { direction: PdoDirection::Transmit, number };
/// let mut claims = [
///     Claim::predefined(tpdo(2), node).unwrap(),
///     Claim { can_id: CanId::standard(0x282).unwrap(), party: tpdo(5) },
///     Claim { can_id: CanId::standard(0x003).unwrap(), party: tpdo(12) },
/// ];
/// let mut found = conflicts(&mut claims, &IdentifierRules::CIA_301);
/// assert_eq!(found.next().unwrap().to_string(), "TPDO12 on 003h, which is restricted: 001h to 07Fh (reserved)");
/// assert_eq!(found.next().unwrap().to_string(), "TPDO5 and TPDO2 on 282h");
/// assert_eq!(found.next(), None);
/// # Ok::<(), edskit_types::InvalidNodeId>(())
/// ```
pub fn conflicts<'a>(
    claims: &'a mut [Claim],
    rules: &IdentifierRules<'a>,
) -> impl Iterator<Item = Conflict> + use<'a> {
    claims.sort_unstable_by_key(order);
    let claims = &*claims;
    let rules = *rules;
    let is_first_copy =
        |position: usize, claim| position.checked_sub(1).and_then(|before| claims.get(before)) != Some(claim);
    claims
        .iter()
        .enumerate()
        .filter(move |&(position, claim)| is_first_copy(position, claim))
        .flat_map(move |(position, claim)| of_claim(claims, position, claim, rules))
}

/// RPDOs come last: where they may share, each must meet the others and not only another RPDO.
fn order(claim: &Claim) -> (CanId, bool, Party) {
    (claim.can_id, claim.party.is_rpdo(), claim.party)
}

/// The conflicts of one claim with those before it and with the lists of the rules.
fn of_claim<'a>(
    claims: &'a [Claim],
    position: usize,
    claim: &'a Claim,
    rules: IdentifierRules<'a>,
) -> impl Iterator<Item = Conflict> {
    let first = claims.partition_point(|other| other.can_id < claim.can_id);
    let may_share = |other: &Claim| rules.rpdos_may_share && other.party.is_rpdo() && claim.party.is_rpdo();
    let shared = claims.get(first..position).and_then(<[Claim]>::first).filter(|other| !may_share(other));
    let shared = shared.map(|other| (claim.party.max(other.party), claim.party.min(other.party)));
    // What the device claims besides is compared as a claim.
    let is_claimed = |other: &Claim| claims.binary_search_by_key(&order(other), order).is_ok();
    let taken = rules.reserved.iter().filter(move |other| other.can_id == claim.can_id && !is_claimed(other));
    let taken = taken.map(|other| (claim.party, other.party));
    let with_parties = shared.into_iter().chain(taken).map(|(party, other)| (party, Opponent::Party(other)));
    let ranges = rules.restricted.iter().filter(|range| range.contains(claim.can_id));
    let ranges = ranges.filter(|_| claim.party.is_configurable());
    let with_ranges = ranges.map(|range| (claim.party, Opponent::Restricted(*range)));
    with_parties.chain(with_ranges).map(|(party, with)| Conflict { can_id: claim.can_id, party, with })
}
