//! The independent check of a CANopen slave, against nodes over the `full.eds` that comes with it: one that `edskit run`
//! makes of the file, and one whose dictionary is generated from it. What that file lacks, a file of the tests has. The
//! devices that edskit models are judged too, but for what their manuals do otherwise than the check wants it; and every
//! real file, as the node that `edskit run` makes of it.
//!
//! All of it is judged in virtual time, where no machine is too slow. Real transports only show that they carry frames.

mod check;
mod corpus;
mod node;
mod table;

use crate::python::{self, shared};
use crate::root;
use crate::say;
use crate::step::{Outcome, in_parallel};
use check::{Report, Script, Transport, Verdict};
pub(crate) use corpus::of_real_files;
use node::{Node, Program};
pub(crate) use node::{binaries, build_edskit};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

pub(crate) const VENV: &str = "target/conformance-venv";
pub(crate) const REQUIREMENTS: &str = "tests/conformance/requirements.txt";

/// The file that has every object that the check looks for.
const EVERYTHING: &str = "tests/fixtures/nodes/Everything.eds";

/// What the random frames are made from.
const SEEDS: &[&str] = &["1", "2", "3"];
/// How many random frames a node gets for each seed.
const RANDOM_FRAMES: &str = "200000";
/// By how many milliseconds times may be wrong: what the bus is busy for when a message is due.
const TOLERANCE: &str = "1";

/// What is asked over a real transport.
const SHORT: &str = "INT-*,NMT-0*,SDO-0*,ROB-06";

/// A node that is judged.
struct Subject<'a> {
    program: Program,
    eds: &'a Path,
    /// Whether the check must not leave anything out but what virtual time does not allow.
    is_complete: bool,
    /// How many random frames come in a second: what fits on its bus beside the answers.
    random_rate: &'static str,
    /// Checks that the manual of the device contradicts, each with the statement of the ledger.
    contradicted: &'static [(&'static str, &'static str)],
}

/// What the manual of the gateway does otherwise.
const OF_GATEWAY: &[(&str, &str)] = &[
    ("HB-07", "writes 1016h, but every object is read-only (GW-OD-24)"),
    ("EMC-05", "writes 1016h to cause an EMCY message, but every object is read-only (GW-OD-24)"),
    ("INT-06", "writes 1016h to cause an EMCY message, but every object is read-only (GW-OD-24)"),
];

/// Checks that need python-canopen's own threads, which know real time only; they run over the real transports.
const REAL_TIME: &[&str] = &["INT-02", "INT-03"];

/// Whether every node passes: in virtual time everything, and over the real transports what shows that they work.
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
    let of_file = |program, eds, is_complete| Subject {
        program,
        eds,
        is_complete,
        random_rate: "4000",
        contradicted: &[],
    };
    let subjects = [
        of_file(Program::Loaded, &full, false),
        of_file(Program::Generated, &full, false),
        of_file(Program::Loaded, &everything, true),
        Subject {
            program: Program::Gateway,
            eds: &gateway,
            is_complete: false,
            // At 125 kbit/s a frame takes a millisecond.
            random_rate: "300",
            contradicted: OF_GATEWAY,
        },
    ];
    let script = Script { python: &python, path: &script };
    let outcomes = in_parallel(&subjects, |subject| {
        subject.in_virtual_time(script).and_then(|said| Ok(said + &subject.over_real_transports(script)?))
    });
    let mut problems = Vec::new();
    for outcome in outcomes {
        match outcome {
            Ok(said) => say(said.trim_end()),
            Err(problem) => problems.push(problem),
        }
    }
    if problems.is_empty() { Outcome::Passed } else { Outcome::Failed(problems.join("; ")) }
}

impl Subject<'_> {
    fn title(&self) -> String {
        format!("{} {}", self.program.title(), self.eds.file_stem().unwrap_or_default().display())
    }

    /// Runs all checks with each seed, and those of the first seed once more: they say the same. What it says is one
    /// line for each run, and what was left out.
    fn in_virtual_time(&self, script: Script<'_>) -> Result<String, String> {
        let mut said = String::new();
        let mut first: Option<Report> = None;
        for seed in SEEDS.iter().chain(&SEEDS[..1]) {
            let title = format!("{}, seed {seed}", self.title());
            // A node of its own each time, so that nothing depends on what came before.
            let node = Node::start_virtual(self.program, self.eds)?;
            let random = ["--fuzz", RANDOM_FRAMES, "--fuzz-rate", self.random_rate, "--seed", seed];
            let options = [&["--tol", TOLERANCE, "--store"], &random[..]].concat();
            let start = Instant::now();
            let report = self.judge(script, &node, Transport::Virtual, &options, &title)?;
            let seconds = start.elapsed().as_secs_f64();
            // What follows the colon is the same in every run; the script's own seconds are not.
            let counts = report.summary.split_once(": ").map_or("", |(_, counts)| counts);
            let _ = writeln!(said, "{title}: {counts}, {seconds:.1} s");
            match &first {
                None => {
                    self.tell_left_out(&report, &mut said)?;
                    first = Some(report);
                }
                Some(first) if *seed == SEEDS[0] && first.lines != report.lines => {
                    return Err(format!("{title}: the second run says something else than the first"));
                }
                Some(_) => {}
            }
        }
        Ok(said)
    }

    /// Shows that the transports carry frames.
    fn over_real_transports(&self, script: Script<'_>) -> Result<String, String> {
        let mut said = String::new();
        for transport in [Transport::Socketcand, Transport::Slcan] {
            let title = format!("{} over {}", self.title(), transport.protocol());
            let node = Node::start(self.program, self.eds)?;
            let report = self.judge(script, &node, transport, &["--only", SHORT], &title)?;
            let _ = writeln!(said, "{title}: {}", report.summary);
        }
        Ok(said)
    }

    /// Runs the script; a check that does not hold is an error.
    fn judge(
        &self,
        script: Script<'_>,
        node: &Node,
        transport: Transport,
        options: &[&str],
        title: &str,
    ) -> Result<Report, String> {
        let contradicted: Vec<&str> = self.contradicted.iter().map(|(id, _)| *id).collect();
        let contradicted = contradicted.join(",");
        let mut options = options.to_vec();
        if !contradicted.is_empty() {
            options.extend(["--skip", &contradicted]);
        }
        let report = script
            .judge(node, transport, self.eds, &options)
            .map_err(|reason| format!("{title}: {reason}"))?;
        let bad: Vec<String> = report.bad().map(ToString::to_string).collect();
        if bad.is_empty() { Ok(report) } else { Err(format!("{title}: {}", bad.join("; "))) }
    }

    fn tell_left_out(&self, report: &Report, said: &mut String) -> Result<(), String> {
        let title = self.title();
        for (id, reason) in self.contradicted {
            let _ = writeln!(said, "{title}: left out {id}, which {reason}");
        }
        let mut skipped: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for line in report.of_verdict(Verdict::Skip) {
            skipped.entry(line.reason()).or_default().push(&line.id);
        }
        for (reason, ids) in &skipped {
            let _ = writeln!(said, "{title}: skipped {}: {reason}", ids.join(", "));
        }
        let more: Vec<&str> = skipped.into_values().flatten().filter(|id| !REAL_TIME.contains(id)).collect();
        if self.is_complete && !more.is_empty() {
            return Err(format!("{title}: left out {}", more.join(", ")));
        }
        Ok(())
    }
}
