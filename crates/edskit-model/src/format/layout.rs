//! How a file is divided for the formatter: what belongs to which section, and what is left alone.

use crate::datasheet::{Datasheet, Section};
use crate::document::{LineKind, is_merge_marker};
use core::ops::Range;

/// Lines by their number, counted from 0.
pub(super) type Lines = Range<usize>;

/// A file in pieces. Blank lines between the pieces are forgotten.
pub(super) struct Layout {
    /// Entries and other lines before the first section, with what stands between them.
    pub(super) preamble: Lines,
    /// Comments that follow the preamble without a blank line.
    pub(super) after_preamble: Lines,
    /// Comments before the first section and not directly above it, in paragraphs.
    pub(super) top: Vec<Lines>,
    /// The sections in the order of the file.
    pub(super) blocks: Vec<Block>,
    /// Comments at the end of the file that no section is directly above, in paragraphs.
    pub(super) end: Vec<Lines>,
}

/// A section with the comments that belong to it.
#[derive(Default)]
pub(super) struct Block {
    /// Comments above the section with a blank line between, in paragraphs.
    pub(super) paragraphs: Vec<Lines>,
    /// Comments directly above the header.
    pub(super) lead: Lines,
    /// The header and everything to the last entry or other line.
    pub(super) body: Lines,
    /// Comments directly below the body.
    pub(super) tail: Lines,
    /// Whether the body holds an error in its syntax, so that it is copied as it is.
    pub(super) is_frozen: bool,
}

impl Layout {
    pub(super) fn of(sheet: &Datasheet) -> Self {
        let lines = sheet.document().lines();
        let kind = |line: usize| lines[line].kind();
        let headers: Vec<usize> = sheet.sections().map(Section::line_number).collect();
        let first = headers.first().copied().unwrap_or(lines.len());
        let has_content = |&line: &usize| matches!(kind(line), LineKind::Entry | LineKind::Other);
        let preamble = match (0..first).rev().find(has_content) {
            Some(last) => (0..last).find(|&line| kind(line) != LineKind::Blank).unwrap_or(last)..last + 1,
            None => 0..0,
        };
        let mut layout =
            Self { preamble, after_preamble: 0..0, top: Vec::new(), blocks: Vec::new(), end: Vec::new() };
        layout.blocks.reserve(headers.len());

        let mut gap = Gap::of(sheet, layout.preamble.end..first);
        if !layout.preamble.is_empty() {
            layout.after_preamble = gap.take_first(headers.is_empty());
        }
        let mut lead = if headers.is_empty() { 0..0 } else { gap.take_last() };
        layout.top = gap.paragraphs;
        let mut paragraphs = Vec::new();
        for (position, section) in sheet.sections().enumerate() {
            let next = headers.get(position + 1).copied();
            let start = headers[position];
            let stop = next.unwrap_or(lines.len());
            let last = (start + 1..stop).rev().find(has_content).unwrap_or(start);
            let body = start..last + 1;
            let mut gap = Gap::of(sheet, last + 1..stop);
            layout.blocks.push(Block {
                paragraphs: std::mem::take(&mut paragraphs),
                lead: std::mem::take(&mut lead),
                is_frozen: is_frozen(section, &body),
                body,
                tail: gap.take_first(next.is_none()),
            });
            if next.is_some() {
                lead = gap.take_last();
            }
            paragraphs = gap.paragraphs;
        }
        if !layout.blocks.is_empty() {
            layout.end = paragraphs;
        }
        layout
    }
}

/// The comments between the last entry of a section and the next header.
struct Gap {
    /// Comments without a blank line between them, taken one by one.
    paragraphs: Vec<Lines>,
    touches_start: bool,
    touches_end: bool,
}

impl Gap {
    fn of(sheet: &Datasheet, range: Lines) -> Self {
        let lines = sheet.document().lines();
        let mut paragraphs: Vec<Lines> = Vec::new();
        for line in range.clone().filter(|&line| lines[line].kind() == LineKind::Comment) {
            match paragraphs.last_mut() {
                Some(last) if last.end == line => last.end = line + 1,
                _ => paragraphs.push(line..line + 1),
            }
        }
        let touches_start = paragraphs.first().is_some_and(|first| first.start == range.start);
        let touches_end = paragraphs.last().is_some_and(|last| last.end == range.end);
        Self { paragraphs, touches_start, touches_end }
    }

    /// Takes the paragraph out that directly follows what is above. One that also touches the header below belongs
    /// there, unless the file ends here.
    fn take_first(&mut self, is_end_of_file: bool) -> Lines {
        let belongs_below = self.paragraphs.len() == 1 && self.touches_end && !is_end_of_file;
        if self.touches_start && !belongs_below { self.paragraphs.remove(0) } else { 0..0 }
    }

    /// Takes the paragraph out that stands directly above the header below.
    fn take_last(&mut self) -> Lines {
        if self.touches_end { self.paragraphs.pop().unwrap_or(0..0) } else { 0..0 }
    }
}

/// Whether a section is copied as it is: its header is malformed, or a line of it is neither entry nor comment.
fn is_frozen(section: Section<'_>, body: &Lines) -> bool {
    let document = section.sheet().document();
    let source = document.to_bytes();
    let header = section.line();
    let lines = &document.lines()[body.clone()];
    header.closing_bracket().is_none()
        || !header.after_header(source).is_empty()
        || section.name_span().is_empty()
        // An indented entry may look like the marker of a merge conflict once the blanks are gone.
        || lines.iter().any(|line| match line.kind() {
            LineKind::Other => true,
            LineKind::Entry => is_merge_marker(line.trimmed(source).slice(source)),
            _ => false,
        })
}
