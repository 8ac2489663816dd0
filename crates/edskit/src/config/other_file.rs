//! Files of another kind, where a parameter file or a scenario is wanted.

use super::problem::{OTHER_FILE, Problem};
use super::reading::span;
use edskit_model::own_file::OwnFile;
use edskit_model::{Datasheet, SectionKind};

/// What a text is instead of a parameter file, where that can be told.
pub(super) fn instead_of_parameters(text: &str) -> Option<Problem> {
    instead_of(text, Some(OwnFile::Parameters), "parameter file")
}

/// What a text is instead of a scenario, where that can be told.
pub(crate) fn instead_of_scenario(text: &str) -> Option<Problem> {
    instead_of(text, Some(OwnFile::Scenario), "scenario")
}

/// What a text is instead of a table of parameters, where that can be told.
pub(super) fn instead_of_table(text: &str) -> Option<Problem> {
    // A table may have the titles of a parameter file alone.
    let has_entries = text.lines().any(|line| line.contains('=') && !line.trim_start().starts_with('#'));
    if has_entries { instead_of(text, None, "table") } else { None }
}

fn instead_of(text: &str, wanted: Option<OwnFile>, name: &str) -> Option<Problem> {
    let (what, command) = match OwnFile::of(text) {
        own if own.is_some() && own == wanted => return None,
        Some(own) => (own.name(), own.command()),
        None if is_canopen(text) => ("an EDS or DCF", "`edskit lint` checks it, and `edskit show` shows it"),
        None => return None,
    };
    let end = text.find(['\r', '\n']).unwrap_or(text.len());
    let problem = Problem::at(OTHER_FILE, span(0..end), format!("this is no {name} but {what}"));
    Some(problem.help(command))
}

/// Whether a text has the first sections of an EDS.
fn is_canopen(text: &str) -> bool {
    let sheet = Datasheet::parse(text.as_bytes());
    [SectionKind::FileInfo, SectionKind::DeviceInfo].into_iter().any(|kind| sheet.section(kind).is_some())
}
