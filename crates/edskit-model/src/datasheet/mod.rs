//! The typed reading of a document.
//!
//! A [`Datasheet`] is a thin index over its [`Document`]: which sections there are, which keys they hold, and where
//! the objects are. Handles ([`Section`], [`Entry`], [`Object`], [`SubObject`]) are copies of a reference and a
//! number; values are read when they are asked for. So nothing that the file says is dropped, every value knows its
//! place, and a file that claims millions of compact sub-objects costs nothing until somebody asks for them.

mod assumed;
mod build;
mod channels;
mod compact;
mod compare;
mod decimal_names;
mod description;
mod entry;
mod identity;
mod info;
mod meaning;
mod modules;
mod object;
mod pdo;
mod section;
mod topology;
mod types;

pub use assumed::Assumed;
pub use channels::{Channel, ChannelOffset, Tool};
pub use compact::{DictionaryEntry, ImplicitPdo};
pub use compare::{Difference, same_meaning};
pub use description::Description;
pub use entry::{Entry, Field, Meant};
pub(crate) use identity::Identity;
pub use info::{Commissioning, DeviceInfo, FileInfo};
pub use modules::{Module, ModuleCount, SubExtension};
pub use object::{Object, SubObject};
pub use pdo::Pdo;
pub use section::{ListItem, Section};
pub use topology::{Topology, TopologyNode};
pub use types::ResolvedType;

use crate::key::{KEY_NAMES, Key, KeyName};
use crate::section::SectionKind;
use crate::{Document, Span};
use core::ops::RangeInclusive;
use edskit_types::{Index, SubIndex};
use std::borrow::Cow;

/// A CANopen EDS, DCF or nodelist.cpj file, read.
///
/// Where a section or a key stands twice, the first one counts; all of them can be seen through
/// [`Datasheet::sections`] and [`Section::entries`].
///
/// ```
/// use edskit_model::Datasheet;
/// use edskit_types::{DataType, Index};
/// let sheet = Datasheet::parse(b"[1017]\nParameterName=Heartbeat\nDataType=0x0006\nAccessType=rw\nDefaultValue=1000\n");
/// let heartbeat = sheet.object(Index(0x1017)).unwrap();
/// assert_eq!(heartbeat.standard_type(), Some(DataType::Unsigned16));
/// let default = heartbeat.default_value().unwrap();
/// assert_eq!(sheet.document().position(default.span().start).to_string(), "5:14");
/// assert_eq!(default.value.unwrap().integer(DataType::Unsigned16, None), Ok(1000));
/// ```
#[derive(Clone, Debug)]
pub struct Datasheet {
    document: Document,
    sections: Vec<SectionRecord>,
    entries: Vec<EntryRecord>,
    /// The first section of each index, sorted.
    objects: Vec<ObjectRecord>,
    /// The first section of each sub-object, sorted by index and sub-index.
    sub_objects: Vec<SubObjectRecord>,
    /// The first section of every other kind, sorted.
    others: Vec<(SectionKind, u32)>,
    /// Sections whose names have a decimal sub-index, ascending.
    decimal_names: Vec<u32>,
    /// Entries whose keys are in another case than that of CiA 306, ascending.
    unusual_keys: Vec<u32>,
    /// Which keys there are, by [`KeyName`].
    keys: [bool; KEY_NAMES],
}

#[derive(Clone, Copy, Debug)]
struct SectionRecord {
    line: u32,
    first_entry: u32,
    end_entry: u32,
    kind: SectionKind,
}

#[derive(Clone, Copy, Debug)]
struct EntryRecord {
    line: u32,
    key: Key,
}

#[derive(Clone, Copy, Debug)]
struct ObjectRecord {
    index: Index,
    section: u32,
    first_sub: u32,
    end_sub: u32,
}

#[derive(Clone, Copy, Debug)]
struct SubObjectRecord {
    index: Index,
    sub_index: SubIndex,
    section: u32,
}

impl Datasheet {
    /// Reads `bytes`, whatever they are.
    pub fn parse(bytes: &[u8]) -> Self {
        Self::new(Document::parse(bytes))
    }

    /// Reads a document.
    pub fn new(document: Document) -> Self {
        build::datasheet(document)
    }

