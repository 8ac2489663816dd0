//! Without further SDO servers: there is the default one.

use crate::Application;
use crate::context::Context;
use crate::dictionary::Table;
use edskit_types::{AbortCode, CanId, CobId, Index, SubIndex};

pub(super) fn further_servers(_: &Table<'_>) -> impl Iterator<Item = Index> + use<> {
    core::iter::empty()
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(super) fn can_ids(&self, _: Index) -> Option<(CanId, CanId)> {
        None
    }

    /// What a parameter of a server can be set to: an identifier that is not valid.
    pub(crate) fn check_server(&self, sub_index: SubIndex, cob_id: CobId) -> Result<(), AbortCode> {
        let is_identifier = matches!(sub_index.0, 1 | 2);
        if is_identifier && cob_id.is_valid() { Err(AbortCode::INVALID_VALUE) } else { Ok(()) }
    }

    pub(crate) fn check_server_change(&self, _: Index, _: SubIndex, _: CobId) -> Result<(), AbortCode> {
        Ok(())
    }
}
