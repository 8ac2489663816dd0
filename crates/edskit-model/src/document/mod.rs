//! The lossless text of a file: bytes, lines, encoding, positions.
//!
//! A [`Document`] is flat and line-based. Every line of the file is one [`Line`]: a section header, an entry, a
//! comment, a blank line, or none of these. Lines tile the file: nothing is dropped, whatever the input.

mod encoding;
mod lex;
mod line;
mod position;

pub use encoding::Encoding;
pub(crate) use encoding::UTF8_BOM;
pub use lex::is_merge_marker;
pub use line::{Line, LineEnding, LineKind};
pub use position::Position;

use crate::Span;
use line::LINE_KINDS;
use std::borrow::Cow;

/// The most bytes that are lexed; spans are 32 bits wide.
const MAX_LEXED: usize = u32::MAX as usize - 1;

/// A file as it was read: its bytes, and what each line is.
///
/// Parsing never fails and `to_bytes` gives back exactly what was parsed:
///
/// ```
/// let bytes = b"[FileInfo]\r\nFileName = a.eds\r\nwhat is this\n";
/// let document = edskit_model::Document::parse(bytes);
/// assert_eq!(document.to_bytes(), bytes);
/// assert_eq!(document.lines().len(), 3);
/// ```
#[derive(Clone, Debug)]
pub struct Document {
    bytes: Vec<u8>,
    lines: Vec<Line>,
    encoding: Encoding,
    byte_order_mark: bool,
    endings: [u32; 3],
    /// Which kinds of lines there are, by [`LineKind`].
    kinds: [bool; LINE_KINDS],
}

impl Document {
    /// Reads `bytes`, whatever they are.
    ///
    /// Of input beyond 4 GiB only the first 4 GiB are split into lines; [`Document::is_complete`] tells.
    pub fn parse(bytes: &[u8]) -> Self {
        Self::from_vec(bytes.to_vec())
    }

    /// Reads `bytes` without copying them.
    pub fn from_vec(bytes: Vec<u8>) -> Self {
        let encoding = Encoding::of(&bytes);
        let byte_order_mark = bytes.starts_with(UTF8_BOM);
        let first = if byte_order_mark { UTF8_BOM.len() } else { 0 };
        let lexed = &bytes[..bytes.len().min(MAX_LEXED)];
        let (lines, endings, kinds) = match std::str::from_utf8(lexed) {
            Ok(text) => lex::lines(text, first),
            Err(_) => lex::lines(&encoding::ascii_shadow(lexed), first),
        };
        Self { bytes, lines, encoding, byte_order_mark, endings, kinds }
    }

    /// The bytes, exactly as they were read.
    pub fn to_bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Takes the bytes out.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// Every line of the file in order; line number `n` of an editor is `lines()[n - 1]`.
    #[inline]
    pub fn lines(&self) -> &[Line] {
        &self.lines
    }

    /// Whether some line is of the kind.
    #[inline]
    pub fn has_line(&self, kind: LineKind) -> bool {
        self.kinds[kind as usize]
    }

    /// How the bytes are read as text.
    pub fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// The UTF-8 byte order mark at the start, which is not part of the first line.
    pub fn byte_order_mark(&self) -> Option<Span> {
        self.byte_order_mark.then(|| Span::new(0, UTF8_BOM.len() as u32))
    }

    /// Whether all of the input was split into lines (false beyond 4 GiB).
    pub fn is_complete(&self) -> bool {
        self.bytes.len() <= MAX_LEXED
    }

    /// The line ending that most lines have; LF where no line has one.
    pub fn line_ending(&self) -> LineEnding {
        let [lf, crlf, cr] = self.endings;
        if crlf > lf && crlf >= cr {
            LineEnding::CrLf
        } else if cr > lf {
            LineEnding::Cr
        } else {
            LineEnding::Lf
        }
    }

    /// How many lines end with `ending`; 0 for [`LineEnding::None`].
    pub fn count_of(&self, ending: LineEnding) -> u32 {
        match ending {
            LineEnding::None => 0,
            LineEnding::Lf => self.endings[0],
            LineEnding::CrLf => self.endings[1],
            LineEnding::Cr => self.endings[2],
        }
    }

    /// The raw bytes of `span`.
    #[inline]
    pub fn slice(&self, span: Span) -> &[u8] {
        span.slice(&self.bytes)
    }

    /// The text of `span` for display: UTF-8, or Windows-1252 where the file is not UTF-8.
    pub fn text(&self, span: Span) -> Cow<'_, str> {
        self.encoding.decode(self.slice(span))
    }

    /// `span`, made longer where it would cut a UTF-8 character in two.
    pub fn whole_characters(&self, span: Span) -> Span {
        if self.encoding != Encoding::Utf8 {
            return span;
        }
        let is_inside = |offset: u32| self.bytes.get(offset as usize).is_some_and(|byte| byte & 0xC0 == 0x80);
        let Span { mut start, mut end } = span;
        while is_inside(start) {
            start -= 1;
        }
        while is_inside(end) {
            end += 1;
        }
        Span::new(start, end)
    }

    /// Line and column of a byte offset.
    pub fn position(&self, offset: u32) -> Position {
        position::locate(self, offset)
    }

    /// The index of the line that holds `offset`; the last line for an offset at the end of the file.
    pub fn line_at(&self, offset: u32) -> usize {
        self.lines.partition_point(|line| line.start() <= offset).saturating_sub(1)
    }

    /// The span behind the last byte of the last line's content: where something missing at the end would stand.
    pub fn end(&self) -> Span {
        Span::at(self.lines.last().map_or(0, |line| line.span().end))
    }
}

#[cfg(test)]
mod tests;
