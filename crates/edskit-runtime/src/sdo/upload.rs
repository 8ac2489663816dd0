//! Uploads: the client reads, expedited or in segments.

use super::{Outcome, Refusal, Request, SEGMENT, Transfer, message, place_of};
use crate::context::Context;
use crate::dictionary::{Position, copy};
use edskit_types::{AbortCode, DataType, Index, SubIndex};

/// The most bytes of an expedited transfer.
const EXPEDITED: usize = 4;
const TOGGLE: u8 = 0x10;

/// Where the bytes of a value come from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    pub(super) index: Index,
    pub(super) sub_index: SubIndex,
    position: Position,
    origin: Origin,
    /// How many bytes there are; `None` for a DOMAIN that does not say.
    pub(super) length: Option<u32>,
}

#[derive(Clone, Copy, Debug)]
enum Origin {
    /// The server's buffer, into which the value was copied so that it cannot change meanwhile.
    Buffer,
    /// The dictionary: a value that does not fit into the buffer.
    Dictionary,
    /// The application.
    Domain,
}

impl Source {
    pub(super) fn refusal(self, code: AbortCode) -> Refusal {
        Refusal { code, index: self.index, sub_index: self.sub_index }
    }
}

/// An upload in segments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Upload {
    source: Source,
    /// How many bytes are sent.
    offset: u32,
    toggle: bool,
}

impl Upload {
    pub(super) fn place(self) -> (Index, SubIndex) {
        (self.source.index, self.source.sub_index)
    }
}

impl Context<'_> {
    /// Opens the value that a request names for reading.
    pub(super) fn open_source(&mut self, number: usize, request: &Request) -> Result<Source, Refusal> {
        let (index, sub_index) = place_of(request);
        let refusal = |code| Refusal { code, index, sub_index };
        let (position, entry) = self.open(index, sub_index).map_err(refusal)?;
        self.begin_read(entry).map_err(refusal)?;
        if entry.data_type == DataType::Domain {
            let length = self.app.domain_length(&mut self.objects, entry).map_err(refusal)?;
            return Ok(Source { index, sub_index, position, origin: Origin::Domain, length });
        }
        let share = self.share(number);
        let value = self.objects.bytes(position);
        let length = value.len();
        let buffer = self.buffers.get_mut(share).unwrap_or_default();
        let origin = if length <= buffer.len() { Origin::Buffer } else { Origin::Dictionary };
        copy(buffer, value);
        Ok(Source { index, sub_index, position, origin, length: Some(length as u32) })
    }

    /// Bytes of a value from `offset` on: how many were put into the segment, and whether they are the last ones.
    pub(super) fn read_source(
        &mut self,
        number: usize,
        source: Source,
        offset: u32,
        segment: &mut [u8; SEGMENT],
    ) -> Result<(usize, bool), Refusal> {
        let count = match source.origin {
            Origin::Domain => {
                let entry = self.objects.table.entry(source.position);
                let entry = entry.ok_or(source.refusal(AbortCode::OBJECT_DOES_NOT_EXIST))?;
                let read = self.app.read_domain(&mut self.objects, entry, offset, segment);
                read.map_err(|code| source.refusal(code))?.min(SEGMENT)
            }
            Origin::Buffer => {
                let length = source.length.unwrap_or_default() as usize;
                let value = self.buffer(number).get(offset as usize..length).unwrap_or_default();
                copy(segment, value);
                value.len().min(SEGMENT)
            }
            Origin::Dictionary => {
                let value = self.objects.bytes(source.position).get(offset as usize..).unwrap_or_default();
                copy(segment, value);
                value.len().min(SEGMENT)
            }
        };
        let end = offset + count as u32;
        let is_last = count < SEGMENT || source.length.is_some_and(|length| end >= length);
        Ok((count, is_last))
    }

    pub(super) fn begin_upload(&mut self, number: usize, request: &Request) -> Outcome {
        let source = self.open_source(number, request)?;
        self.begin_upload_of(number, source)
    }

    /// Answers with the value, or with its length and segments to come.
    pub(super) fn begin_upload_of(&mut self, number: usize, source: Source) -> Outcome {
        let (index, sub_index) = (source.index, source.sub_index);
        let length = source.length.map(|length| length as usize);
        if let Some(length @ 1..=EXPEDITED) = length {
            let mut segment = [0; SEGMENT];
            self.read_source(number, source, 0, &mut segment)?;
            let [a, b, c, d, ..] = segment;
            let mut data = [0; EXPEDITED];
            copy(data.get_mut(..length).unwrap_or_default(), &[a, b, c, d]);
            let command = 0x43 | ((EXPEDITED - length) as u8) << 2;
            self.respond(number, message(command, index, sub_index, data));
            return Ok(Transfer::None);
        }
        let (command, length) = match source.length {
            Some(length) => (0x41, length),
            None => (0x40, 0),
        };
        self.respond(number, message(command, index, sub_index, length.to_le_bytes()));
        Ok(Transfer::Upload(Upload { source, offset: 0, toggle: false }))
    }

    pub(super) fn upload_segment(&mut self, number: usize, upload: Upload, command: u8) -> Outcome {
        let Upload { source, offset, toggle } = upload;
        if (command & TOGGLE != 0) != toggle {
            return Err(source.refusal(AbortCode::TOGGLE_BIT));
        }
        let mut segment = [0; SEGMENT];
        let (count, is_last) = self.read_source(number, source, offset, &mut segment)?;
        let [a, b, c, d, e, f, g] = segment;
        let answer = (command & TOGGLE) | ((SEGMENT - count) as u8) << 1 | u8::from(is_last);
        self.respond(number, [answer, a, b, c, d, e, f, g]);
        if is_last {
            return Ok(Transfer::None);
        }
        Ok(Transfer::Upload(Upload { source, offset: offset + count as u32, toggle: !toggle }))
    }
}
