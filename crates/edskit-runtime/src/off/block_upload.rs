//! Without block transfer: a client that begins one gets [`AbortCode::UNKNOWN_COMMAND`], and reads in segments instead.

use super::{Item, Request, Session, Step};
use crate::Application;
use crate::context::Context;
use edskit_types::AbortCode;

/// There is none.
#[derive(Clone, Copy, Debug)]
pub(super) enum BlockUpload {}

impl BlockUpload {
    pub(super) fn is_sending(&self) -> bool {
        match *self {}
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(super) fn begin_block_upload(&mut self, _: usize, _: &mut Session, _: &Request) -> Step {
        Err(AbortCode::UNKNOWN_COMMAND)
    }

    pub(super) fn block_upload_request(
        &mut self,
        _: usize,
        _: &mut Item,
        upload: &mut BlockUpload,
        _: &Request,
    ) -> Step {
        match *upload {}
    }

    pub(super) fn send_block(&mut self, _: usize, _: &Item, upload: &mut BlockUpload) -> Step {
        match *upload {}
    }
}
