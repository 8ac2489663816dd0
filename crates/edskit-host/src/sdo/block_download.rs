//! Writing in blocks.

use super::message::{CRC, LAST_SEGMENT, LENGTH, Message, SERVICE, segment};
use super::transfer::Phase;
use super::{MOST_SEGMENTS, SEGMENT, Transfer};
use edskit_runtime::Crc;
use edskit_types::AbortCode;

/// The bits of an answer that name the service and its step.
const STEP: u8 = SERVICE | 3;

impl Transfer {
    pub(super) fn begin_block_download(&mut self, announced: u32) {
        self.phase = Phase::BlockDownloadBegin;
        self.ask_for_place(0xC0 | CRC | LENGTH, announced.to_le_bytes());
    }

    pub(super) fn block_download_begun(&mut self, answer: &Message) -> bool {
        if answer[0] & STEP != 0xA0 || !self.is_for_us(answer) {
            return self.switches_to_segments(answer);
        }
        self.uses_crc = answer[0] & CRC != 0;
        self.begin_block(answer[4]);
        true
    }

    fn begin_block(&mut self, size: u8) {
        if (1..=MOST_SEGMENTS).contains(&size) {
            self.phase = Phase::BlockDownload { sent: 0, size };
        } else {
            self.give_up(
                AbortCode::INVALID_BLOCK_SIZE,
                "the server wants blocks of a size that is not 1 to 127",
            );
        }
    }

    /// How many segments are left from where the block begins: one at least, which is empty where there is nothing.
    fn segments_left(&self) -> usize {
        (self.data.len() - self.confirmed).div_ceil(SEGMENT).max(1)
    }

    /// The next segment of a block that is being sent, and which one of the block it is.
    pub(super) fn next_segment(&self) -> Option<(Message, u8)> {
        let Phase::BlockDownload { sent, size } = self.phase else { return None };
        let left = self.segments_left();
        if sent >= size || usize::from(sent) >= left {
            return None;
        }
        let start = self.confirmed + usize::from(sent) * SEGMENT;
        let end = self.data.len().min(start + SEGMENT);
        let sent = sent + 1;
        let is_last = usize::from(sent) == left;
        Some((segment(sent | if is_last { LAST_SEGMENT } else { 0 }, &self.data[start..end]), sent))
    }

    /// The server has taken segments up to a number; those behind it are sent again, as the first ones of the next block.
    /// CiA 301 v4.2, 7.2.4.3 has it say so when the block is out. Here it counts at any time: there are servers that say at
    /// once which segment they miss, and take nothing more of that block.
    pub(super) fn block_confirmed(&mut self, answer: &Message, sent: u8, size: u8) -> bool {
        let [command, sequence, next_size, ..] = *answer;
        let left = self.segments_left();
        let is_out = sent >= size || usize::from(sent) >= left;
        if command & STEP != 0xA2 {
            return false;
        }
        // That of the block before, repeated, says nothing of this one.
        let is_repeated = Some(*answer) == self.last && sequence >= sent;
        if !is_out && (sent == 0 || sequence > sent || is_repeated) {
            return false;
        }
        if sequence > sent {
            self.give_up(
                AbortCode::INVALID_SEQUENCE_NUMBER,
                "the server confirms segments that were not sent",
            );
            return true;
        }
        if !self.goes_on(sequence > 0) {
            return true;
        }
        self.confirmed = self.data.len().min(self.confirmed + usize::from(sequence) * SEGMENT);
        if usize::from(sequence) < left {
            self.begin_block(next_size);
            return true;
        }
        let unused = (SEGMENT - self.data.len() % SEGMENT) % SEGMENT;
        let unused = if self.data.is_empty() { SEGMENT } else { unused };
        let mut crc = Crc::new();
        if self.uses_crc {
            crc.update(&self.data);
        }
        self.phase = Phase::BlockDownloadEnd;
        self.ask(segment(0xC1 | (unused as u8) << 2, &crc.value().to_le_bytes()));
        true
    }

    pub(super) fn block_download_ended(&mut self, answer: &Message) -> bool {
        if answer[0] & STEP != 0xA1 {
            return false;
        }
        self.done();
        true
    }
}