    /// The text behind the datasheet.
    #[inline]
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The text of `span` for display.
    pub fn text(&self, span: Span) -> Cow<'_, str> {
        self.document.text(span)
    }

    /// Every section in the order of the file, doubled ones too.
    pub fn sections(&self) -> impl ExactSizeIterator<Item = Section<'_>> + DoubleEndedIterator {
        (0..self.sections.len() as u32).map(|id| Section { sheet: self, id })
    }

    /// Every entry of the file in order, with or without a section.
    pub fn entries(&self) -> impl ExactSizeIterator<Item = Entry<'_>> + DoubleEndedIterator {
        (0..self.entries.len() as u32).map(|id| Entry { sheet: self, id })
    }

    /// Whether some section is read by a decimal sub-index in its name.
    #[inline]
    pub fn has_decimal_sub_indices(&self) -> bool {
        !self.decimal_names.is_empty()
    }

    /// The entries whose keys are those of CiA 306 but for the case of letters, in the order of the file.
    pub fn unusual_keys(&self) -> impl ExactSizeIterator<Item = Entry<'_>> {
        self.unusual_keys.iter().map(|&id| Entry { sheet: self, id })
    }

    /// Whether some entry of the file has the key, in whatever section.
    #[inline]
    pub fn has_key(&self, name: KeyName) -> bool {
        self.keys[name as usize]
    }

    /// The entry on a line of the document, counted from 0.
    pub fn entry_on_line(&self, line: usize) -> Option<Entry<'_>> {
        let position = self.entries.binary_search_by_key(&line, |entry| entry.line as usize).ok()?;
        Some(Entry { sheet: self, id: position as u32 })
    }

    /// Whether some section of CiA 306 stands twice, in whatever spelling.
    pub fn has_repeated_sections(&self) -> bool {
        let unknown = self.sections.iter().filter(|section| section.kind == SectionKind::Unknown).count();
        self.objects.len() + self.sub_objects.len() + self.others.len() + unknown < self.sections.len()
    }

    /// Entries before the first section.
    pub fn entries_outside_sections(&self) -> impl ExactSizeIterator<Item = Entry<'_>> {
        let end = self.sections.first().map_or(self.entries.len() as u32, |section| section.first_entry);
        (0..end).map(|id| Entry { sheet: self, id })
    }

    /// The first section of a kind.
    pub fn section(&self, kind: SectionKind) -> Option<Section<'_>> {
        let id = match kind {
            SectionKind::Object(index) => self.objects.get(self.object_position(index)?)?.section,
            SectionKind::SubObject(index, sub_index) => {
                self.sub_objects.get(self.sub_object_position(index, sub_index)?)?.section
            }
            _ => {
                let position = self.others.binary_search_by_key(&kind, |&(kind, _)| kind).ok()?;
                self.others[position].1
            }
        };
        Some(Section { sheet: self, id })
    }

    /// The sections that are neither objects nor sub-objects, the first of each kind, sorted by kind.
    pub fn other_sections(&self) -> impl ExactSizeIterator<Item = Section<'_>> {
        self.others.iter().map(|&(_, id)| Section { sheet: self, id })
    }

    /// The section that holds a byte offset.
    pub fn section_at(&self, offset: u32) -> Option<Section<'_>> {
        let line = self.document.line_at(offset) as u32;
        let after = self.sections.partition_point(|section| section.line <= line);
        (after > 0).then(|| Section { sheet: self, id: after as u32 - 1 })
    }

    /// The described objects in ascending order.
    pub fn objects(&self) -> impl ExactSizeIterator<Item = Object<'_>> + DoubleEndedIterator {
        (0..self.objects.len() as u32).map(|position| Object::new(self, position))
    }

    /// The object at `index`.
    #[inline]
    pub fn object(&self, index: Index) -> Option<Object<'_>> {
        self.object_position(index).map(|position| Object::new(self, position as u32))
    }

    /// The described objects with an index in `indices`, in ascending order.
    pub fn objects_in(
        &self,
        indices: RangeInclusive<Index>,
    ) -> impl ExactSizeIterator<Item = Object<'_>> + DoubleEndedIterator {
        let first = self.objects.partition_point(|object| object.index < *indices.start());
        let end = self.objects.partition_point(|object| object.index <= *indices.end());
        (first as u32..end as u32).map(|position| Object::new(self, position))
    }

    /// All described sub-objects in ascending order, also those whose object is not described.
    pub fn sub_objects(&self) -> impl ExactSizeIterator<Item = SubObject<'_>> + DoubleEndedIterator {
        (0..self.sub_objects.len() as u32).map(|position| SubObject::new(self, position))
    }

    /// The described sub-object at `index` and `sub_index`; [`Datasheet::dictionary_entry`] also finds compact ones.
    pub fn sub_object(&self, index: Index, sub_index: SubIndex) -> Option<SubObject<'_>> {
        self.sub_object_position(index, sub_index).map(|position| SubObject::new(self, position as u32))
    }

    #[inline]
    fn object_position(&self, index: Index) -> Option<usize> {
        self.objects.binary_search_by_key(&index, |object| object.index).ok()
    }

    fn sub_object_position(&self, index: Index, sub_index: SubIndex) -> Option<usize> {
        self.sub_objects.binary_search_by_key(&(index, sub_index), |sub| (sub.index, sub.sub_index)).ok()
    }
}

#[cfg(test)]
mod tests;
