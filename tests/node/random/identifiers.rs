//! What a node may send.

use edskit_runtime::Objects;
use edskit_types::{CanId, CobId, Index, NmtState};

/// The identifier of the answers of LSS.
const LSS: u16 = 0x7E4;
const SDO_RESPONSE: u8 = 2;

/// The identifiers that a node may use in a state, as its dictionary says at the moment.
pub(super) fn of(node_id: Option<u8>, state: NmtState, objects: &Objects<'_>) -> Vec<CanId> {
    let standard = |raw: u16| CanId::standard(raw).expect("the identifier has eleven bits");
    let mut all = vec![standard(LSS)];
    let Some(node_id) = node_id.map(u16::from) else { return all };
    all.push(standard(0x700 + node_id));
    if state == NmtState::Stopped {
        return all;
    }
    all.push(standard(0x580 + node_id));
    let cob_id = |index, sub_index| objects.value::<u32>(index, sub_index).map(CobId);
    all.extend(cob_id(Index::SYNC_COB_ID, 0).filter(|sync| sync.bit30()).map(CobId::can_id));
    let valid =
        |index, sub_index| cob_id(index, sub_index).filter(|cob_id| cob_id.is_valid()).map(CobId::can_id);
    all.extend(valid(Index::EMCY_COB_ID, 0));
    all.extend(valid(Index(0x1201), SDO_RESPONSE));
    if state == NmtState::Operational {
        all.extend((0..4).filter_map(|number| valid(Index(0x1800 + number), 1)));
    }
    all
}
