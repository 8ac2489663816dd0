//! The value that a transfer is about: opening it, and moving its bytes.

use super::{SEGMENT, Step};
use crate::Application;
use crate::context::Context;
use crate::dictionary::{Entry, Flags, Position, copy};
use core::ops::Range;
use edskit_types::{AbortCode, DataType, Index, SubIndex};

/// The value that a transfer is about, and how much of it is through.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    /// The entry; before it has been found, its index and sub-index.
    pub(super) entry: Entry,
    position: Position,
    origin: Origin,
    /// How many bytes there are; `None` while that is not known.
    pub(super) length: Option<u32>,
    /// How many bytes are sent and acknowledged, or have come.
    pub(super) offset: u32,
}

/// Where the bytes are while the transfer runs.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Origin {
    /// In the server's buffer: read ones so that they cannot change meanwhile, written ones until they are complete.
    Buffer,
    /// In the dictionary: a value to be read that does not fit into the buffer.
    Dictionary,
    /// With the application.
    Domain,
}

impl Item {
    pub(super) const NONE: Self = Self {
        entry: Entry::of_device(Index(0), SubIndex(0), DataType::Unsigned8, Flags::NONE, 0),
        position: Position(0),
        origin: Origin::Buffer,
        length: None,
        offset: 0,
    };

    /// Whether the value is a DOMAIN.
    pub(super) fn is_domain(&self) -> bool {
        self.origin == Origin::Domain
    }

    /// Whether a segment of so many bytes from `offset` on ends the value.
    pub(super) fn ends_with(&self, offset: u32, count: usize) -> bool {
        count < SEGMENT || self.length.is_some_and(|length| offset + count as u32 >= length)
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// Opens a value for reading.
    pub(super) fn open_source(&mut self, number: usize, item: &mut Item) -> Result<(), AbortCode> {
        let (position, entry) = self.open(item.entry.index, item.entry.sub_index)?;
        let entry = &entry;
        item.entry = *entry;
        item.position = position;
        item.offset = 0;
        self.begin_read(entry)?;
        if position == Position::OF_DEVICE && entry.data_type != DataType::Domain {
            return self.open_source_of_device(number, item);
        }
        if entry.data_type == DataType::Domain {
            item.origin = Origin::Domain;
            item.length = self.app.domain_length(&mut self.node, entry)?;
            return Ok(());
        }
        item.origin = Origin::Dictionary;
        item.length = Some(self.node.objects.bytes(position).len() as u32);
        Ok(())
    }

    /// Opens a value that the device has itself.
    #[inline(never)]
    fn open_source_of_device(&mut self, number: usize, item: &mut Item) -> Result<(), AbortCode> {
        // The buffer leaves the context while the device fills it.
        let share = self.share(number);
        let buffers = core::mem::take(&mut self.node.buffers);
        let buffer = buffers.get_mut(share).unwrap_or_default();
        let read = self.app.read_value(&mut self.node, &item.entry, buffer);
        let most = buffer.len();
        self.node.buffers = buffers;
        item.origin = Origin::Buffer;
        item.length = Some(read?.min(most) as u32);
        Ok(())
    }

    /// Keeps a value that is not answered at once from changing while it is read.
    pub(super) fn hold_source(&mut self, number: usize, item: &mut Item) {
        let share = self.share(number);
        let value = self.node.objects.bytes(item.position);
        let buffer = self.node.buffers.get_mut(share).unwrap_or_default();
        if item.origin == Origin::Dictionary && value.len() <= buffer.len() {
            item.origin = Origin::Buffer;
            copy(buffer, value);
        }
    }

    /// Reads bytes of a value from `offset` on, as many as there are and fit, and says how many.
    pub(super) fn read_item(
        &mut self,
        number: usize,
        item: &Item,
        offset: u32,
        segment: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let value = match item.origin {
            Origin::Domain => {
                let read = self.app.read_domain(&mut self.node, &item.entry, offset, segment)?;
                return Ok(read.min(segment.len()));
            }
            Origin::Buffer => self.buffer(number),
            Origin::Dictionary => self.node.objects.bytes(item.position),
        };
        let end = value.len().min(item.length.unwrap_or_default() as usize);
        let value = value.get(offset as usize..end).unwrap_or_default();
        copy(segment, value);
        Ok(value.len().min(segment.len()))
    }

    /// Opens an entry for writing so many bytes; `None` where the client does not say how many.
    pub(super) fn open_target(&mut self, item: &mut Item, announced: Option<u32>) -> Result<(), AbortCode> {
        let (position, entry) = self.open(item.entry.index, item.entry.sub_index)?;
        let entry = &entry;
        item.entry = *entry;
        self.app.check_write(&self.node, entry, announced.map(|length| length as usize))?;
        item.position = position;
        item.origin = if entry.data_type == DataType::Domain { Origin::Domain } else { Origin::Buffer };
        item.length = announced;
        item.offset = 0;
        Ok(())
    }

    /// Takes further bytes of a value. Those of a DOMAIN go to the application at once.
    pub(super) fn append(&mut self, number: usize, item: &mut Item, data: &[u8]) -> Result<(), AbortCode> {
        let entry = &item.entry;
        let offset = item.offset;
        let end = offset.saturating_add(data.len() as u32);
        if item.origin == Origin::Domain {
            self.app.write_domain(&mut self.node, entry, offset, data, false)?;
        } else {
            if end > u32::from(entry.size) {
                return Err(AbortCode::LENGTH_TOO_HIGH);
            }
            let place = self.buffer(number).get_mut(offset as usize..end as usize);
            copy(place.ok_or(AbortCode::OUT_OF_MEMORY)?, data);
        }
        item.offset = end;
        Ok(())
    }

    /// Writes the value that has come.
    pub(super) fn finish(&mut self, number: usize, item: &Item) -> Step {
        if let Some(announced) = item.length {
            if announced > item.offset {
                return Err(AbortCode::LENGTH_TOO_LOW);
            }
            if announced < item.offset {
                return Err(AbortCode::LENGTH_TOO_HIGH);
            }
        }
        let entry = &item.entry;
        if item.origin == Origin::Domain {
            self.app.write_domain(&mut self.node, entry, item.offset, &[], true)?;
            self.app.after_write(&mut self.node, entry);
        } else {
            // The buffer leaves the context while the value is written, since hooks get the rest of it.
            let share = self.share(number);
            let buffers = core::mem::take(&mut self.node.buffers);
            let value = buffers.get(share).and_then(|buffer| buffer.get(..item.offset as usize));
            let written = self.write(item.position, entry, value.unwrap_or_default());
            self.node.buffers = buffers;
            written?;
        }
        Ok(super::Next::End)
    }

    /// Where in the buffers the part of a server lies: all parts are equal.
    fn share(&self, number: usize) -> Range<usize> {
        let size = self.node.buffers.len().checked_div(self.node.servers.len()).unwrap_or(0);
        number * size..(number + 1) * size
    }

    /// The part of the buffers that belongs to a server.
    fn buffer(&mut self, number: usize) -> &mut [u8] {
        let share = self.share(number);
        self.node.buffers.get_mut(share).unwrap_or_default()
    }
}
