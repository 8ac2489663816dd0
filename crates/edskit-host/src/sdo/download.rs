//! Writing, expedited and in segments.

use super::message::{Message, SERVICE, TOGGLE, segment};
use super::transfer::Phase;
use super::upload::BLOCKS_ABOVE;
use super::{EXPEDITED, SEGMENT, SdoError, SdoMode, Transfer};
use edskit_types::AbortCode;

impl Transfer {
    /// Begins to write with the kind of transfer that suits.
    pub(super) fn begin_write(&mut self) {
        let length = self.data.len();
        let Ok(announced) = u32::try_from(length) else {
            return self.end(Err(SdoError::TooLong(length)));
        };
        match (self.options.mode, length) {
            (SdoMode::Automatic | SdoMode::Expedited, 1..=EXPEDITED) => self.begin_expedited_download(),
            (SdoMode::Expedited, _) => self.end(Err(SdoError::NotExpedited)),
            (SdoMode::Block, _) => self.begin_block_download(announced),
            (SdoMode::Automatic, length) if length > BLOCKS_ABOVE => self.begin_block_download(announced),
            (SdoMode::Automatic | SdoMode::Segmented, _) => {
                self.phase = Phase::DownloadBegin;
                self.ask_for_place(0x21, announced.to_le_bytes());
            }
        }
    }

    fn begin_expedited_download(&mut self) {
        let mut data = [0; EXPEDITED];
        let length = self.data.len();
        data[..length].copy_from_slice(&self.data);
        self.confirmed = length;
        self.phase = Phase::DownloadBegin;
        self.ask_for_place(0x23 | ((EXPEDITED - length) as u8) << 2, data);
    }

    pub(super) fn download_begun(&mut self, answer: &Message) -> bool {
        if answer[0] & SERVICE != 0x60 || !self.is_for_us(answer) {
            return false;
        }
        let is_expedited = self.confirmed > 0;
        if is_expedited {
            self.done();
        } else {
            self.send_segment(0);
        }
        true
    }

    fn send_segment(&mut self, toggle: u8) {
        let rest = &self.data[self.confirmed..];
        let length = rest.len().min(SEGMENT);
        let is_last = length == rest.len();
        let command = toggle | ((SEGMENT - length) as u8) << 1 | u8::from(is_last);
        let message = segment(command, &rest[..length]);
        self.phase = Phase::DownloadSegment { toggle, length };
        self.ask(message);
    }

    pub(super) fn download_segment(&mut self, answer: &Message, toggle: u8, length: usize) -> bool {
        if answer[0] & SERVICE != 0x20 || Some(*answer) == self.last {
            return false;
        }
        if answer[0] & TOGGLE != toggle {
            self.give_up(AbortCode::TOGGLE_BIT, "the toggle bit of a confirmation is wrong");
            return true;
        }
        self.confirmed += length;
        if self.confirmed == self.data.len() {
            self.done();
        } else {
            self.send_segment(toggle ^ TOGGLE);
        }
        true
    }
}
