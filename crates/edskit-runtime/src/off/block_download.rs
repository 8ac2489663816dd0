//! Without block transfer: a client that begins one gets [`AbortCode::UNKNOWN_COMMAND`], and writes in segments instead.

use super::{Item, Request, Session, Step};
use crate::Application;
use crate::context::Context;
use edskit_types::AbortCode;

/// There is none.
#[derive(Clone, Copy, Debug)]
pub(super) enum BlockDownload {}

impl BlockDownload {
    pub(super) fn is_in_block(&self) -> bool {
        match *self {}
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(super) fn begin_block_download(&mut self, _: usize, _: &mut Session, _: &Request) -> Step {
        Err(AbortCode::UNKNOWN_COMMAND)
    }

    pub(super) fn block_download_segment(
        &mut self,
        _: usize,
        _: &mut Item,
        download: &mut BlockDownload,
        _: &Request,
    ) -> Step {
        match *download {}
    }

    pub(super) fn end_block_download(
        &mut self,
        _: usize,
        _: &mut Item,
        download: &mut BlockDownload,
        _: &Request,
    ) -> Step {
        match *download {}
    }
}
