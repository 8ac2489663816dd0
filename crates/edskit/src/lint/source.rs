//! A file's text as a terminal can show it, with excerpts found without a walk from its start.

use crate::printable;
use edskit_model::{Document, Span};
use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};
use std::borrow::Cow;

/// Lines longer than this are not excerpted; nobody reads them in a terminal.
const LONGEST_LINE: usize = 400;

/// The text of a document for excerpts.
pub(crate) struct Source<'a> {
    name: String,
    document: &'a Document,
    text: Cow<'a, str>,
    /// For each byte of the document its offset in the text, where they differ.
    offsets: Option<Vec<u32>>,
}

impl<'a> Source<'a> {
    pub(crate) fn new(name: &str, document: &'a Document) -> Self {
        let bytes = document.to_bytes();
        let is_plain = |byte: &u8| (0x20..0x7F).contains(byte) || matches!(byte, b'\t' | b'\n' | b'\r');
        let lone_cr = document.count_of(edskit_model::LineEnding::Cr) > 0;
        let name = name.to_owned();
        if !lone_cr && bytes.iter().all(is_plain) {
            return Self { name, document, text: String::from_utf8_lossy(bytes), offsets: None };
        }
        let (text, offsets) = displayed(document);
        Self { name, document, text: Cow::Owned(text), offsets: Some(offsets) }
    }

    /// Where a span of the document stands in the text.
    pub(super) fn span(&self, span: Span) -> SourceSpan {
        let (start, end) = (self.offset(span.start), self.offset(span.end));
        SourceSpan::new(start.into(), end - start)
    }

    fn offset(&self, byte: u32) -> usize {
        match &self.offsets {
            Some(offsets) => offsets[byte as usize] as usize,
            None => byte as usize,
        }
    }

    /// Whether the lines of a span are short enough to show.
    pub(super) fn is_showable(&self, span: Span) -> bool {
        let lines = self.document.lines();
        let short = |line: usize| lines.get(line).is_none_or(|line| line.span().len() <= LONGEST_LINE);
        let (first, last) = (self.document.line_at(span.start), self.document.line_at(span.end));
        last - first < 50 && (first.saturating_sub(1)..=last + 1).all(short)
    }
}

/// The text with every control character replaced by its picture, so that a file cannot steer a terminal, and the
/// offset of each byte in it.
fn displayed(document: &Document) -> (String, Vec<u32>) {
    let mut text = String::with_capacity(document.to_bytes().len());
    let mut offsets = Vec::with_capacity(document.to_bytes().len() + 1);
    let mut show = |span: Span, is_ending: bool| {
        let bytes = document.slice(span);
        let decoded = document.text(span);
        let single = decoded.chars().count() == bytes.len();
        for character in decoded.chars() {
            let width = if single { 1 } else { character.len_utf8() };
            offsets.extend(std::iter::repeat_n(text.len() as u32, width));
            match character {
                '\r' if is_ending && bytes.len() == 1 => text.push('\n'),
                '\t' | '\n' | '\r' => text.push(character),
                _ => text.push(printable::character(character)),
            }
        }
    };
    if let Some(mark) = document.byte_order_mark() {
        // The mark is three bytes and one character that no terminal shows.
        show(mark, false);
    }
    for line in document.lines() {
        show(line.span(), false);
        show(line.ending_span(), true);
    }
    offsets.resize(document.to_bytes().len() + 1, text.len() as u32);
    (text, offsets)
}

impl<'a> Source<'a> {
    /// The span alone, by which an excerpt's heading finds its line and column.
    fn position_of(
        &self,
        span: &SourceSpan,
        line: usize,
    ) -> Result<Box<dyn SpanContents<'_> + '_>, MietteError> {
        let start = self.document.lines().get(line).map_or(0, |line| self.offset(line.span().start));
        let before = self.text.get(start..span.offset()).ok_or(MietteError::OutOfBounds)?;
        let inside =
            self.text.get(span.offset()..span.offset() + span.len()).ok_or(MietteError::OutOfBounds)?;
        let column = before.chars().count();
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            inside.as_bytes(),
            *span,
            line,
            column,
            1,
        )))
    }
}

impl SourceCode for Source<'_> {
    fn read_span<'b>(
        &'b self,
        span: &SourceSpan,
        context_lines_before: usize,
        context_lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'b> + 'b>, MietteError> {
        let lines = self.document.lines();
        let line_of = |offset: usize| match &self.offsets {
            None => self.document.line_at(offset as u32),
            Some(offsets) => {
                let byte = offsets.partition_point(|&start| start as usize <= offset).saturating_sub(1);
                self.document.line_at(byte as u32)
            }
        };
        if context_lines_before == 0 && context_lines_after == 0 {
            return self.position_of(span, line_of(span.offset()));
        }
        let last_line = lines.len().saturating_sub(1);
        let first = line_of(span.offset()).saturating_sub(context_lines_before);
        let last = (line_of(span.offset() + span.len().max(1) - 1) + context_lines_after).min(last_line);
        let start = lines.get(first).map_or(0, |line| self.offset(line.span().start));
        let end = lines.get(last).map_or(self.text.len(), |line| self.offset(line.full_span().end));
        if start > end || span.offset() + span.len() > self.text.len() {
            return Err(MietteError::OutOfBounds);
        }
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            &self.text.as_bytes()[start..end],
            (start, end - start).into(),
            first,
            0,
            last + 1 - first,
        )))
    }
}
