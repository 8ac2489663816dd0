//! The entries of `gateway = { .. }` and `governor = { .. }` that are no TOML.

use super::{Bad, Part, is_toml, range_in};
use edskit_devices::gateway::Owner;
use std::ops::Range;

const UNITS: [(&str, Owner); 2] = [("gateway", Owner::Gateway), ("governor", Owner::Governor)];

/// Each with the stretches to blank out: the entry itself, and with the first of them the commas that have no neighbour
/// any more.
pub(super) fn bad_entries(text: &str) -> Vec<(Bad, Vec<Range<usize>>)> {
    let mut found = Vec::new();
    for (owner, inside) in tables(text) {
        let entries = entries(text, inside);
        let bad: Vec<bool> = entries.iter().map(|range| !is_entry(&text[range.clone()])).collect();
        if !bad.contains(&true) {
            continue;
        }
        let mut blanks = needless_commas(&entries, &bad);
        for (range, _) in entries.iter().zip(&bad).filter(|(_, is_bad)| **is_bad) {
            let mut stretches = vec![range.clone()];
            stretches.append(&mut blanks);
            found.push((Bad { range: range.clone(), part: Part::Parameters(owner) }, stretches));
        }
    }
    found
}

fn is_entry(text: &str) -> bool {
    text.is_empty() || text.contains('#') || is_toml(text)
}

/// Every comma but those between two entries that stay. Each follows directly on its entry and blanks.
fn needless_commas(entries: &[Range<usize>], bad: &[bool]) -> Vec<Range<usize>> {
    let last_good = bad.iter().rposition(|is_bad| !is_bad);
    let commas = entries.windows(2).enumerate().map(|(nth, pair)| (nth, pair[0].end..pair[1].start));
    let is_needless =
        |(nth, _): &(usize, Range<usize>)| bad[*nth] || last_good.is_none_or(|last| *nth >= last);
    commas.filter(is_needless).map(|(_, range)| range).collect()
}

/// What stands between the braces, for each unit that is followed by them.
fn tables(text: &str) -> Vec<(Owner, Range<usize>)> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(character) = text[at..].chars().next() {
        match character {
            '#' => at += text[at..].find('\n').unwrap_or(text.len() - at),
            '"' | '\'' => at = end_of_text(text, at),
            _ if character.is_alphanumeric() => {
                let word = word_at(text, at);
                let owner = UNITS.iter().find(|(name, _)| *name == word).map(|(_, owner)| *owner);
                at += word.len();
                let open = text[at..].trim_start().strip_prefix('=').map(str::trim_start);
                if let (Some(owner), Some(inside)) = (owner, open.and_then(|rest| rest.strip_prefix('{'))) {
                    let start = range_in(text, inside).start;
                    let end = end_of_braces(text, start);
                    found.push((owner, start..end));
                    at = end;
                }
            }
            _ => at += character.len_utf8(),
        }
    }
    found
}

fn word_at(text: &str, at: usize) -> &str {
    let is_part = |character: char| character.is_alphanumeric() || "_-".contains(character);
    let end = text[at..].find(|character| !is_part(character)).unwrap_or(text.len() - at);
    &text[at..at + end]
}

/// Behind the quotation mark that closes the one at `at`, or the end of the line.
fn end_of_text(text: &str, at: usize) -> usize {
    let mark = text[at..].chars().next().unwrap_or_default();
    let inside = at + mark.len_utf8();
    let end = text[inside..].find([mark, '\n']).unwrap_or(text.len() - inside);
    (inside + end + 1).min(text.len())
}

/// Where the braces that are open at `start` are closed.
fn end_of_braces(text: &str, start: usize) -> usize {
    let mut depth = 1;
    let mut at = start;
    while let Some(character) = text[at..].chars().next() {
        match character {
            '"' | '\'' => {
                at = end_of_text(text, at);
                continue;
            }
            '{' | '[' => depth += 1,
            '}' | ']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            break;
        }
        at += character.len_utf8();
    }
    at
}

/// The entries between commas, without blanks around them. A number behind a comma that has no key of its own is the rest
/// of a number with a decimal comma.
fn entries(text: &str, inside: Range<usize>) -> Vec<Range<usize>> {
    let mut pieces: Vec<Range<usize>> = Vec::new();
    let (mut start, mut at, mut depth) = (inside.start, inside.start, 0);
    while at < inside.end {
        let character = text[at..].chars().next().unwrap_or_default();
        match character {
            '"' | '\'' => {
                at = end_of_text(text, at).min(inside.end);
                continue;
            }
            '{' | '[' => depth += 1,
            '}' | ']' => depth -= 1,
            ',' if depth == 0 => {
                pieces.push(start..at);
                start = at + 1;
            }
            _ => {}
        }
        at += character.len_utf8().max(1);
    }
    pieces.push(start..inside.end);
    let mut entries: Vec<Range<usize>> = Vec::new();
    for piece in pieces {
        let content = text[piece].trim();
        let range = range_in(text, content);
        match entries.last_mut() {
            Some(last) if is_rest_of_number(content) && ends_with_digit(&text[last.clone()]) => {
                last.end = range.end
            }
            _ => entries.push(range),
        }
    }
    entries
}

fn is_rest_of_number(text: &str) -> bool {
    text.starts_with(|character: char| character.is_ascii_digit()) && !text.contains('=')
}

fn ends_with_digit(text: &str) -> bool {
    text.ends_with(|character: char| character.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<&str> {
        bad_entries(text).into_iter().map(|(bad, _)| &text[bad.range]).collect()
    }

    /// What is left for the reader of TOML.
    fn left(text: &str) -> String {
        let mut bytes = text.as_bytes().to_vec();
        for range in bad_entries(text).into_iter().flat_map(|(_, blanks)| blanks) {
            bytes[range].fill(b' ');
        }
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn what_is_good_stays() {
        for (text, bad) in [
            ("gateway = { 427 = 5 }", &[][..]),
            ("gateway = { 400 = 1,5 }", &["400 = 1,5"]),
            ("gateway = { 427 = 5, 400 = 1,5 }", &["400 = 1,5"]),
            ("gateway = { 400 = 1,5, 427 = 5 }", &["400 = 1,5"]),
            ("gateway = { 427 = 5, 16404 = 57F, 428 = 6 }", &["16404 = 57F"]),
            ("gateway = { 427 = 5, 16404 = 57F, 400 = 1,5 }", &["16404 = 57F", "400 = 1,5"]),
            ("gateway = { 16404 = 57F, 427 = 5, 400 = 1,5, 428 = 6, }", &["16404 = 57F", "400 = 1,5"]),
            ("step = [{ at = 1, gateway = { 429 = 1000 ms }, store = \"gateway\" }]", &["429 = 1000 ms"]),
            ("step = [{ at = 1, governor = { 1 = \"a } , b\", 2 = [1, 2], x = 3 s } }]", &["x = 3 s"]),
            ("# gateway = { 400 = 1,5 }\n\"gateway = { 1,5\" = 3", &[]),
        ] {
            assert_eq!(found(text), bad, "{text}");
            assert_eq!(left(text).len(), text.len());
            assert!(is_toml(&left(text)), "{text}: {}", left(text));
        }
    }

    #[test]
    fn braces_without_an_end_do_no_harm() {
        for text in [
            "gateway = {",
            "gateway = { 1 = \"",
            "gateway = { [ } 400 = 1,5",
            "governor={ä = 1 ü,}",
            "gateway = {,,}",
        ] {
            assert_eq!(left(text).len(), text.len());
        }
    }
}
