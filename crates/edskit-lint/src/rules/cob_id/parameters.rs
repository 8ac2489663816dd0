//! The objects that hold COB-IDs, and whose they are.

use crate::Context;
use crate::evaluate::{Effective, effective};
use crate::pdos::DescribedPdo;
use edskit_model::Datasheet;
use edskit_types::{Claim, CobId, Index, NodeId, Party, SdoMessage, SdoRole};

const TIME_COB_ID: Index = Index(0x1012);
const EMCY_CONSUMER: Index = Index(0x1028);
const LAST_SDO_CLIENT: Index = Index(0x12FF);

/// One COB-ID of the object dictionary.
#[derive(Clone, Copy)]
pub(super) struct Parameter<'a> {
    /// Who uses it.
    pub(super) party: Party,
    pub(super) value: Effective<'a>,
}

impl Parameter<'_> {
    /// Whether the message is in use with a COB-ID. What bits 30 and 31 say depends on the message.
    pub(super) fn is_in_use(&self, cob_id: CobId) -> bool {
        match self.party {
            Party::Sync => true,
            Party::Time => cob_id.0 & (CobId::BIT_31 | CobId::BIT_30) != 0,
            _ => cob_id.is_valid(),
        }
    }

    /// The COB-ID at a node-ID, if the message is in use with it.
    pub(super) fn used_at(&self, node_id: NodeId) -> Option<CobId> {
        self.value.cob_id_at(node_id).filter(|cob_id| self.is_in_use(*cob_id))
    }

    /// What the pre-defined connection set adds to the node-ID; `None` for what has no such CAN-ID.
    pub(super) fn base(&self) -> Option<u32> {
        let depends = matches!(self.party, Party::Pdo { .. } | Party::Emcy);
        let own = self.party.predefined_can_id(NodeId::MIN).filter(|_| depends)?;
        Some(own.raw() - u32::from(NodeId::MIN.get()))
    }
}

/// The COB-ID parameters of a file besides those of 1005h and 1200h, which rules of their own judge (COM005, COM015).
pub(super) fn all<'a>(context: &Context<'a>) -> Vec<Parameter<'a>> {
    let mut parameters = services(context.sheet);
    parameters.extend(context.pdos().iter().filter_map(of_pdo));
    parameters
}

fn of_pdo<'a>(pdo: &DescribedPdo<'a>) -> Option<Parameter<'a>> {
    let party = Party::Pdo { direction: pdo.direction, number: pdo.number };
    Some(Parameter { party, value: pdo.cob_id? })
}

/// TIME, EMCY and the SDO channels besides the default one.
fn services(sheet: &Datasheet) -> Vec<Parameter<'_>> {
    let mut parameters = Vec::new();
    let mut add = |party, value: Option<_>| parameters.extend(value.map(|value| Parameter { party, value }));
    add(Party::Time, effective(sheet, TIME_COB_ID, 0));
    add(Party::Emcy, effective(sheet, Index::EMCY_COB_ID, 0));
    if let Some(object) = sheet.object(EMCY_CONSUMER) {
        for node in NodeId::MIN.get()..=NodeId::MAX.get() {
            add(Party::EmcyOf(node), Effective::of(object, node));
        }
    }
    for object in sheet.objects_in(Index(Index::SDO_SERVER.0 + 1)..=LAST_SDO_CLIENT) {
        let (role, first) = match object.index() {
            index if index < Index::SDO_CLIENT => (SdoRole::Server, Index::SDO_SERVER),
            _ => (SdoRole::Client, Index::SDO_CLIENT),
        };
        // Both blocks have 128 objects.
        let number = (object.index().0 - first.0 + 1) as u8;
        add(Party::Sdo { role, number, message: SdoMessage::Request }, Effective::of(object, 1));
        add(Party::Sdo { role, number, message: SdoMessage::Response }, Effective::of(object, 2));
    }
    parameters
}

/// The COB-ID of the SYNC message.
pub(super) fn sync(sheet: &Datasheet) -> Option<Parameter<'_>> {
    let value = effective(sheet, Index::SYNC_COB_ID, 0)?;
    Some(Parameter { party: Party::Sync, value })
}

/// What a device on `node_id` uses without a COB-ID of its own: its default SDO channel, its boot-up message, and the
/// heartbeats that it monitors.
pub(super) fn fixed_claims(sheet: &Datasheet, node_id: NodeId) -> Vec<Claim> {
    let server = |message| Party::Sdo { role: SdoRole::Server, number: 1, message };
    let mut parties = vec![server(SdoMessage::Request), server(SdoMessage::Response), Party::Heartbeat];
    if let Some(object) = sheet.object(Index::CONSUMER_HEARTBEAT) {
        for sub_index in NodeId::MIN.get()..=NodeId::MAX.get() {
            let Some(value) = Effective::of(object, sub_index).and_then(Effective::constant::<u32>) else {
                continue;
            };
            let (node, time) = ((value >> 16) as u8, value as u16);
            // Whoever monitors itself is the matter of COM012.
            if time != 0 && node != node_id.get() {
                parties.push(Party::HeartbeatOf(node));
            }
        }
    }
    parties.into_iter().filter_map(|party| Claim::predefined(party, node_id)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FileKind;

    #[test]
    fn every_cob_id_has_its_party() {
        let text = "[1012]\nDataType=7\nDefaultValue=0x100\n[1014]\nDataType=7\nDefaultValue=$NODEID+0x80\n\
            [1028]\nObjectType=8\n[1028sub5]\nDataType=7\nDefaultValue=0x85\n\
            [1201]\nObjectType=9\n[1201sub2]\nDataType=7\nDefaultValue=0x80000000\n\
            [12FF]\nObjectType=9\n[12FFsub1]\nDataType=7\nDefaultValue=0x601\n\
            [1800]\nObjectType=9\n[1800sub1]\nDataType=7\nDefaultValue=$NODEID+0x180\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let context = Context::new(&sheet, FileKind::Eds, None);
        let found: Vec<String> = all(&context)
            .iter()
            .map(|parameter| {
                format!("{} {:?}", parameter.party, parameter.used_at(NodeId::MIN).map(|id| id.0))
            })
            .collect();
        assert_eq!(
            found,
            [
                "TIME None",
                "EMCY Some(129)",
                "EMCY of node 5 Some(133)",
                "SDO server 2 response None",
                "SDO client 128 request Some(1537)",
                "TPDO1 Some(385)"
            ]
        );
        let bases: Vec<_> = all(&context).iter().map(Parameter::base).collect();
        assert_eq!(bases, [None, Some(0x80), None, None, None, Some(0x180)]);
    }

    #[test]
    fn a_device_always_uses_its_sdo_channel_and_its_heartbeat() {
        let text = "[1016]\nObjectType=8\n[1016sub1]\nDataType=7\nDefaultValue=0x000503E8\n[1016sub2]\nDataType=7\nDefaultValue=0x00060000\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let claims = |node| {
            let claims = fixed_claims(&sheet, NodeId::new(node).unwrap());
            claims.iter().map(Claim::to_string).collect::<Vec<_>>()
        };
        assert_eq!(
            claims(1),
            [
                "SDO server request on 601h",
                "SDO server response on 581h",
                "heartbeat on 701h",
                "heartbeat of node 5 on 705h"
            ]
        );
        assert_eq!(claims(5).len(), 3);
    }
}
