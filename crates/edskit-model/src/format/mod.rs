//! The canonical text of a file.
//!
//! There is one form and no option. What a file says stays the same, and formatting twice changes nothing more:
//!
//! - Sections and entries stand in one order, by the lists of objects and by what most files do (see [`order`]).
//! - Names of sections and keys are spelled as in CiA 306; values keep their bytes, but for the case and the width of
//!   hexadecimal numbers, the order of formulas and the case of access types (see [`value`]).
//! - No blanks around `=`, at the start or at the end of a line. One blank line between sections and no other, a line
//!   ending at the end of the file. All line endings are those of most lines. No byte order mark.
//! - A comment travels with the section or entry directly below it. Comments at the start and at the end of the file
//!   stay there. One that only touches the entry above it stays at the end of that section.
//! - A section with an error in its syntax is left as it is, its place behind the section before it included. So is
//!   text before the first section, and a whole file with the markers of a merge conflict.
//! - Doubled sections and entries all stay, the first one first.

mod layout;
mod order;
mod value;

use crate::Datasheet;
use crate::datasheet::Section;
use crate::document::{Document, Line, LineKind, UTF8_BOM, is_merge_marker};
use layout::{Block, Layout, Lines};

/// The canonical text of a file.
///
/// ```
/// use edskit_model::{Datasheet, format};
/// let sheet = Datasheet::parse(b"[1000]\nAccessType = RO\ndatatype=0x7\nParameterName=Type ");
/// assert_eq!(format(&sheet), b"[1000]\nParameterName=Type\nDataType=0x0007\nAccessType=ro\n");
/// ```
pub fn format(sheet: &Datasheet) -> Vec<u8> {
    try_format(sheet).unwrap_or_else(|_| sheet.document().to_bytes().to_vec())
}

/// Why a file has no canonical text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Unformattable {
    /// The marker of a merge conflict stands in this line, counted from 0: two texts stand in the place of one.
    Conflict(usize),
    /// It is larger than what is split into lines; see [`Document::is_complete`].
    TooLarge,
    /// A byte order mark in the midst of the file would come to its start.
    ByteOrderMark,
}

/// The canonical text of a file, or why it has none.
///
/// # Errors
/// [`Unformattable`] says what has to be mended before.
pub fn try_format(sheet: &Datasheet) -> Result<Vec<u8>, Unformattable> {
    let document = sheet.document();
    if !document.is_complete() {
        return Err(Unformattable::TooLarge);
    }
    if let Some(line) = document.lines().iter().position(|line| is_conflict_marker(document, line)) {
        return Err(Unformattable::Conflict(line));
    }
    let layout = Layout::of(sheet);
    let order = order::sections(sheet, &layout.blocks);
    let mut writer = Writer::new(document);

    writer.copy(layout.preamble);
    writer.comments(layout.after_preamble);
    for paragraph in layout.top {
        writer.paragraph(paragraph);
    }
    let last = layout.blocks.len().saturating_sub(1);
    // What is directly above the first header stays at the top, and what is directly below the last section stays at
    // the end, even where the section moves.
    let mut end = Vec::new();
    if order.first().is_some_and(|&first| first != 0) {
        writer.paragraph(layout.blocks[0].lead.clone());
    }
    if order.last().is_some_and(|&position| position != last) {
        end.push(layout.blocks[last].tail.clone());
    }
    let sections: Vec<Section<'_>> = sheet.sections().collect();
    for (place, &position) in order.iter().enumerate() {
        let block = &layout.blocks[position];
        for paragraph in &block.paragraphs {
            writer.paragraph(paragraph.clone());
        }
        writer.separate();
        if position != 0 || place == 0 {
            writer.comments(block.lead.clone());
        }
        writer.body(sections[position], block);
        if position != last || place == last {
            writer.comments(block.tail.clone());
        }
    }
    for paragraph in end.into_iter().chain(layout.end) {
        writer.paragraph(paragraph);
    }
    // A mark that was not the first thing in the file must not become it.
    if writer.text.starts_with(UTF8_BOM) { Err(Unformattable::ByteOrderMark) } else { Ok(writer.text) }
}

fn is_conflict_marker(document: &Document, line: &Line) -> bool {
    line.kind() == LineKind::Other && is_merge_marker(document.slice(line.span()))
}

/// Puts the text together.
struct Writer<'a> {
    lines: &'a [Line],
    source: &'a [u8],
    ending: &'static str,
    text: Vec<u8>,
}

impl<'a> Writer<'a> {
    fn new(document: &'a Document) -> Self {
        let source = document.to_bytes();
        let text = Vec::with_capacity(source.len() + source.len() / 16);
        Self { lines: document.lines(), source, ending: document.line_ending().as_str(), text }
    }

    fn end_line(&mut self) {
        self.text.extend_from_slice(self.ending.as_bytes());
    }

    /// A blank line, except at the start of the file.
    fn separate(&mut self) {
        if !self.text.is_empty() {
            self.end_line();
        }
    }

    /// Lines as they are, but for their endings.
    fn copy(&mut self, lines: Lines) {
        for line in &self.lines[lines] {
            self.text.extend_from_slice(line.span().slice(self.source));
            self.end_line();
        }
    }

    /// Those of the lines that are comments.
    fn comments(&mut self, lines: Lines) {
        for line in self.lines[lines].iter().filter(|line| line.kind() == LineKind::Comment) {
            self.text.extend_from_slice(line.trimmed(self.source).slice(self.source));
            self.end_line();
        }
    }

    /// Comments with a blank line before them.
    fn paragraph(&mut self, lines: Lines) {
        if !lines.is_empty() {
            self.separate();
            self.comments(lines);
        }
    }

    /// The header and the entries of a section, with the comments above each.
    fn body(&mut self, section: Section<'_>, block: &Block) {
        if block.is_frozen {
            self.copy(block.body.clone());
            return;
        }
        let name = section.name_span().slice(self.source);
        let canonical = section.kind().canonical_name();
        self.text.push(b'[');
        self.text.extend_from_slice(canonical.as_deref().map_or(name, str::as_bytes));
        self.text.push(b']');
        self.end_line();

        let entries: Vec<_> = section.entries().collect();
        let data_type = section.value_type();
        for position in order::entries(section) {
            let entry = entries[position];
            let above = match position.checked_sub(1) {
                Some(previous) => entries[previous].line_number(),
                None => section.line_number(),
            };
            self.comments(above + 1..entry.line_number());
            let key = entry.key();
            match key.canonical() {
                Some(canonical) => self.text.extend_from_slice(canonical.as_bytes()),
                None => self.text.extend_from_slice(entry.key_span().slice(self.source)),
            }
            self.text.push(b'=');
            self.text.extend_from_slice(&value::canonical(section.kind(), key.name, data_type, entry.raw()));
            self.end_line();
        }
    }
}

#[cfg(test)]
mod tests;
