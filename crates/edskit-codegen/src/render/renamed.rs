//! Names that are not those of the EDS: what is told of them.

use super::Called;
use crate::names::{MOST_CHARACTERS, Reason};
use crate::text::for_docs;
use crate::{Layout, Problem};
use edskit_lint::Severity;

/// How many names are told for each reason; the last one says how many more there are.
const MOST_TOLD: usize = 5;

/// The names that are cut, that have lost letters, and that another entry has already, with their places.
pub(crate) fn renamed(layout: &Layout, called: &[Called]) -> Vec<Problem> {
    let mut problems = Vec::new();
    let groups: [fn(Reason) -> bool; 3] = [
        |reason| reason == Reason::Lost,
        |reason| reason == Reason::Cut,
        |reason| matches!(reason, Reason::Shared(_) | Reason::SharedObject(_)),
    ];
    for is_of_group in groups {
        let concerned = called
            .iter()
            .filter_map(|called| Some((called, called.name.reason.filter(|r| is_of_group(*r))?)));
        let concerned: Vec<(&Called, Reason)> = concerned.collect();
        for (place, (own, reason)) in concerned.iter().take(MOST_TOLD).enumerate() {
            let mut message = message(layout, own, *reason, called);
            let more = concerned.len().saturating_sub(MOST_TOLD);
            if place + 1 == MOST_TOLD && more > 0 {
                message.push_str(&format!("; and so it is with {more} more"));
            }
            let source = &layout.sources[own.entries.start];
            problems.push(Problem {
                severity: Severity::Warning,
                code: "GEN",
                file: source.file,
                span: source.span,
                position: source.position,
                message,
                help: Some(format!(
                    "`\"{}\" = \"NAME\"` under `[names]` in the side-file gives it another one",
                    whom(layout, own, *reason)
                )),
            });
        }
    }
    problems
}

fn message(layout: &Layout, own: &Called, reason: Reason, all: &[Called]) -> String {
    let source = &layout.sources[own.entries.start];
    let written = if own.is_array { source.object.as_deref().unwrap_or_default() } else { &source.name };
    let written = for_docs(written).unwrap_or_default();
    let name = &own.name.name;
    let index = layout.entries[own.entries.start].index;
    let other = |place: usize| (&all[place].name.name, layout.entries[all[place].entries.start].index);
    match reason {
        Reason::Lost => {
            format!("{written} of {index} has letters that a name cannot have, and becomes `{name}`")
        }
        Reason::Cut => format!("{written} of {index} is cut to {MOST_CHARACTERS} characters, as `{name}`"),
        Reason::Shared(first) => {
            let (first, its_index) = other(first);
            format!("`{first}` is the name of {its_index} already, and {written} of {index} becomes `{name}`")
        }
        Reason::SharedObject(first) => {
            let (_, its_index) = other(first);
            format!(
                "{index} has the same name as {its_index}: its handles have their place behind theirs, as `{name}`"
            )
        }
    }
}

/// The key of the side-file for what is to be called otherwise.
fn whom(layout: &Layout, own: &Called, reason: Reason) -> String {
    let entry = &layout.entries[own.entries.start];
    let is_of_object = own.is_array || layout.sources[own.entries.start].object.is_none();
    match reason {
        Reason::SharedObject(_) => format!("{:X}", entry.index.0),
        _ if is_of_object => format!("{:X}", entry.index.0),
        _ => format!("{:X}sub{:X}", entry.index.0, entry.sub_index.0),
    }
}
