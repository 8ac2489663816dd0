//! The independent check of a CANopen slave, against nodes over `full.eds`: one that `edskit run` makes of the file, and
//! one whose dictionary is generated from it.

mod check;
mod node;

use crate::python::{self, shared};
use crate::say;
use crate::step::Outcome;
use check::{Check, Transport, Verdict};
use node::{Node, PROGRAMS};
use std::thread;

const VENV: &str = "target/conformance-venv";
const REQUIREMENTS: &str = "tests/conformance/requirements.txt";

/// Checks that may end with a warning, each with its reason: the device does what the check only tolerates on purpose.
const EXPLAINED: &[(&str, &str)] = &[];

/// Whether both nodes pass, each over socketcand and over SLCAN.
pub(crate) fn of_nodes() -> Outcome {
    let folder = shared().join("conformance");
    let script = folder.join("conformance.py");
    if !script.is_file() {
        return Outcome::LeftOut(format!("{} is no file", script.display()));
    }
    let python = match python::installed(VENV, REQUIREMENTS) {
        Ok(python) => python,
        Err(reason) => return Outcome::LeftOut(reason),
    };
    let eds = folder.join("full.eds");
    if let Err(reason) = node::build(&eds) {
        return Outcome::Failed(reason);
    }
    // The check waits most of the time, so both nodes are checked at once.
    let outcomes: Vec<Result<(), String>> = thread::scope(|scope| {
        let threads = PROGRAMS.map(|program| {
            let (python, script, eds) = (&python, &script, &eds);
            scope.spawn(move || {
                let node = Node::start(program, eds)?;
                [Transport::Socketcand, Transport::Slcan]
                    .into_iter()
                    .try_for_each(|transport| judge(&Check { node: &node, transport, python, script, eds }))
            })
        });
        let join = |thread: thread::ScopedJoinHandle<'_, _>| {
            thread.join().unwrap_or_else(|_| Err("a thread has panicked".to_owned()))
        };
        threads.into_iter().map(join).collect()
    });
    match outcomes.into_iter().filter_map(Result::err).collect::<Vec<_>>() {
        problems if problems.is_empty() => Outcome::Passed,
        problems => Outcome::Failed(problems.join("; ")),
    }
}

/// How often a check is run again by itself before it counts: on a busy machine an answer can come late, once or twice.
const REPETITIONS: usize = 3;

/// Runs all checks, and those again that do not pass.
fn judge(check: &Check<'_>) -> Result<(), String> {
    let title = check.title();
    let report = check.run(None)?;
    say(format_args!("{title}: {}", report.summary));
    let of = |verdict| report.lines.iter().filter(move |line| line.verdict == verdict);
    of(Verdict::Skip).for_each(|line| say(format_args!("{title}: {line}")));
    for line in of(Verdict::Warn).chain(of(Verdict::Fail)) {
        say(format_args!("{title}: {line}"));
        if let Some((_, reason)) = explanation(&line.id).filter(|_| line.verdict == Verdict::Warn) {
            say(format_args!("{title}: {} may warn: {reason}", line.id));
            continue;
        }
        if !passes_by_itself(check, &line.id)? {
            return Err(format!("{title}: {line}"));
        }
    }
    Ok(())
}

fn passes_by_itself(check: &Check<'_>, id: &str) -> Result<bool, String> {
    for _ in 0..REPETITIONS {
        let report = check.run(Some(id))?;
        let problem = report.lines.iter().find(|line| line.verdict.is_bad());
        let Some(line) = problem else { return Ok(true) };
        say(format_args!("{} once more: {line}", check.title()));
    }
    Ok(false)
}

fn explanation(id: &str) -> Option<&'static (&'static str, &'static str)> {
    EXPLAINED.iter().find(|(explained, _)| *explained == id)
}
