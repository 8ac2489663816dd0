//! `[DynamicChannels]` and `[Tools]` (CiA 306-3; CiA 302-4 and 405 before it).

use super::{Datasheet, Entry, Field};
use crate::key::KeyName;
use crate::section::SectionKind;
use crate::value::Number;
use edskit_types::{AccessType, Index};

/// One segment of dynamic network variables.
#[derive(Clone, Copy, Debug)]
pub struct Channel<'a> {
    /// The segment's number, from 1.
    pub number: u16,
    /// `TypeX`: the index of the data type.
    pub data_type: Option<Field<'a, u16>>,
    /// `DirX`: the access.
    pub direction: Option<Field<'a, AccessType>>,
    /// `RangeX`: the entry as it stands; [`Channel::indices`] reads it.
    pub range: Option<Entry<'a>>,
    /// `PPOffsetX`: the entry as it stands; [`Channel::process_image_offset`] reads it.
    pub offset: Option<Entry<'a>>,
}

/// Where a segment lies in the process image.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ChannelOffset {
    /// Offset of the first variable.
    pub offset: u32,
    /// Distance of the addresses of two variables, for segments of BOOLEAN.
    pub difference: Option<u32>,
}

impl Channel<'_> {
    /// `RangeX`: the first and the last index; `None` where the text is no range.
    pub fn indices(&self) -> Option<(Index, Index)> {
        let (first, last) = split_once(self.range?.raw(), b'-')?;
        Some((Index(number(first)?), Index(number(last)?)))
    }

    /// `PPOffsetX`; `None` where the text is no offset.
    pub fn process_image_offset(&self) -> Option<ChannelOffset> {
        let raw = self.offset?.raw();
        match split_once(raw, b',') {
            Some((offset, difference)) => {
                Some(ChannelOffset { offset: number(offset)?, difference: Some(number(difference)?) })
            }
            None => Some(ChannelOffset { offset: number(raw)?, difference: None }),
        }
    }
}

/// One tool of `[Tools]`.
#[derive(Clone, Copy, Debug)]
pub struct Tool<'a> {
    /// The number of its section.
    pub number: u16,
    /// `Name`
    pub name: Option<Entry<'a>>,
    /// `Command`: a command line with the placeholders `$DCF`, `$EDS` and `$NODEID`.
    pub command: Option<Entry<'a>>,
}

impl Datasheet {
    /// The segments of `[DynamicChannels]`, as many as NrOfSeg says.
    pub fn dynamic_channels(&self) -> impl Iterator<Item = Channel<'_>> {
        let section = self.section(SectionKind::DynamicChannels);
        let count = section.and_then(|section| section.filled(KeyName::NrOfSeg)?.unsigned::<u8>().known());
        let numbers = 1..=u16::from(count.unwrap_or(0));
        section.into_iter().zip([numbers]).flat_map(|(section, numbers)| {
            numbers.map(move |number| {
                let entry = |name| section.numbered(name, number).filter(|entry| !entry.is_empty());
                Channel {
                    number,
                    data_type: entry(KeyName::Type).map(Entry::unsigned),
                    direction: entry(KeyName::Dir).map(Entry::access_type),
                    range: entry(KeyName::Range),
                    offset: entry(KeyName::PpOffset),
                }
            })
        })
    }

    /// The tools that have a section `[ToolX]`, in ascending order.
    pub fn tools(&self) -> impl Iterator<Item = Tool<'_>> {
        self.other_sections().filter_map(|section| match section.kind() {
            SectionKind::Tool(number) => Some(Tool {
                number,
                name: section.filled(KeyName::Name),
                command: section.filled(KeyName::Command),
            }),
            _ => None,
        })
    }
}

fn split_once(text: &[u8], separator: u8) -> Option<(&[u8], &[u8])> {
    let position = text.iter().position(|&byte| byte == separator)?;
    Some((&text[..position], &text[position + 1..]))
}

fn number<T: TryFrom<u64>>(text: &[u8]) -> Option<T> {
    Number::parse(text.trim_ascii()).ok()?.to()
}
