//! Reading, expedited and in segments.

use super::message::{Message, SERVICE, TOGGLE, number_of, segment};
use super::transfer::Phase;
use super::{EXPEDITED, SEGMENT, SdoError, SdoMode, Transfer};
use edskit_types::AbortCode;

/// Values that are longer than so many bytes go in blocks.
pub(super) const BLOCKS_ABOVE: usize = 256;

impl Transfer {
    pub(super) fn begin_upload(&mut self) {
        self.phase = Phase::UploadBegin;
        self.ask_for_place(0x40, [0; 4]);
    }

    pub(super) fn upload_begun(&mut self, answer: &Message) -> bool {
        let [command, _, _, _, data @ ..] = *answer;
        if command & SERVICE != 0x40 || !self.is_for_us(answer) {
            return false;
        }
        let (is_expedited, says_length) = (command & 2 != 0, command & 1 != 0);
        if is_expedited {
            let unused = if says_length { usize::from(command >> 2 & 3) } else { 0 };
            self.unsure = if says_length { 0 } else { EXPEDITED - 1 };
            if self.take_in(&data[..EXPEDITED - unused], 0) {
                self.end_of_reading();
            }
            return true;
        }
        self.announced = says_length.then(|| number_of(answer));
        let length = self.announced.map_or(0, |length| length as usize);
        if self.options.mode == SdoMode::Expedited {
            self.tell(AbortCode::LENGTH_TOO_HIGH);
            self.end(Err(SdoError::NotExpedited));
        } else if length > self.options.most_bytes {
            self.give_up(AbortCode::OUT_OF_MEMORY, "the value is longer than the limit of this client");
        } else if self.options.mode == SdoMode::Automatic && length > BLOCKS_ABOVE {
            self.tell(AbortCode::GENERAL_ERROR);
            self.begin_block_upload();
        } else {
            self.first = Some(*answer);
            self.ask_for_segment(0);
        }
        true
    }

    fn ask_for_segment(&mut self, toggle: u8) {
        self.phase = Phase::UploadSegment { toggle };
        self.ask(segment(0x60 | toggle, &[]));
    }

    pub(super) fn upload_segment(&mut self, answer: &Message, toggle: u8) -> bool {
        let [command, data @ ..] = *answer;
        if command & SERVICE != 0 || Some(*answer) == self.last {
            return false;
        }
        let (length, is_last) = (SEGMENT - usize::from(command >> 1 & 7), command & 1 != 0);
        if command & TOGGLE != toggle {
            self.give_up(AbortCode::TOGGLE_BIT, "the toggle bit of a segment is wrong");
        } else if length == 0 && !is_last {
            self.give_up(AbortCode::LENGTH_MISMATCH, "a segment is empty and not the last one");
        } else if self.take_in(&data[..length], if is_last { SEGMENT - 1 } else { 0 }) {
            if is_last {
                // A full segment is also one whose length is not said.
                self.unsure = if length == SEGMENT { SEGMENT - 1 } else { 0 };
                self.end_of_reading();
            } else {
                self.ask_for_segment(toggle ^ TOGGLE);
            }
        }
        true
    }
}
