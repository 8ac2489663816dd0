//! The lines that hold something a correct file hardly ever holds, found in one pass over the bytes.
//!
//! Rules on the spelling of lines look at these few instead of at every line.

use edskit_model::{Datasheet, Entry};
use std::array;

/// A line that holds something odd.
#[derive(Clone, Copy)]
pub(crate) struct OddLine {
    /// The number of the line, counted from 0.
    pub(crate) number: usize,
    /// The position of the entry on it, if it is one.
    entry: Option<u32>,
}

impl OddLine {
    /// The entry on the line, if it is one.
    pub(crate) fn entry(self, sheet: &Datasheet) -> Option<Entry<'_>> {
        sheet.entries().nth(self.entry? as usize)
    }
}

/// The odd lines in the order of the file. Lines that only might be odd are among them; each rule looks itself.
///
/// Odd is a line with
/// - a blank at its start, before `=` or behind it; every first line counts as such,
/// - a control character, tabs among them, or `!`, `"`, `#`, `$`, `+`,
/// - a blank and `;`,
/// - a value that begins with `0` and a digit,
/// - `[` directly behind a letter or digit.
pub(crate) fn find(sheet: &Datasheet) -> Vec<OddLine> {
    let document = sheet.document();
    let lines = document.lines();
    let end = lines.last().map_or(0, |line| line.full_span().end as usize);
    let bytes = &document.to_bytes()[..end];
    let mut odd = Vec::new();
    let mut add = |number| odd.push(OddLine { number, entry: sheet.entry_on_line(number).map(Entry::id) });
    let Some(first) = lines.first() else { return odd };
    add(0);
    // The window looks at the byte before the line, too.
    let mut from = (first.full_span().end as usize).saturating_sub(1);
    while let Some(place) = next(bytes, from) {
        let number = document.line_at(place as u32 + 1);
        add(number);
        from = lines[number].full_span().end as usize - 1;
    }
    odd
}

/// How many places are tried together; the compiler makes vector code of that.
const BLOCK: usize = 16;

/// The first place from `from` on whose second byte is odd.
fn next(bytes: &[u8], from: usize) -> Option<usize> {
    let mut start = from;
    while let Some(block) = bytes.get(start..start + BLOCK + 2) {
        if (0..BLOCK)
            .fold(false, |any, place| any | is_odd([block[place], block[place + 1], block[place + 2]]))
        {
            break;
        }
        start += BLOCK;
    }
    let byte = |place: usize| bytes.get(place).copied().unwrap_or(b' ');
    (start..bytes.len().saturating_sub(1))
        .find(|&place| is_odd(array::from_fn(|offset| byte(place + offset))))
}

/// Whether a byte is odd between its neighbours. Free of branches, so that many are tried at once.
#[inline]
fn is_odd([before, byte, after]: [u8; 3]) -> bool {
    let blank = byte == b' ';
    let value_begins = before == b'=';
    let low = (byte <= b'$') & !blank & (byte != b'\n') & (byte != b'\r');
    let digit = after.wrapping_sub(b'0') < 10;
    low | (byte == b'+')
        | (byte == 0x7F)
        | (blank & ((before < 0x0E) | value_begins))
        | ((before == b' ') & ((byte == b';') | (byte == b'=')))
        | (value_begins & (byte == b'0') & digit)
        | ((byte == b'[') & (before > b'/') & !value_begins)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn odd(text: &str) -> Vec<usize> {
        find(&Datasheet::parse(text.as_bytes())).iter().map(|line| line.number).collect()
    }

    #[test]
    fn every_kind_of_oddity_is_found() {
        for line in [
            " [1000]",
            "\t;a",
            "#a",
            "a\u{1}",
            "a=$",
            "a=\"",
            "a ;",
            "a #b",
            "a =",
            "a\t= b",
            "a=1[1000]",
            "a=00",
            "a= 07",
            "a=NODEID+1",
            "\u{7F}",
            "a=5\u{1A}",
        ] {
            for ending in ["\n", "\r\n", "\r", ""] {
                assert_eq!(odd(&format!("[1000]\nx=1\n{line}{ending}")), [0, 2], "{line:?} {ending:?}");
            }
        }
    }

    #[test]
    fn usual_lines_are_not_among_them() {
        let text =
            "[1000]\nParameterName=Device type\n;comment\nDataType=0x0007\nDefaultValue=0\n\nDefaultValue=\n";
        assert_eq!(odd(&format!("{text}{text}")), [0]);
        assert_eq!(odd(&text.replace('\n', "\r\n")), [0]);
        assert_eq!(odd(""), [0; 0]);
    }

    #[test]
    fn no_place_is_missed_around_the_blocks() {
        for before in 0..3 * BLOCK {
            for after in [0, 1, BLOCK - 1, BLOCK, 2 * BLOCK] {
                let text = format!("{}\n\n{}${}\n", "-".repeat(70), "-".repeat(before), "-".repeat(after));
                assert_eq!(odd(&text), [0, 2], "{before} {after}");
            }
        }
    }

    #[test]
    fn entries_come_along() {
        let sheet = Datasheet::parse(b"[1000]\nDataType =7\n [1001]\na=$\n");
        let lines: Vec<_> =
            find(&sheet).iter().map(|line| (line.number, line.entry(&sheet).is_some())).collect();
        assert_eq!(lines, [(0, false), (1, true), (2, false), (3, true)]);
    }
}
