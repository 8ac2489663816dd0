//! Line and column of a byte offset.

use super::{Document, Encoding};
use crate::Span;
use core::fmt;

/// A place as an editor shows it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Position {
    /// Line number, from 1.
    pub line: u32,
    /// Column in characters (Unicode scalar values), from 1.
    pub column: u32,
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}

pub(super) fn locate(document: &Document, offset: u32) -> Position {
    let line = document.line_at(offset);
    let start = document.lines().get(line).map_or(0, |line| line.start());
    let before = document.slice(Span::new(start.min(offset), offset));
    let characters = match document.encoding() {
        Encoding::Ascii | Encoding::Windows1252 => before.len(),
        Encoding::Utf8 => before.iter().filter(|&&byte| byte & 0xC0 != 0x80).count(),
    };
    Position { line: line as u32 + 1, column: characters as u32 + 1 }
}
