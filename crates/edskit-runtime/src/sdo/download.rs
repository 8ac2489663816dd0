//! Downloads: the client writes, expedited or in segments.

use super::{
    EXPEDITED, Item, Next, Request, SEGMENT, Session, Step, TOGGLE, Transfer, number_of, take_toggle,
};
use crate::Application;
use crate::context::Context;
use edskit_types::{AbortCode, DataType};

impl<A: Application + ?Sized> Context<'_, A> {
    pub(super) fn begin_download(&mut self, number: usize, session: &mut Session, request: &Request) -> Step {
        let [command, _, _, _, data @ ..] = request;
        let (is_expedited, says_length) = (command & 2 != 0, command & 1 != 0);
        let item = &mut session.item;
        let next = if is_expedited {
            let announced = says_length.then(|| EXPEDITED as u32 - u32::from(command >> 2 & 3));
            self.open_target(item, announced)?;
            let entry = &item.entry;
            // Without a length, so many bytes count as the type has; where that fixes none, all four.
            let is_fixed = entry.data_type != DataType::Domain && !entry.data_type.is_string();
            let size = if is_fixed { u32::from(entry.size) } else { EXPEDITED as u32 };
            let length = announced.unwrap_or(size).min(EXPEDITED as u32) as usize;
            self.append(number, item, data.get(..length).unwrap_or_default())?;
            self.finish(number, item)?
        } else if !self.node.core.settings.has_segmented_transfer {
            return Err(AbortCode::UNKNOWN_COMMAND);
        } else {
            self.open_target(item, says_length.then(|| number_of(request)))?;
            session.transfer = Transfer::Download { toggle: 0 };
            Next::Request
        };
        self.answer_about(number, 0x60, item, [0; 4]);
        Ok(next)
    }

    pub(super) fn download_segment(
        &mut self,
        number: usize,
        item: &mut Item,
        toggle: &mut u8,
        request: &Request,
    ) -> Step {
        let [command, data @ ..] = request;
        take_toggle(toggle, *command)?;
        let length = SEGMENT - usize::from(command >> 1 & 7);
        self.append(number, item, data.get(..length).unwrap_or_default())?;
        let next = if command & 1 != 0 { self.finish(number, item)? } else { Next::Request };
        self.respond(number, [0x20 | (command & TOGGLE), 0, 0, 0, 0, 0, 0, 0]);
        Ok(next)
    }
}
