//! The independent check of a CANopen slave, against nodes over the `full.eds` that comes with it: one that `edskit run`
//! makes of the file, and one whose dictionary is generated from it. What that file lacks, a file of the tests has. The
//! devices that edskit models are judged too, but for what their manuals do otherwise than the check wants it.

mod check;
mod machine;
mod node;

use crate::python::{self, shared};
use crate::root;
use crate::say;
use crate::step::Outcome;
use check::{Check, Report, Transport, Verdict};
pub(crate) use node::binaries;
use node::{Node, Program};
use std::collections::BTreeMap;
use std::path::Path;
use std::thread;
use std::time::Duration;

pub(crate) const VENV: &str = "target/conformance-venv";
pub(crate) const REQUIREMENTS: &str = "tests/conformance/requirements.txt";

/// The file that has every object that the check looks for.
const EVERYTHING: &str = "tests/fixtures/nodes/Everything.eds";

/// A node that is judged.
struct Subject<'a> {
    program: Program,
    eds: &'a Path,
    transports: &'static [Transport],
    /// Whether the check must not leave anything out.
    is_complete: bool,
    /// Checks that the manual of the device contradicts, each with the statement of the ledger.
    contradicted: &'static [(&'static str, &'static str)],
}

/// What the manual of the gateway does otherwise.
const OF_GATEWAY: &[(&str, &str)] = &[
    ("HB-07", "writes 1016h, but every object is read-only (GW-OD-24)"),
    ("EMC-05", "writes 1016h to cause an EMCY message, but every object is read-only (GW-OD-24)"),
    ("INT-06", "writes 1016h to cause an EMCY message, but every object is read-only (GW-OD-24)"),
];

/// Whether every node passes over every transport.
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
    let (full, everything) = (folder.join("full.eds"), root().join(EVERYTHING));
    let gateway = match node::build(&full).and_then(|()| node::dcf_of_gateway()) {
        Ok(dcf) => dcf,
        Err(reason) => return Outcome::Failed(reason),
    };
    let both = &[Transport::Socketcand, Transport::Slcan];
    // Only SLCAN carries the remote frames that some checks need.
    let only_slcan = &[Transport::Slcan];
    let subjects = [
        Subject {
            program: Program::Loaded,
            eds: &full,
            transports: both,
            is_complete: false,
            contradicted: &[],
        },
        Subject {
            program: Program::Generated,
            eds: &full,
            transports: both,
            is_complete: false,
            contradicted: &[],
        },
        Subject {
            program: Program::Loaded,
            eds: &everything,
            transports: only_slcan,
            is_complete: true,
            contradicted: &[],
        },
        Subject {
            program: Program::Gateway,
            eds: &gateway,
            transports: both,
            is_complete: false,
            contradicted: OF_GATEWAY,
        },
    ];
    // One after the other: the check measures times of milliseconds, which several at once would disturb.
    let problems: Vec<String> =
        subjects.iter().filter_map(|subject| judge_all(subject, &python, &script).err()).collect();
    if problems.is_empty() { Outcome::Passed } else { Outcome::Failed(problems.join("; ")) }
}

fn judge_all(subject: &Subject<'_>, python: &Path, script: &Path) -> Result<(), String> {
    let node = Node::start(subject.program, subject.eds)?;
    for transport in subject.transports {
        let left_out = subject.contradicted;
        let check = Check { node: &node, transport: *transport, python, script, eds: subject.eds, left_out };
        let left_out = judge(&check)?;
        if subject.is_complete && left_out > 0 {
            return Err(format!("{}: {left_out} checks left out", check.title()));
        }
    }
    Ok(())
}

/// How often a check is run again by itself before it counts: on a busy machine an answer can come late, more than once.
const REPETITIONS: u32 = 10;

/// By how much the script lets times be wrong if it is not told otherwise.
const TOLERANCE: Duration = Duration::from_millis(25);

/// The pause before a repetition, longer each time, so that all of them together outlast what disturbs the machine.
const PAUSE: Duration = Duration::from_secs(1);

/// Runs all checks, and those again that do not pass; says how many were left out.
fn judge(check: &Check<'_>) -> Result<usize, String> {
    let title = check.title();
    let report = whole_report(check)?;
    say(format_args!("{title}: {}", report.summary));
    for (id, reason) in check.left_out {
        say(format_args!("{title}: left out {id}, which {reason}"));
    }
    let of = |verdict| report.lines.iter().filter(move |line| line.verdict == verdict);
    let mut skipped: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    of(Verdict::Skip).for_each(|line| skipped.entry(line.reason()).or_default().push(&line.id));
    for (reason, ids) in skipped {
        say(format_args!("{title}: skipped {}: {reason}", ids.join(", ")));
    }
    for line in of(Verdict::Warn).chain(of(Verdict::Fail)) {
        say(format_args!("{title}: {line}"));
        if !passes_by_itself(check, &line.id) {
            return Err(format!("{title}: {line}"));
        }
    }
    Ok(of(Verdict::Skip).count())
}

/// The report on all checks. An answer that comes late enough ends the script itself, which is then run again.
fn whole_report(check: &Check<'_>) -> Result<Report, String> {
    for _ in 1..REPETITIONS {
        match check.run() {
            Ok(report) => return Ok(report),
            Err(reason) => say(format_args!("once more: {reason}")),
        }
    }
    check.run()
}

/// Whether a check passes by itself at least once. The times that it measures may be wrong by as much as the machine
/// itself was late in the repetitions before.
fn passes_by_itself(check: &Check<'_>, id: &str) -> bool {
    let mut tolerance = TOLERANCE;
    let mut has_jitter_only = false;
    for repetition in 1..=REPETITIONS {
        thread::sleep(PAUSE * (repetition - 1));
        let (report, late) = machine::observed(|| check.run_again(id, tolerance));
        let problem = match report {
            Ok(report) => match report.lines.into_iter().find(|line| line.verdict.is_bad()) {
                None => return true,
                Some(line) => {
                    has_jitter_only |= line.is_jitter();
                    line.to_string()
                }
            },
            Err(reason) => reason,
        };
        say(format_args!(
            "{} once more: {problem} (the machine was late by {} ms, the tolerance was {} ms)",
            check.title(),
            late.as_millis(),
            tolerance.as_millis()
        ));
        tolerance = tolerance.max(TOLERANCE + late);
    }
    if has_jitter_only {
        say(format_args!("{}: {id} counts as passed: the mean period is right", check.title()));
    }
    has_jitter_only
}
