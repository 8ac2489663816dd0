//! Reading a scenario.

use super::value::{Context, Value, actions, time, unknown_key};
use super::words::KEYS;
use super::{Action, Step};
use crate::config::problem::{NO_TIME, Problem, TOO_LATE, WRONG_TYPE};
use crate::config::{
    KnownSignals, Place, amend, entries, instead_of_scenario, print_problems, span, table_of, text_of,
    unknown_in_one, what_is,
};
use crate::{Streams, files};
use edskit_lint::{MOST_FINDINGS, Severity};
use edskit_model::Document;
use edskit_runtime::Microseconds;
use std::io;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// The steps of a file in the order of their times; `None` where not all is understood. What there is to say on it is
/// printed to the error stream. `end` is when the simulation ends, where there is one, and `signals` are what is known of
/// the governor.
pub(in crate::run::gateway) fn read(
    path: &Path,
    end: Option<Microseconds>,
    signals: &KnownSignals,
    streams: &mut Streams,
) -> io::Result<Option<Vec<Step>>> {
    let document = Document::from_vec(files::read(path, streams)?);
    let (steps, problems) = steps_of(document.to_bytes(), end, signals);
    let is_complete = problems.iter().all(|problem| problem.severity < Severity::Error);
    print_problems(path, &document, problems, streams)?;
    Ok(is_complete.then_some(steps))
}

/// The steps that could be read, and what is wrong with the others.
pub(super) fn steps_of(
    bytes: &[u8],
    end: Option<Microseconds>,
    signals: &KnownSignals,
) -> (Vec<Step>, Vec<Problem>) {
    let (mut steps, mut problems) = (Vec::new(), Vec::new());
    match text_of(bytes) {
        Ok(text) => match instead_of_scenario(text) {
            Some(problem) => problems.push(problem),
            None => {
                let text = amend(text, Place::Step, &mut problems).text;
                if let Some(root) = table_of(&text, &mut problems) {
                    let context = Context { text: &text, signals };
                    steps = steps_of_root(root.get_ref(), &context, &mut problems);
                }
            }
        },
        Err(problem) => problems.push(problem),
    }
    problems = unknown_in_one(problems);
    steps.sort_by_key(|step| step.at);
    for step in steps.iter().filter(|step| end.is_some_and(|end| step.at > end)) {
        let problem = Problem::at(TOO_LATE, step.span, "this step comes after the end of the simulation");
        problems.push(problem.help("it is not carried out; simulate for a longer time"));
    }
    problems.truncate(MOST_FINDINGS);
    (steps, problems)
}

fn steps_of_root(root: &DeTable<'_>, context: &Context<'_>, problems: &mut Vec<Problem>) -> Vec<Step> {
    let mut steps = Vec::new();
    for (key, key_span, value) in entries(root) {
        match (key, value.get_ref()) {
            ("step", DeValue::Array(values)) => {
                steps.extend(values.iter().filter_map(|value| step(value, context, problems)));
            }
            ("step", _) => problems.push(no_step(value)),
            _ => problems.push(unknown_key("a scenario", key, key_span, &["step"])),
        }
    }
    steps
}

fn no_step(value: &Value<'_>) -> Problem {
    let message = match value.get_ref() {
        DeValue::Table(_) => "steps are a list of tables, and this is a single one".to_owned(),
        other => format!("a step is a table, and this is {}", what_is(other)),
    };
    let problem = Problem::at(WRONG_TYPE, span(value.span()), message);
    problem.help("write `[[step]]` for each, and its keys below it")
}

fn step(value: &Value<'_>, context: &Context<'_>, problems: &mut Vec<Problem>) -> Option<Step> {
    let DeValue::Table(table) = value.get_ref() else {
        problems.push(no_step(value));
        return None;
    };
    let mut said: Vec<Action> = Vec::new();
    let all: Vec<&str> = ["at"].into_iter().chain(KEYS).collect();
    for (key, key_span, _) in entries(table).iter().filter(|(key, ..)| !all.contains(key)) {
        problems.push(unknown_key("a step", key, *key_span, &all));
    }
    for key in KEYS {
        if let Some(value) = table.get(key) {
            said.extend(actions(key, value, context, problems));
        }
    }
    let Some(at) = table.get("at") else {
        let problem = Problem::at(NO_TIME, span(value.span()), "the step does not say when it is");
        problems.push(problem.help("write `at = 2.5` for two and a half seconds after the start"));
        return None;
    };
    match time("at", at) {
        Ok(time) => Some(Step { at: time, span: span(at.span()), actions: said }),
        Err(problem) => {
            problems.push(problem);
            None
        }
    }
}
