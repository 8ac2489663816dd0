//! The lines of a text that are entries of parameters and no TOML.

use super::{Bad, Part, is_toml, range_in};
use edskit_devices::gateway::Owner;
use std::ops::Range;

/// Each with the stretch to blank out.
pub(super) fn bad_entries(text: &str) -> Vec<(Bad, Vec<Range<usize>>)> {
    let mut part = Part::Head;
    let mut found = Vec::new();
    for line in text.lines() {
        let content = line.trim_start_matches('\u{FEFF}').trim();
        if let Some(name) = header(content) {
            part = part_of(name);
        } else if part != Part::Other && !content.is_empty() && !content.starts_with('#') && !is_toml(content)
        {
            let range = range_in(text, content);
            found.push((Bad { range: range.clone(), part }, vec![range]));
        }
    }
    found
}

/// The name of the table that begins with this line.
fn header(line: &str) -> Option<&str> {
    let name = line.strip_prefix('[')?.trim_start_matches('[');
    Some(name.split(']').next().unwrap_or_default().trim())
}

/// Tables of a scenario's steps have the same last names: `step.gateway`.
fn part_of(name: &str) -> Part {
    match name.rsplit('.').next().unwrap_or_default().trim().trim_matches(['"', '\'']) {
        "gateway" => Part::Parameters(Owner::Gateway),
        "governor" => Part::Parameters(Owner::Governor),
        "signals" => Part::Signals,
        _ => Part::Other,
    }
}
