//! Uploads: the client reads, expedited or in segments.

use super::{EXPEDITED, Item, Next, SEGMENT, Session, Step, TOGGLE, Transfer};
use crate::Application;
use crate::context::Context;
use edskit_types::AbortCode;

impl<A: Application + ?Sized> Context<'_, A> {
    pub(super) fn begin_upload(&mut self, number: usize, session: &mut Session) -> Step {
        self.open_source(number, &mut session.item)?;
        self.begin_upload_of(number, session)
    }

    /// Answers with the value, or with its length and segments to come.
    pub(super) fn begin_upload_of(&mut self, number: usize, session: &mut Session) -> Step {
        let item = &mut session.item;
        let mut data = [0; EXPEDITED];
        if let Some(length) = item.length
            && let Some(place) = data.get_mut(..length as usize).filter(|place| !place.is_empty())
        {
            self.read_item(number, item, 0, place)?;
            let command = 0x43 | ((EXPEDITED - length as usize) as u8) << 2;
            self.answer_about(number, command, item, data);
            return Ok(Next::End);
        }
        if !self.node.core.settings.has_segmented_transfer {
            return Err(AbortCode::UNKNOWN_COMMAND);
        }
        self.hold_source(number, item);
        let command = 0x40 | u8::from(item.length.is_some());
        self.answer_about(number, command, item, item.length.unwrap_or(0).to_le_bytes());
        session.transfer = Transfer::Upload { toggle: 0 };
        Ok(Next::Request)
    }

    pub(super) fn upload_segment(
        &mut self,
        number: usize,
        item: &mut Item,
        toggle: &mut u8,
        command: u8,
    ) -> Step {
        super::take_toggle(toggle, command)?;
        let mut segment = [0; SEGMENT];
        let count = self.read_item(number, item, item.offset, &mut segment)?;
        let is_last = item.ends_with(item.offset, count);
        item.offset += count as u32;
        let [a, b, c, d, e, f, g] = segment;
        let answer = (command & TOGGLE) | ((SEGMENT - count) as u8) << 1 | u8::from(is_last);
        self.respond(number, [answer, a, b, c, d, e, f, g]);
        Ok(if is_last { Next::End } else { Next::Request })
    }
}
