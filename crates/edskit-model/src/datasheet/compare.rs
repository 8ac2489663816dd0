//! Whether two files say the same.

use super::meaning::Meaning;
use super::{Datasheet, Entry, Section};
use crate::document::LineKind;
use crate::key::Shape;
use core::fmt;
use std::collections::HashMap;

/// Compares what two files say, whatever the order and the spelling of it.
///
/// Sections are told apart by what they name and entries by their key. Of doubled ones the order counts, because the
/// first one does. Numbers are compared by value, hexadecimal ones of signed types under both readings, texts byte by
/// byte. Comments and lines that are neither section nor entry are compared without the blanks around them.
///
/// ```
/// use edskit_model::{Datasheet, same_meaning};
/// let a = Datasheet::parse(b"[1000]\nDataType=7\n[1001]\nDefaultValue=1\n");
/// let b = Datasheet::parse(b"[1001]\ndefaultvalue = 1\n\n[1000]\nDataType=0x0007\n");
/// assert_eq!(same_meaning(&a, &b), Ok(()));
/// ```
///
/// # Errors
/// The first thing that `a` and `b` do not both say.
pub fn same_meaning(a: &Datasheet, b: &Datasheet) -> Result<(), Difference> {
    compare_entries("", None, a.entries_outside_sections(), None, b.entries_outside_sections())?;
    let pairs = pair(a.sections(), b.sections(), Section::identity)
        .map_err(|section| Difference::Section { name: section.name().into_owned() })?;
    for (left, right) in pairs {
        compare_entries(&left.name(), Some(left), left.entries(), Some(right), right.entries())?;
    }
    for kind in [LineKind::Comment, LineKind::Other] {
        let (left, right) = (lines(a, kind), lines(b, kind));
        if let Some(text) = first_difference(&left, &right) {
            return Err(Difference::Line { text: String::from_utf8_lossy(text).into_owned() });
        }
    }
    Ok(())
}

/// What two files do not both say. Names and values are those of the first file where it has them.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Difference {
    /// A section, or its number.
    Section {
        /// Its name.
        name: String,
    },
    /// An entry, or its number.
    Entry {
        /// The section's name; empty for entries before the first section.
        section: String,
        /// The key.
        key: String,
    },
    /// The value of an entry.
    Value {
        /// The section's name.
        section: String,
        /// The key.
        key: String,
        /// The value in the first file.
        left: String,
        /// The value in the second file.
        right: String,
    },
    /// A comment, or a line that is neither section nor entry.
    Line {
        /// The line without blanks around it.
        text: String,
    },
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Section { name } => write!(f, "[{name}] is not in both files, or not as often"),
            Self::Entry { section, key } => {
                write!(f, "`{key}` of [{section}] is not in both files, or not as often")
            }
            Self::Value { section, key, left, right } => {
                write!(f, "`{key}` of [{section}] is `{left}` in one file and `{right}` in the other")
            }
            Self::Line { text } => write!(f, "the line `{text}` is not in both files, or not as often"),
        }
    }
}

impl core::error::Error for Difference {}

fn compare_entries<'a>(
    name: &str,
    left_section: Option<Section<'a>>,
    left: impl Iterator<Item = Entry<'a>>,
    right_section: Option<Section<'a>>,
    right: impl Iterator<Item = Entry<'a>>,
) -> Result<(), Difference> {
    let pairs = pair(left, right, Entry::identity).map_err(|entry| Difference::Entry {
        section: name.to_owned(),
        key: entry.key_text().into_owned(),
    })?;
    let left_type = left_section.and_then(Section::value_type);
    let right_type = right_section.and_then(Section::value_type);
    for (left, right) in pairs {
        let key = left.key().name;
        let shape = left_section.map_or(Shape::Text(0), |section| section.kind().shape_of(key));
        if Meaning::of(left.raw(), shape, left_type) != Meaning::of(right.raw(), shape, right_type) {
            return Err(Difference::Value {
                section: name.to_owned(),
                key: left.key_text().into_owned(),
                left: left.text().into_owned(),
                right: right.text().into_owned(),
            });
        }
    }
    Ok(())
}

