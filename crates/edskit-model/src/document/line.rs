//! One line of a document.

use crate::Span;

/// What a line is.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum LineKind {
    /// Nothing, or only blanks and tabs.
    Blank,
    /// A comment: `;` is the first character that is not a blank. Also a line that begins with `#`, which most
    /// readers skip though CiA 306 knows no such comment.
    Comment,
    /// A section header: `[` is the first character that is not a blank.
    Section,
    /// An entry `key=value`.
    Entry,
    /// None of these: text without `=`, an empty key, a merge-conflict marker, control characters.
    Other,
}

/// How many kinds there are.
pub(super) const LINE_KINDS: usize = LineKind::Other as usize + 1;

/// How a line ends.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum LineEnding {
    /// Nothing: the last line of a file without a final line break.
    None,
    /// `\n`.
    Lf,
    /// `\r\n`.
    CrLf,
    /// `\r`.
    Cr,
}

impl LineEnding {
    /// The characters.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Lf => "\n",
            Self::CrLf => "\r\n",
            Self::Cr => "\r",
        }
    }

    /// Name for messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Lf => "LF",
            Self::CrLf => "CR LF",
            Self::Cr => "CR",
        }
    }
}

/// One line: where it stands and where its parts are.
///
/// Parts are found from three offsets when they are asked for, which keeps a line at 16 bytes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Line {
    pub(super) start: u32,
    /// End of the content, before the line ending.
    pub(super) end: u32,
    /// Entry: offset of `=`. Section: offset of `]`, or `end` where there is none.
    pub(super) split: u32,
    pub(super) kind: LineKind,
    pub(super) ending: LineEnding,
}

impl Line {
    /// What the line is.
    #[inline]
    pub fn kind(&self) -> LineKind {
        self.kind
    }

    /// How the line ends.
    #[inline]
    pub fn ending(&self) -> LineEnding {
        self.ending
    }

    #[inline]
    pub(super) fn start(&self) -> u32 {
        self.start
    }

    /// The content without the line ending.
    #[inline]
    pub fn span(&self) -> Span {
        Span::new(self.start, self.end)
    }

    /// The content with the line ending.
    pub fn full_span(&self) -> Span {
        Span::new(self.start, self.end + self.ending.as_str().len() as u32)
    }

    /// The line ending alone.
    pub fn ending_span(&self) -> Span {
        Span::new(self.end, self.end + self.ending.as_str().len() as u32)
    }

    /// The content without blanks and tabs at either end.
    #[inline]
    pub fn trimmed(&self, source: &[u8]) -> Span {
        trim(source, self.span())
    }

    /// Of a section header: the name between the brackets as written, blanks included.
    #[inline]
    pub fn section_name(&self, source: &[u8]) -> Span {
        let open = trim_start(source, self.span()).start;
        Span::new((open + 1).min(self.split), self.split)
    }

    /// Of a section header: the `]`, or `None` where it is missing.
    #[inline]
    pub fn closing_bracket(&self) -> Option<Span> {
        (self.kind == LineKind::Section && self.split < self.end)
            .then(|| Span::new(self.split, self.split + 1))
    }

    /// Of a section header: what stands behind the `]`, without blanks around it.
    pub fn after_header(&self, source: &[u8]) -> Span {
        trim(source, Span::new((self.split + 1).min(self.end), self.end))
    }

    /// Of an entry: the key without blanks around it.
    #[inline]
    pub fn key(&self, source: &[u8]) -> Span {
        trim(source, Span::new(self.start, self.split))
    }

    /// Of an entry: the `=`.
    #[inline]
    pub fn equals(&self) -> Span {
        Span::new(self.split, self.split + 1)
    }

    /// Of an entry: the value without blanks around it; empty at the end of the line where there is none.
    #[inline]
    pub fn value(&self, source: &[u8]) -> Span {
        trim(source, Span::new((self.split + 1).min(self.end), self.end))
    }

    /// The blanks and tabs before the first other character.
    #[inline]
    pub fn indentation(&self, source: &[u8]) -> Span {
        Span::new(self.start, trim_start(source, self.span()).start)
    }

    /// The blanks and tabs behind the last other character.
    pub fn trailing_blanks(&self, source: &[u8]) -> Span {
        Span::new(trim(source, self.span()).end, self.end)
    }
}

/// Whether CiA 306 lets a reader skip the byte around names and values.
#[inline]
pub(crate) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t')
}

#[inline]
fn trim_start(source: &[u8], span: Span) -> Span {
    let mut start = span.start;
    while start < span.end && is_blank(source[start as usize]) {
        start += 1;
    }
    Span::new(start, span.end)
}

#[inline]
fn trim(source: &[u8], span: Span) -> Span {
    let Span { start, mut end } = trim_start(source, span);
    while end > start && is_blank(source[end as usize - 1]) {
        end -= 1;
    }
    Span::new(start, end)
}
