//! Reading in blocks.

use super::message::{CRC, LAST_SEGMENT, LENGTH, Message, SERVICE, number_of, segment};
use super::transfer::Phase;
use super::{MOST_SEGMENTS, SEGMENT, Transfer};
use edskit_runtime::Crc;
use edskit_types::AbortCode;

impl Transfer {
    pub(super) fn begin_block_upload(&mut self) {
        self.phase = Phase::BlockUploadBegin;
        // The threshold 0 forbids the server to answer with another kind of transfer.
        self.ask_for_place(0xA0 | CRC, [self.block_size(), 0, 0, 0]);
    }

    fn block_size(&self) -> u8 {
        self.options.block_size.clamp(1, MOST_SEGMENTS)
    }

    pub(super) fn block_upload_begun(&mut self, answer: &Message) -> bool {
        let command = answer[0];
        if command & SERVICE != 0xC0 || command & 1 != 0 || !self.is_for_us(answer) {
            return self.switches_to_segments(answer);
        }
        self.uses_crc = command & CRC != 0;
        self.announced = (command & LENGTH != 0).then(|| number_of(answer));
        if self.announced.is_some_and(|length| length as usize > self.options.most_bytes) {
            self.give_up(AbortCode::OUT_OF_MEMORY, "the value is longer than the limit of this client");
            return true;
        }
        self.first = Some(*answer);
        self.phase = Phase::BlockUpload { sequence: 0, highest: 0 };
        self.ask(segment(0xA3, &[]));
        true
    }

    /// A segment. One that is not the next is passed over; the confirmation tells the server where to go on.
    pub(super) fn block_upload_segment(&mut self, answer: &Message, sequence: u8, highest: u8) -> bool {
        let [head, data @ ..] = *answer;
        let (number, is_last) = (head & !LAST_SEGMENT, head & LAST_SEGMENT != 0);
        let is_next = number == sequence + 1;
        // A repeated first answer can look like the last segment of all.
        let is_repeated = Some(*answer) == self.first || Some(*answer) == self.last;
        if number <= highest || number > self.block_size() || is_repeated && !is_next {
            return false;
        }
        if is_next && !self.take_in(&data, SEGMENT - 1) {
            return true;
        }
        let sequence = if is_next { number } else { sequence };
        let ends_block = is_last || number == self.block_size();
        if !ends_block {
            self.phase = Phase::BlockUpload { sequence, highest: number };
        } else if self.goes_on(sequence > 0) {
            let next_block = Phase::BlockUpload { sequence: 0, highest: 0 };
            self.phase = if is_next && is_last { Phase::BlockUploadEnd } else { next_block };
            self.ask(segment(0xA2, &[sequence, self.block_size()]));
        }
        true
    }

    pub(super) fn block_upload_ends(&mut self, answer: &Message) -> bool {
        let [command, low, high, ..] = *answer;
        if command & (SERVICE | 3) != 0xC1 {
            return false;
        }
        let unused = usize::from(command >> 2 & 7);
        self.data.truncate(self.data.len().saturating_sub(unused));
        let mut crc = Crc::new();
        crc.update(&self.data);
        if self.uses_crc && crc.value() != u16::from_le_bytes([low, high]) {
            self.give_up(AbortCode::CRC_ERROR, "the checksum does not fit what was received");
            return true;
        }
        if self.end_of_reading() {
            self.ask(segment(0xA1, &[]));
        }
        true
    }
}
