//! Which COB-IDs the services have at power-on, and whether they can be used.

use super::Layout;
use super::gather::Item;
use super::mappings::Place;
use crate::Problem;
use edskit_lint::Severity;
use edskit_model::Document;
use edskit_types::{
    CobId, CobIdFault, IdentifierRules, Index, NodeId, Party, PdoDirection, SdoMessage, SdoRole, SubIndex,
};

/// A COB-ID of power-on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CobIdParameter {
    /// The service that has it.
    pub party: Party,
    /// Its value, without the node-ID.
    pub cob_id: CobId,
    /// Whether the node-ID is added.
    pub adds_node_id: bool,
    /// Where it stands.
    pub place: Place,
}

impl CobIdParameter {
    /// Why the node does not use it at a node-ID, by the check that a written value has to pass; `None` where it does, and
    /// where the service is not meant to exist.
    #[must_use]
    pub fn fault(&self, node_id: NodeId) -> Option<CobIdFault> {
        let added = if self.adds_node_id { u32::from(node_id.get()) } else { 0 };
        let cob_id = CobId(self.cob_id.0.wrapping_add(added));
        // Bit 31 says for SYNC nothing, for TIME that the device takes the message.
        let without_bit_31 = CobId(cob_id.0 & !CobId::BIT_31);
        let checked = match self.party {
            Party::Sync => without_bit_31,
            Party::Time if cob_id.is_valid() && !cob_id.bit30() => return None,
            Party::Time => without_bit_31,
            _ if !cob_id.is_valid() => return None,
            // The identifiers of other nodes' default SDOs are what further channels are made of.
            Party::Sdo { .. } if matches!(cob_id.can_id().raw(), 0x581..=0x5FF | 0x601..=0x67F) => {
                CobId(cob_id.0 | CobId::BIT_31)
            }
            _ => cob_id,
        };
        IdentifierRules::CIA_301.fault(checked)
    }

    fn problem(&self, node_ids: &[NodeId]) -> Option<Problem> {
        let faults: Vec<_> =
            node_ids.iter().filter_map(|node_id| Some((*node_id, self.fault(*node_id)?))).collect();
        let ((first, fault), (last, _)) = (*faults.first()?, *faults.last()?);
        let at = match (faults.len() == node_ids.len(), first == last) {
            (true, _) => String::new(),
            (false, true) => format!(" at node-ID {first}"),
            (false, false) => format!(" at node-IDs {first} to {last}"),
        };
        let Place { file, span, position } = self.place;
        Some(Problem {
            severity: Severity::Warning,
            code: "GEN",
            file,
            span,
            position,
            message: format!("{} is not in use{at}: {fault}", self.party),
            help: Some("set bit 31, as in `0x80000000`, if it is not meant to be".to_owned())
                .filter(|_| !matches!(self.party, Party::Sync | Party::Time)),
        })
    }
}

impl Layout {
    /// Services that the node does not use because of their COB-ID, at one node-ID or, without one, at any: the node
    /// neither sends nor takes their messages, and starts all the same.
    #[must_use]
    pub fn cob_id_problems(&self, node_id: Option<NodeId>) -> Vec<Problem> {
        let all = || (NodeId::MIN.get()..=NodeId::MAX.get()).filter_map(|id| NodeId::new(id).ok()).collect();
        let node_ids: Vec<NodeId> = node_id.map_or_else(all, |node_id| vec![node_id]);
        self.cob_ids.iter().filter_map(|parameter| parameter.problem(&node_ids)).collect()
    }
}

/// The COB-IDs of a dictionary whose items are sorted.
pub(super) fn read(items: &[Item], document: &Document) -> Vec<CobIdParameter> {
    let parameter = |item: &Item| {
        let party = party(item.index, item.sub_index)?;
        let default = item.default.as_ref();
        let bytes = default.and_then(|default| default.bytes.first_chunk().copied()).unwrap_or_default();
        Some(CobIdParameter {
            party,
            cob_id: CobId(u32::from_le_bytes(bytes)),
            adds_node_id: default.is_some_and(|default| default.is_node_relative),
            place: Place::of(item, document),
        })
    };
    items.iter().filter_map(parameter).collect()
}

/// The service of the node whose COB-ID an entry is. The default SDO has the identifiers of its node whatever the file says,
/// and the node itself is no client of other nodes.
fn party(index: Index, sub_index: SubIndex) -> Option<Party> {
    let pdo = |direction, first: Index| Party::Pdo { direction, number: index.0 - first.0 + 1 };
    Some(match (index, sub_index.0) {
        (Index::SYNC_COB_ID, 0) => Party::Sync,
        (Index(0x1012), 0) => Party::Time,
        (Index::EMCY_COB_ID, 0) => Party::Emcy,
        (Index(0x1201..=0x127F), 1 | 2) => Party::Sdo {
            role: SdoRole::Server,
            number: (index.0 - Index::SDO_SERVER.0 + 1) as u8,
            message: if sub_index.0 == 1 { SdoMessage::Request } else { SdoMessage::Response },
        },
        (index, 1) if index.is_rpdo_communication() => pdo(PdoDirection::Receive, Index::RPDO_COMMUNICATION),
        (index, 1) if index.is_tpdo_communication() => pdo(PdoDirection::Transmit, Index::TPDO_COMMUNICATION),
        _ => return None,
    })
}
