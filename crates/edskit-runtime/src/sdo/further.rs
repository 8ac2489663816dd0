//! SDO servers besides the default one: 1201h to 127Fh.

use super::DEFAULT;
use crate::Application;
use crate::context::Context;
use crate::dictionary::Table;
use edskit_types::{AbortCode, CanId, CobId, Index, SubIndex};

const REQUEST: u8 = 1;
const RESPONSE: u8 = 2;

/// The objects that configure them.
pub(super) fn further_servers<'a>(table: &Table<'a>) -> impl Iterator<Item = Index> + use<'a> {
    let entries = table.entries_from(Index(DEFAULT.0 + 1));
    let entries = entries.take_while(|(_, entry)| entry.index.0 < Index::SDO_CLIENT.0);
    entries.filter(|(_, entry)| entry.sub_index.0 == REQUEST).map(|(_, entry)| entry.index)
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// The identifiers that a parameter object names, where both are valid.
    pub(super) fn can_ids(&self, index: Index) -> Option<(CanId, CanId)> {
        Some((self.server_can_id(index, REQUEST)?, self.server_can_id(index, RESPONSE)?))
    }

    fn server_can_id(&self, index: Index, sub_index: u8) -> Option<CanId> {
        let cob_id = self.node.objects.value(index, sub_index).map(CobId)?;
        let is_valid = cob_id.is_valid() && self.check_server(SubIndex(sub_index), cob_id).is_ok();
        is_valid.then(|| cob_id.can_id())
    }

    /// What a parameter of a server can be set to.
    pub(crate) fn check_server(&self, sub_index: SubIndex, cob_id: CobId) -> Result<(), AbortCode> {
        if ![REQUEST, RESPONSE].contains(&sub_index.0) {
            return Ok(());
        }
        // The identifiers of other nodes' default SDOs are what further channels are made of, although 7.3.5 restricts them.
        let is_default_sdo = matches!(cob_id.can_id().raw(), 0x581..=0x5FF | 0x601..=0x67F);
        self.node.check_cob_id(if is_default_sdo { CobId(cob_id.0 | CobId::BIT_31) } else { cob_id })
    }

    /// A parameter of a server is about to be written. A valid identifier has to be made invalid before it can change.
    pub(crate) fn check_server_change(
        &self,
        index: Index,
        sub_index: SubIndex,
        new: CobId,
    ) -> Result<(), AbortCode> {
        if ![REQUEST, RESPONSE].contains(&sub_index.0) {
            return Ok(());
        }
        match self.server_can_id(index, sub_index.0) {
            Some(old) if new.is_valid() && old != new.can_id() => Err(AbortCode::INVALID_VALUE),
            _ => Ok(()),
        }
    }
}
