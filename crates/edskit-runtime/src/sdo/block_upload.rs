//! Block uploads: the client reads, and acknowledges whole blocks of segments.

use super::upload::Source;
use super::{Outcome, Refusal, Request, SEGMENT, Transfer, message};
use crate::context::Context;
use crate::crc::Crc;
use edskit_types::{AbortCode, Index, SubIndex};

/// The most segments of a block.
const MOST_SEGMENTS: u8 = 127;
/// Whether the other side knows checksums, in the commands that begin a transfer.
const CRC: u8 = 4;
const LAST_SEGMENT: u8 = 0x80;

/// A block upload.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockUpload {
    source: Source,
    phase: Phase,
    /// Bytes that the client has acknowledged: where the present block begins.
    acknowledged: u32,
    /// Segments of the present block that are sent.
    sent: u8,
    /// Segments of a block, as the client wants.
    block_size: u8,
    /// The bytes of the last segment, once it is sent.
    last: Option<u8>,
    uses_crc: bool,
    /// Over what is acknowledged.
    crc: Crc,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Phase {
    /// The client has not said "start" yet.
    Begun,
    Sending,
    /// The block is out, the client has to acknowledge it.
    Waiting,
    /// All is acknowledged, the client has to end the transfer.
    Ended,
}

impl BlockUpload {
    pub(super) fn place(self) -> (Index, SubIndex) {
        (self.source.index, self.source.sub_index)
    }

    pub(super) fn is_sending(self) -> bool {
        self.phase == Phase::Sending
    }

    fn refusal(self, code: AbortCode) -> Refusal {
        self.source.refusal(code)
    }
}

impl Context<'_> {
    pub(super) fn begin_block_upload(&mut self, number: usize, request: &Request) -> Outcome {
        let [command, _, _, _, block_size, threshold, ..] = *request;
        let source = self.open_source(number, request)?;
        if !(1..=MOST_SEGMENTS).contains(&block_size) {
            return Err(source.refusal(AbortCode::INVALID_BLOCK_SIZE));
        }
        if threshold > 0 && source.length.is_some_and(|length| length <= threshold.into()) {
            return self.begin_upload_of(number, source);
        }
        let (says_length, length) = match source.length {
            Some(length) => (2, length),
            None => (0, 0),
        };
        let answer = 0xC0 | CRC | says_length;
        self.respond(number, message(answer, source.index, source.sub_index, length.to_le_bytes()));
        Ok(Transfer::BlockUpload(BlockUpload {
            source,
            phase: Phase::Begun,
            acknowledged: 0,
            sent: 0,
            block_size,
            last: None,
            uses_crc: command & CRC != 0,
            crc: Crc::new(),
        }))
    }

    /// "Start", an acknowledgement, or the end.
    pub(super) fn block_upload_request(
        &mut self,
        number: usize,
        upload: BlockUpload,
        request: &Request,
    ) -> Outcome {
        let [command, sequence, block_size, ..] = *request;
        match (command & 3, upload.phase) {
            (3, Phase::Begun) => self.send_block(number, BlockUpload { phase: Phase::Sending, ..upload }),
            (2, Phase::Sending | Phase::Waiting) => self.acknowledge(number, upload, sequence, block_size),
            (1, Phase::Ended) => Ok(Transfer::None),
            _ => Err(upload.refusal(AbortCode::UNKNOWN_COMMAND)),
        }
    }

    fn acknowledge(&mut self, number: usize, upload: BlockUpload, sequence: u8, block_size: u8) -> Outcome {
        if sequence > upload.sent {
            return Err(upload.refusal(AbortCode::INVALID_SEQUENCE_NUMBER));
        }
        if !(1..=MOST_SEGMENTS).contains(&block_size) {
            return Err(upload.refusal(AbortCode::INVALID_BLOCK_SIZE));
        }
        let mut upload = BlockUpload { block_size, ..upload };
        for place in 0..sequence {
            let mut segment = [0; SEGMENT];
            let (count, _) = self.read_source(number, upload.source, upload.acknowledged, &mut segment)?;
            // Of an application that changes its mind, what was sent counts.
            let is_last = upload.last.is_some() && place + 1 == upload.sent;
            let count = if is_last { upload.last.unwrap_or_default().into() } else { count };
            upload.crc.update(segment.get(..count).unwrap_or_default());
            upload.acknowledged += count as u32;
        }
        let ends = upload.last.filter(|_| sequence == upload.sent);
        upload.sent = 0;
        upload.last = None;
        let Some(last) = ends else {
            upload.phase = Phase::Sending;
            return self.send_block(number, upload);
        };
        let unused = (SEGMENT as u8).saturating_sub(last);
        let crc = if upload.uses_crc { upload.crc.value() } else { 0 };
        let [low, high] = crc.to_le_bytes();
        self.respond(number, [0xC1 | unused << 2, low, high, 0, 0, 0, 0, 0]);
        Ok(Transfer::BlockUpload(BlockUpload { phase: Phase::Ended, ..upload }))
    }

    /// Sends as many segments of the block as the queue has room for.
    pub(super) fn send_block(&mut self, number: usize, mut upload: BlockUpload) -> Outcome {
        while self.core.queue.room() > 0 {
            let offset = upload.acknowledged + u32::from(upload.sent) * SEGMENT as u32;
            let mut segment = [0; SEGMENT];
            let (count, is_last) = self.read_source(number, upload.source, offset, &mut segment)?;
            upload.sent += 1;
            let flag = if is_last { LAST_SEGMENT } else { 0 };
            let [a, b, c, d, e, f, g] = segment;
            self.respond(number, [upload.sent | flag, a, b, c, d, e, f, g]);
            upload.last = is_last.then_some(count as u8);
            if is_last || upload.sent >= upload.block_size {
                upload.phase = Phase::Waiting;
                break;
            }
        }
        Ok(Transfer::BlockUpload(upload))
    }
}
