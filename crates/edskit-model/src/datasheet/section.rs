//! One section and its entries.

use super::{Datasheet, Description, Entry, Field, SectionRecord};
use crate::key::{Key, KeyName};
use crate::meant;
use crate::section::SectionKind;
use crate::{Line, Span};
use core::fmt;
use edskit_types::Index;
use std::borrow::Cow;

/// One section of the file.
#[derive(Clone, Copy)]
pub struct Section<'a> {
    pub(super) sheet: &'a Datasheet,
    pub(super) id: u32,
}

impl<'a> Section<'a> {
    /// The datasheet that the section belongs to.
    #[inline]
    pub fn sheet(self) -> &'a Datasheet {
        self.sheet
    }

    /// Position among all sections of the file.
    #[inline]
    pub fn id(self) -> u32 {
        self.id
    }

    /// The section that follows in the file.
    pub fn following(self) -> Option<Section<'a>> {
        let id = self.id + 1;
        ((id as usize) < self.sheet.sections.len()).then_some(Section { sheet: self.sheet, id })
    }

    #[inline]
    fn record(self) -> &'a SectionRecord {
        &self.sheet.sections[self.id as usize]
    }

    /// What the section is.
    #[inline]
    pub fn kind(self) -> SectionKind {
        self.record().kind
    }

    /// The attributes, where the section describes an object or a sub-object, of the device or of a module.
    pub fn description(self) -> Option<Description<'a>> {
        self.kind().is_description().then_some(Description { section: self })
    }

    /// Its header's line in the document, counted from 0.
    #[inline]
    pub fn line_number(self) -> usize {
        self.record().line as usize
    }

    /// Its header's line in the document.
    #[inline]
    pub fn line(self) -> &'a Line {
        &self.sheet.document.lines()[self.line_number()]
    }

    /// The name between the brackets, without blanks around it.
    pub fn name_span(self) -> Span {
        let source = self.sheet.document.to_bytes();
        let name = self.line().section_name(source);
        let trimmed = name.slice(source);
        let lead = trimmed.len() - trimmed.trim_ascii_start().len();
        name.sub(lead, trimmed.trim_ascii().len())
    }

    /// The name as written.
    pub fn name(self) -> Cow<'a, str> {
        self.sheet.document.text(self.name_span())
    }

    /// The header line without blanks around it.
    pub fn span(self) -> Span {
        self.line().trimmed(self.sheet.document.to_bytes())
    }

    /// Where a missing entry would stand: behind the last entry, or behind the header.
    pub fn end(self) -> Span {
        let line = self.entries().next_back().map_or(self.line(), Entry::line);
        Span::at(line.span().end)
    }

    /// The entries in the order of the file, doubled ones too.
    #[inline]
    pub fn entries(self) -> impl ExactSizeIterator<Item = Entry<'a>> + DoubleEndedIterator {
        let record = self.record();
        let sheet = self.sheet;
        (record.first_entry..record.end_entry).map(move |id| Entry { sheet, id })
    }

    /// The keys of the entries in the order of the file, doubled ones too.
    #[inline]
    pub fn keys(self) -> impl ExactSizeIterator<Item = Key> + DoubleEndedIterator {
        let record = self.record();
        let entries = &self.sheet.entries[record.first_entry as usize..record.end_entry as usize];
        entries.iter().map(|entry| entry.key)
    }

    /// The first entry with a key, empty or not.
    #[inline]
    pub fn entry(self, name: KeyName) -> Option<Entry<'a>> {
        let record = self.record();
        let entries = &self.sheet.entries[record.first_entry as usize..record.end_entry as usize];
        let position = entries.iter().position(|entry| entry.key.name == name)?;
        Some(Entry { sheet: self.sheet, id: record.first_entry + position as u32 })
    }

    /// The first entry with a key, if it has a value; an empty entry counts as none (CiA 306 v1.3, 4.2).
    #[inline]
    pub fn filled(self, name: KeyName) -> Option<Entry<'a>> {
        self.entry(name).filter(|entry| !entry.is_empty())
    }

    /// The first entry with a numbered key.
    pub fn numbered(self, name: KeyName, number: u16) -> Option<Entry<'a>> {
        self.entries().find(|entry| entry.key().name == name && entry.key().number == number)
    }

    /// The entries with a numbered key, in the order of the file.
    pub fn all_numbered(self, name: KeyName) -> impl Iterator<Item = Entry<'a>> {
        self.entries().filter(move |entry| entry.key().name == name)
    }

    /// The items of a list whose values are indices: the lists of objects, object links, fixed objects.
    pub fn items(self) -> impl Iterator<Item = ListItem<'a>> {
        self.all_numbered(KeyName::Item)
            .map(|entry| ListItem { number: entry.key().number, index: entry.unsigned::<u16>() })
    }
}

impl fmt::Debug for Section<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "[{}]", self.name())
    }
}

/// One item of a list of indices: `1=0x1000`.
#[derive(Clone, Copy, Debug)]
pub struct ListItem<'a> {
    /// The number that is its key, from 1 in a correct file.
    pub number: u16,
    /// The index that it names, as written; [`ListItem::meant`] knows better where `0x` was forgotten.
    pub index: Field<'a, u16>,
}

impl ListItem<'_> {
    /// The index that is meant: the one that is written, or what the same digits are with `0x`, where only that is a
    /// described object.
    pub fn meant(self) -> Option<Index> {
        self.without_prefix().or_else(|| self.index.known()).map(Index)
    }

    /// The hexadecimal index, where its `0x` was forgotten.
    pub(crate) fn without_prefix(self) -> Option<u16> {
        let sheet = self.index.entry.sheet;
        let is_described = |index: &u16| sheet.object(Index(*index)).is_some();
        if self.index.known().as_ref().is_some_and(is_described) {
            return None;
        }
        meant::without_prefix(self.index.entry.raw()).filter(is_described)
    }
}
