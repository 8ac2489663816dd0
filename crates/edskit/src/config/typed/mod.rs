//! What people type from the manual, or copy from the PC tool, where TOML writes it otherwise.
//!
//! The manual prints `57F`, `1,0`, `1000 ms` and `16481 CanOpRPDO1-4Cyc (1)`; a parameter file is TOML. So a text that is
//! none goes through [`amend`] first: entries of parameters that TOML does not take are read as people write them, each is
//! answered with the line as it has to be, and blanks stand in its place for the reader of TOML, so that all other places
//! stay where they are.

mod braces;
mod entry;
mod lines;
pub(crate) mod number;
pub(crate) mod row;

use super::key::Place;
use super::problem::Problem;
use edskit_devices::gateway::Owner;
use std::borrow::Cow;
use std::ops::Range;
use toml::de::DeTable;

/// How many entries of one file are answered with their places.
const MOST: usize = 20;

/// A text with blanks in the place of what was answered.
pub(crate) struct Amended<'t> {
    pub(crate) text: Cow<'t, str>,
    /// Whether a line about the device was among that.
    pub(crate) names_device: bool,
}

/// What stands in a part of a file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Part {
    /// The first lines of a parameter file.
    Head,
    /// Parameters of a unit.
    Parameters(Owner),
    /// Descriptions of parameters of the governor.
    Signals,
    /// Something else.
    Other,
}

/// An entry that is no TOML: where it stands, and of what it is one.
struct Bad {
    range: Range<usize>,
    part: Part,
}

/// Answers the entries of a text that TOML does not take. A text that is TOML stays as it is.
pub(crate) fn amend<'t>(text: &'t str, place: Place, problems: &mut Vec<Problem>) -> Amended<'t> {
    if is_toml(text) {
        return Amended { text: Cow::Borrowed(text), names_device: false };
    }
    let mut bytes = text.as_bytes().to_vec();
    let mut found = Vec::new();
    let mut names_device = false;
    for (bad, blanks) in braces::bad_entries(text).into_iter().chain(lines::bad_entries(text)) {
        let Some(problem) = entry::answer(text, &bad, place) else { continue };
        names_device |= bad.part == Part::Head;
        found.push(problem);
        for range in blanks {
            bytes[range].fill(b' ');
        }
    }
    problems.extend(shortened(found));
    let text = String::from_utf8(bytes).map_or(Cow::Borrowed(text), Cow::Owned);
    Amended { text, names_device }
}

/// Who has pasted a table need not see every row of it.
fn shortened(mut problems: Vec<Problem>) -> Vec<Problem> {
    let (told_together, others): (Vec<Problem>, Vec<Problem>) =
        problems.drain(..).partition(Problem::can_be_merged);
    let count = others.len();
    let mut shown: Vec<Problem> = others.into_iter().take(MOST).collect();
    if let Some(last) = shown.pop_if(|_| count > MOST) {
        let help = last.help.clone().unwrap_or_default();
        shown.push(last.help(format!(
            "{help}; {} more are like it: `edskit config import` makes a parameter file of a table",
            count - MOST
        )));
    }
    shown.extend(told_together);
    shown
}

fn is_toml(text: &str) -> bool {
    DeTable::parse(text).is_ok()
}

/// Where a part of a text stands in it.
fn range_in(text: &str, part: &str) -> Range<usize> {
    let start = (part.as_ptr() as usize).saturating_sub(text.as_ptr() as usize).min(text.len());
    start..(start + part.len()).min(text.len())
}
