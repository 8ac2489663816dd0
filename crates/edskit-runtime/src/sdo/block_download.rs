//! Block downloads: the client writes whole blocks of segments, and they are acknowledged.

use super::{
    BLOCK_CRC, Item, LAST_SEGMENT, MOST_SEGMENTS, Next, Request, SEGMENT, Session, Step, Transfer, number_of,
};
use crate::Application;
use crate::context::Context;
use crate::crc::Crc;
use edskit_types::AbortCode;

/// A block download.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockDownload {
    uses_crc: bool,
    crc: Crc,
    /// The number of the last segment that came in order.
    sequence: u8,
    /// The segment that came last: how much of it counts is known only when the next one or the end comes.
    held: Option<[u8; SEGMENT]>,
    /// Whether the last segment of all has come.
    is_complete: bool,
}

impl BlockDownload {
    /// Whether segments are coming.
    pub(super) fn is_in_block(&self) -> bool {
        !self.is_complete
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(super) fn begin_block_download(
        &mut self,
        number: usize,
        session: &mut Session,
        request: &Request,
    ) -> Step {
        let [command, ..] = *request;
        let announced = (command & 2 != 0).then(|| number_of(request));
        self.open_target(&mut session.item, announced)?;
        self.answer_about(number, 0xA0 | BLOCK_CRC, &session.item, [MOST_SEGMENTS, 0, 0, 0]);
        session.transfer = Transfer::BlockDownload(BlockDownload {
            uses_crc: command & BLOCK_CRC != 0,
            crc: Crc::new(),
            sequence: 0,
            held: None,
            is_complete: false,
        });
        Ok(Next::Request)
    }

    /// A segment. One that is not the next is passed over; the acknowledgement tells the client where to go on.
    pub(super) fn block_download_segment(
        &mut self,
        number: usize,
        item: &mut Item,
        download: &mut BlockDownload,
        request: &Request,
    ) -> Step {
        let [head, segment @ ..] = *request;
        let (sequence, is_last) = (head & !LAST_SEGMENT, head & LAST_SEGMENT != 0);
        if sequence == 0 {
            return Err(AbortCode::INVALID_SEQUENCE_NUMBER);
        }
        if sequence == download.sequence + 1 {
            if let Some(held) = download.held.replace(segment) {
                self.append_block(number, item, download, &held)?;
            }
            download.sequence = sequence;
            download.is_complete = is_last;
        }
        if is_last || sequence >= MOST_SEGMENTS {
            self.respond(number, [0xA2, download.sequence, MOST_SEGMENTS, 0, 0, 0, 0, 0]);
            download.sequence = 0;
        }
        Ok(Next::Request)
    }

    fn append_block(
        &mut self,
        number: usize,
        item: &mut Item,
        download: &mut BlockDownload,
        data: &[u8],
    ) -> Result<(), AbortCode> {
        download.crc.update(data);
        self.append(number, item, data)
    }

    /// The client ends the transfer: the last segment has so many bytes, and the checksum over all is this.
    pub(super) fn end_block_download(
        &mut self,
        number: usize,
        item: &mut Item,
        download: &mut BlockDownload,
        request: &Request,
    ) -> Step {
        let [command, low, high, ..] = *request;
        let length = SEGMENT - usize::from(command >> 2 & 7);
        let held = download.held.take().unwrap_or_default();
        self.append_block(number, item, download, held.get(..length).unwrap_or_default())?;
        if download.uses_crc && download.crc.value() != u16::from_le_bytes([low, high]) {
            return Err(AbortCode::CRC_ERROR);
        }
        let next = self.finish(number, item)?;
        self.respond(number, [0xA1, 0, 0, 0, 0, 0, 0, 0]);
        Ok(next)
    }
}
