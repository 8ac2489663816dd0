//! Block uploads: the client reads, and acknowledges whole blocks of segments.

use super::{BLOCK_CRC, Item, LAST_SEGMENT, MOST_SEGMENTS, Next, Request, SEGMENT, Session, Step, Transfer};
use crate::Application;
use crate::context::Context;
use crate::crc::Crc;
use edskit_types::AbortCode;

/// A block upload. Where the present block begins, the offset of the item says.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockUpload {
    phase: Phase,
    /// Segments of the present block that are sent.
    sent: u8,
    /// Segments of a block, as the client wants.
    block_size: u8,
    /// The bytes of the last segment, once it is sent.
    last: Option<u8>,
    uses_crc: bool,
    /// Over all segments that were sent, each once: what is sent again is the same.
    crc: Crc,
    /// How many bytes that are.
    checked: u32,
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
    pub(super) fn is_sending(&self) -> bool {
        self.phase == Phase::Sending
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(super) fn begin_block_upload(
        &mut self,
        number: usize,
        session: &mut Session,
        request: &Request,
    ) -> Step {
        let [command, _, _, _, block_size, threshold, ..] = *request;
        self.open_source(number, &mut session.item)?;
        check_block_size(block_size)?;
        let item = &mut session.item;
        if threshold > 0 && item.length.is_some_and(|length| length <= threshold.into()) {
            return self.begin_upload_of(number, session);
        }
        self.hold_source(number, item);
        let answer = 0xC0 | BLOCK_CRC | u8::from(item.length.is_some()) << 1;
        self.answer_about(number, answer, item, item.length.unwrap_or(0).to_le_bytes());
        session.transfer = Transfer::BlockUpload(BlockUpload {
            phase: Phase::Begun,
            sent: 0,
            block_size,
            last: None,
            uses_crc: command & BLOCK_CRC != 0,
            crc: Crc::new(),
            checked: 0,
        });
        Ok(Next::Request)
    }

    /// "Start", an acknowledgement, or the end.
    pub(super) fn block_upload_request(
        &mut self,
        number: usize,
        item: &mut Item,
        upload: &mut BlockUpload,
        request: &Request,
    ) -> Step {
        let [command, sequence, block_size, ..] = *request;
        match (command & 3, upload.phase) {
            (3, Phase::Begun) => {
                upload.phase = Phase::Sending;
                self.send_block(number, item, upload)
            }
            (2, Phase::Sending | Phase::Waiting) => {
                self.acknowledge(number, item, upload, sequence, block_size)
            }
            (1, Phase::Ended) => Ok(Next::End),
            _ => Err(AbortCode::UNKNOWN_COMMAND),
        }
    }

    fn acknowledge(
        &mut self,
        number: usize,
        item: &mut Item,
        upload: &mut BlockUpload,
        sequence: u8,
        block_size: u8,
    ) -> Step {
        if sequence > upload.sent {
            return Err(AbortCode::INVALID_SEQUENCE_NUMBER);
        }
        check_block_size(block_size)?;
        upload.block_size = block_size;
        let ends = upload.last.filter(|_| sequence == upload.sent);
        // Every segment but the last one of all is full.
        let unused = ends.map_or(0, |last| SEGMENT as u32 - u32::from(last));
        item.offset += (u32::from(sequence) * SEGMENT as u32).saturating_sub(unused);
        upload.sent = 0;
        upload.last = None;
        let Some(last) = ends else {
            upload.phase = Phase::Sending;
            return self.send_block(number, item, upload);
        };
        upload.phase = Phase::Ended;
        let unused = (SEGMENT as u8).saturating_sub(last);
        let crc = if upload.uses_crc { upload.crc.value() } else { 0 };
        let [low, high] = crc.to_le_bytes();
        self.respond(number, [0xC1 | unused << 2, low, high, 0, 0, 0, 0, 0]);
        Ok(Next::Request)
    }

    /// Sends as many segments of the block as the queue has room for.
    pub(super) fn send_block(&mut self, number: usize, item: &Item, upload: &mut BlockUpload) -> Step {
        while self.node.core.queue.room() > 0 {
            let offset = item.offset + u32::from(upload.sent) * SEGMENT as u32;
            let mut segment = [0; SEGMENT];
            let count = self.read_item(number, item, offset, &mut segment)?;
            let is_last = item.ends_with(offset, count);
            if offset == upload.checked {
                upload.crc.update(segment.get(..count).unwrap_or_default());
                upload.checked += count as u32;
            }
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
        Ok(Next::Request)
    }
}

fn check_block_size(block_size: u8) -> Result<(), AbortCode> {
    if (1..=MOST_SEGMENTS).contains(&block_size) { Ok(()) } else { Err(AbortCode::INVALID_BLOCK_SIZE) }
}
