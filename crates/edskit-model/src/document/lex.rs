//! From text to lines: `ini_core` splits, recovery explains what it cannot.

use super::line::{LINE_KINDS, Line, LineEnding, LineKind, is_blank};
use ini_core::{Item, Parser};

/// Splits `text` from offset `first` on, and counts the line endings LF, CR LF and CR; says also which kinds of lines there
/// are.
pub(super) fn lines(text: &str, first: usize) -> (Vec<Line>, [u32; 3], [bool; LINE_KINDS]) {
    let source = text.as_bytes();
    // Lines of real files are 17 bytes long on average; a guess a little above saves most reallocations.
    let mut lines = Vec::with_capacity(source.len() / 16 + 1);
    let mut endings = [0; 3];
    let mut kinds = [false; LINE_KINDS];
    let mut start = first;
    for item in Parser::new(&text[first..]) {
        let (kind, split, end) = match item {
            Item::SectionEnd => continue,
            Item::Blank => (LineKind::Blank, start, start),
            Item::Comment(comment) => (LineKind::Comment, start, start + 1 + comment.len()),
            Item::Section(name) => {
                let end = start + name.len() + 2;
                (LineKind::Section, closing_bracket(source, start, end), end)
            }
            Item::Error(content) => {
                let end = start + content.len();
                (LineKind::Section, closing_bracket(source, start, end), end)
            }
            Item::Property(key, Some(value)) => {
                let equals = start + key.len();
                let end = equals + 1 + value.len();
                if source[start].is_ascii_alphanumeric() {
                    (LineKind::Entry, equals, end)
                } else {
                    let (kind, split) = recover(source, start, equals, end);
                    (kind, split, end)
                }
            }
            Item::Property(content, None) => {
                let end = start + content.len();
                let (kind, split) = recover(source, start, end, end);
                (kind, split, end)
            }
        };
        let ending = match source.get(end) {
            None => LineEnding::None,
            Some(b'\n') => LineEnding::Lf,
            Some(_) if source.get(end + 1) == Some(&b'\n') => LineEnding::CrLf,
            Some(_) => LineEnding::Cr,
        };
        let length = match ending {
            LineEnding::None => 0,
            LineEnding::Lf => {
                endings[0] += 1;
                1
            }
            LineEnding::CrLf => {
                endings[1] += 1;
                2
            }
            LineEnding::Cr => {
                endings[2] += 1;
                1
            }
        };
        kinds[kind as usize] = true;
        lines.push(Line { start: start as u32, end: end as u32, split: split as u32, kind, ending });
        start = end + length;
    }
    (lines, endings, kinds)
}

/// The first `]` of a header, since nothing behind it belongs to the name; `end` where there is none.
fn closing_bracket(source: &[u8], start: usize, end: usize) -> usize {
    source[start..end].iter().position(|&byte| byte == b']').map_or(end, |offset| start + offset)
}

/// What a line is that does not begin like an entry. `equals` is the offset of its first `=`, or `end`.
#[cold]
fn recover(source: &[u8], start: usize, equals: usize, end: usize) -> (LineKind, usize) {
    let line = &source[start..end];
    let Some(indent) = line.iter().position(|&byte| !is_blank(byte)) else {
        return (LineKind::Blank, start);
    };
    match line[indent] {
        b'[' => (LineKind::Section, closing_bracket(source, start, end)),
        b';' | b'#' => (LineKind::Comment, start),
        _ if equals == end || start + indent == equals || is_merge_marker(line) => (LineKind::Other, start),
        _ => (LineKind::Entry, equals),
    }
}

/// Whether a version control system left the line behind: seven `<`, `=`, `>` or `|` at its start.
pub fn is_merge_marker(line: &[u8]) -> bool {
    line.len() >= 7 && matches!(line[0], b'<' | b'=' | b'>' | b'|') && line[..7].iter().all(|&b| b == line[0])
}