/// Pairs the things of two files by identity, doubled ones in their order; the first thing without a partner is the
/// error.
fn pair<T: Copy, I: Eq + core::hash::Hash>(
    left: impl Iterator<Item = T>,
    right: impl Iterator<Item = T>,
    identity: impl Fn(T) -> I,
) -> Result<Vec<(T, T)>, T> {
    let mut partners: HashMap<I, Vec<T>> = HashMap::new();
    let mut rights = Vec::new();
    for thing in right {
        partners.entry(identity(thing)).or_default().push(thing);
        rights.push(thing);
    }
    for same in partners.values_mut() {
        same.reverse();
    }
    let mut pairs = Vec::with_capacity(rights.len());
    for thing in left {
        let partner = partners.get_mut(&identity(thing)).and_then(Vec::pop).ok_or(thing)?;
        pairs.push((thing, partner));
    }
    match rights
        .into_iter()
        .find(|&thing| partners.get(&identity(thing)).is_some_and(|rest| !rest.is_empty()))
    {
        Some(left_over) => Err(left_over),
        None => Ok(pairs),
    }
}

/// All lines of a kind, sorted.
fn lines(sheet: &Datasheet, kind: LineKind) -> Vec<&[u8]> {
    let source = sheet.document.to_bytes();
    let lines = sheet.document.lines().iter().filter(|line| line.kind() == kind);
    let mut texts: Vec<_> = lines.map(|line| line.trimmed(source).slice(source)).collect();
    texts.sort_unstable();
    texts
}

fn first_difference<'a>(left: &[&'a [u8]], right: &[&'a [u8]]) -> Option<&'a [u8]> {
    let same = left.iter().zip(right).take_while(|(left, right)| left == right).count();
    match (left.get(same), right.get(same)) {
        (Some(left), Some(right)) => Some(left.min(right)),
        (one, other) => one.or(other).copied(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compare(a: &str, b: &str) -> String {
        match same_meaning(&Datasheet::parse(a.as_bytes()), &Datasheet::parse(b.as_bytes())) {
            Ok(()) => "same".to_owned(),
            Err(difference) => difference.to_string(),
        }
    }

    #[test]
    fn order_and_spelling_do_not_count() {
        assert_eq!(compare("[A]\nx=1\ny=2\n[1000]\n", "[01000]\r\n[a]\r\nY=2\r\nX = 1\r\n"), "same");
        assert_eq!(compare("; b\n[x]\n ;a\n", ";a\n[x]\n; b"), "same");
    }

    #[test]
    fn what_is_said_counts() {
        for (a, b, difference) in [
            ("[A]\n", "[A]\n[A]\n", "[A] is not in both files, or not as often"),
            ("[A]\n", "[B]\n", "[A] is not in both files, or not as often"),
            ("[A]\nx=1\n", "[A]\n", "`x` of [A] is not in both files, or not as often"),
            ("[A]\nx=1\n", "[A]\nx=01\n", "`x` of [A] is `1` in one file and `01` in the other"),
            ("x=1\n", "x=2\n", "`x` of [] is `1` in one file and `2` in the other"),
            ("[A]\n;a\n", "[A]\n;b\n", "the line `;a` is not in both files, or not as often"),
            ("[A]\nsome\n", "[A]\n", "the line `some` is not in both files, or not as often"),
        ] {
            assert_eq!(compare(a, b), difference);
        }
    }

    #[test]
    fn the_order_of_doubled_things_counts() {
        assert_eq!(
            compare("[A]\nx=1\n[A]\nx=2\n", "[A]\nx=2\n[A]\nx=1\n"),
            "`x` of [A] is `1` in one file and `2` in the other"
        );
        assert_eq!(
            compare("[A]\nx=1\nX=2\n", "[A]\nx=2\nx=1\n"),
            "`x` of [A] is `1` in one file and `2` in the other"
        );
    }
}
