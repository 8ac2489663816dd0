//! Block downloads: the client writes whole blocks of segments, and they are acknowledged.

use super::download::Target;
use super::{Outcome, Refusal, Request, SEGMENT, Transfer, message, number_of};
use crate::context::Context;
use crate::crc::Crc;
use edskit_types::{AbortCode, Index, SubIndex};

/// Segments of a block.
const BLOCK_SIZE: u8 = 127;
const CRC: u8 = 4;
const LAST_SEGMENT: u8 = 0x80;

/// A block download.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockDownload {
    target: Target,
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
    pub(super) fn place(self) -> (Index, SubIndex) {
        (self.target.index, self.target.sub_index)
    }

    /// Whether segments are coming.
    pub(super) fn is_in_block(self) -> bool {
        !self.is_complete
    }

    fn refusal(self, code: AbortCode) -> Refusal {
        self.target.refusal(code)
    }
}

impl Context<'_> {
    pub(super) fn begin_block_download(&mut self, number: usize, request: &Request) -> Outcome {
        let [command, ..] = *request;
        let announced = (command & 2 != 0).then(|| number_of(request));
        let target = self.open_target(request, announced)?;
        let answer = message(0xA0 | CRC, target.index, target.sub_index, [BLOCK_SIZE, 0, 0, 0]);
        self.respond(number, answer);
        Ok(Transfer::BlockDownload(BlockDownload {
            target,
            uses_crc: command & CRC != 0,
            crc: Crc::new(),
            sequence: 0,
            held: None,
            is_complete: false,
        }))
    }

    /// A segment. One that is not the next is passed over; the acknowledgement tells the client where to go on.
    pub(super) fn block_download_segment(
        &mut self,
        number: usize,
        mut download: BlockDownload,
        request: &Request,
    ) -> Outcome {
        let [head, segment @ ..] = *request;
        let (sequence, is_last) = (head & !LAST_SEGMENT, head & LAST_SEGMENT != 0);
        if sequence == 0 {
            return Err(download.refusal(AbortCode::INVALID_SEQUENCE_NUMBER));
        }
        if sequence == download.sequence + 1 {
            if let Some(held) = download.held.replace(segment) {
                self.append_block(number, &mut download, &held)?;
            }
            download.sequence = sequence;
            download.is_complete = is_last;
        }
        if is_last || sequence >= BLOCK_SIZE {
            self.respond(number, [0xA2, download.sequence, BLOCK_SIZE, 0, 0, 0, 0, 0]);
            download.sequence = 0;
        }
        Ok(Transfer::BlockDownload(download))
    }

    fn append_block(
        &mut self,
        number: usize,
        download: &mut BlockDownload,
        data: &[u8],
    ) -> Result<(), Refusal> {
        download.crc.update(data);
        self.append(number, &mut download.target, data)
    }

    /// The client ends the transfer: the last segment has so many bytes, and the checksum over all is this.
    pub(super) fn end_block_download(
        &mut self,
        number: usize,
        mut download: BlockDownload,
        request: &Request,
    ) -> Outcome {
        let [command, low, high, ..] = *request;
        let length = SEGMENT - usize::from(command >> 2 & 7);
        let held = download.held.take().unwrap_or_default();
        let last = held.get(..length).unwrap_or_default();
        self.append_block(number, &mut download, last)?;
        if download.uses_crc && download.crc.value() != u16::from_le_bytes([low, high]) {
            return Err(download.refusal(AbortCode::CRC_ERROR));
        }
        self.finish(number, &download.target)?;
        self.respond(number, [0xA1, 0, 0, 0, 0, 0, 0, 0]);
        Ok(Transfer::None)
    }
}
