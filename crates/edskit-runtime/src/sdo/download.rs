//! Downloads: the client writes, expedited or in segments.

use super::{Outcome, Refusal, Request, SEGMENT, Transfer, message, number_of, place_of};
use crate::context::Context;
use crate::dictionary::{Entry, Position, copy};
use edskit_types::{AbortCode, DataType, Index, SubIndex};

const TOGGLE: u8 = 0x10;
/// The largest value that no buffer has to hold.
const SMALL: usize = 8;

/// Where the bytes of a value go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Target {
    pub(super) index: Index,
    pub(super) sub_index: SubIndex,
    position: Position,
    is_domain: bool,
    /// How many bytes the client has announced.
    announced: Option<u32>,
    /// How many bytes have come.
    pub(super) received: u32,
    /// A value without a place in the buffers.
    small: [u8; SMALL],
}

impl Target {
    pub(super) fn refusal(self, code: AbortCode) -> Refusal {
        Refusal { code, index: self.index, sub_index: self.sub_index }
    }
}

/// A download in segments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Download {
    target: Target,
    toggle: bool,
}

impl Download {
    pub(super) fn place(self) -> (Index, SubIndex) {
        (self.target.index, self.target.sub_index)
    }
}

impl<'a> Context<'a> {
    /// Opens the entry that a request names for writing.
    pub(super) fn open_target(
        &mut self,
        request: &Request,
        announced: Option<u32>,
    ) -> Result<Target, Refusal> {
        let (index, sub_index) = place_of(request);
        let refusal = |code| Refusal { code, index, sub_index };
        let (position, entry) = self.open(index, sub_index).map_err(refusal)?;
        let length = announced.map(|length| length as usize);
        self.objects.check_write(entry, length).map_err(refusal)?;
        let is_domain = entry.data_type == DataType::Domain;
        Ok(Target { index, sub_index, position, is_domain, announced, received: 0, small: [0; SMALL] })
    }

    fn entry_of(&self, target: &Target) -> Result<&'a Entry, Refusal> {
        let entry = self.objects.table.entry(target.position);
        entry.ok_or(target.refusal(AbortCode::OBJECT_DOES_NOT_EXIST))
    }

    /// Takes further bytes of a value. Those of a DOMAIN go to the application at once.
    pub(super) fn append(&mut self, number: usize, target: &mut Target, data: &[u8]) -> Result<(), Refusal> {
        let entry = self.entry_of(target)?;
        let offset = target.received;
        let end = offset.saturating_add(data.len() as u32);
        if target.is_domain {
            let written = self.app.write_domain(&mut self.objects, entry, offset, data, false);
            written.map_err(|code| target.refusal(code))?;
        } else {
            if end > u32::from(entry.size) {
                return Err(target.refusal(AbortCode::LENGTH_TOO_HIGH));
            }
            let place =
                if usize::from(entry.size) <= SMALL { &mut target.small[..] } else { self.buffer(number) };
            let place = place.get_mut(offset as usize..end as usize);
            copy(
                place.ok_or(Refusal {
                    code: AbortCode::OUT_OF_MEMORY,
                    index: target.index,
                    sub_index: target.sub_index,
                })?,
                data,
            );
        }
        target.received = end;
        Ok(())
    }

    /// Writes the value that has come.
    pub(super) fn finish(&mut self, number: usize, target: &Target) -> Result<(), Refusal> {
        match target.announced {
            Some(announced) if announced > target.received => {
                return Err(target.refusal(AbortCode::LENGTH_TOO_LOW));
            }
            Some(announced) if announced < target.received => {
                return Err(target.refusal(AbortCode::LENGTH_TOO_HIGH));
            }
            _ => {}
        }
        let entry = self.entry_of(target)?;
        let refusal = |code| target.refusal(code);
        if target.is_domain {
            let last = self.app.write_domain(&mut self.objects, entry, target.received, &[], true);
            last.map_err(refusal)?;
            self.app.after_write(&mut self.objects, entry);
            return Ok(());
        }
        let length = target.received as usize;
        if usize::from(entry.size) <= SMALL {
            return self
                .write(target.position, entry, target.small.get(..length).unwrap_or_default())
                .map_err(refusal);
        }
        // The buffer leaves the context while the value is written, since hooks get the rest of it.
        let share = self.share(number);
        let buffers = core::mem::take(&mut self.buffers);
        let value = buffers.get(share.start..share.start + length).unwrap_or_default();
        let written = self.write(target.position, entry, value);
        self.buffers = buffers;
        written.map_err(refusal)
    }

    pub(super) fn begin_download(&mut self, number: usize, request: &Request) -> Outcome {
        let [command, _, _, _, a, b, c, d] = *request;
        let (is_expedited, says_length) = (command & 2 != 0, command & 1 != 0);
        if !is_expedited {
            let target = self.open_target(request, says_length.then(|| number_of(request)))?;
            self.respond(number, message(0x60, target.index, target.sub_index, [0; 4]));
            return Ok(Transfer::Download(Download { target, toggle: false }));
        }
        let announced = says_length.then(|| 4 - u32::from(command >> 2 & 3));
        let mut target = self.open_target(request, announced)?;
        let size = u32::from(self.entry_of(&target)?.size);
        // Without a length, so many bytes count as the entry has.
        let length = announced.unwrap_or(size.min(4)) as usize;
        let data = [a, b, c, d];
        self.append(number, &mut target, data.get(..length).unwrap_or_default())?;
        self.finish(number, &target)?;
        self.respond(number, message(0x60, target.index, target.sub_index, [0; 4]));
        Ok(Transfer::None)
    }

    pub(super) fn download_segment(
        &mut self,
        number: usize,
        download: Download,
        request: &Request,
    ) -> Outcome {
        let Download { mut target, toggle } = download;
        let [command, data @ ..] = *request;
        if (command & TOGGLE != 0) != toggle {
            return Err(target.refusal(AbortCode::TOGGLE_BIT));
        }
        let length = SEGMENT - usize::from(command >> 1 & 7);
        self.append(number, &mut target, data.get(..length).unwrap_or_default())?;
        let is_last = command & 1 != 0;
        if is_last {
            self.finish(number, &target)?;
        }
        self.respond(number, [0x20 | (command & TOGGLE), 0, 0, 0, 0, 0, 0, 0]);
        Ok(if is_last { Transfer::None } else { Transfer::Download(Download { target, toggle: !toggle }) })
    }
}
