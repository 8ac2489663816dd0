//! `cargo xtask test`: the one command that says whether everything holds.

use crate::step::{self, Outcome, cargo};
use crate::{conformance, features, is_ci, python, say, thumb, tutorial};
use std::process::{ExitCode, Stdio};
use std::time::Instant;

/// A heading, and what is done under it.
type Step = (&'static str, fn() -> Outcome);

/// What has to hold.
const STEPS: &[Step] = &[
    ("formatting", || step::run(&mut cargo(&["fmt", "--all", "--check"]))),
    ("lints", lints),
    ("tests", || step::run(&mut cargo(&["test", "--workspace"]))),
    ("documentation", documentation),
    ("benchmarks", benchmarks),
    ("fuzz targets compile", fuzz_targets),
    ("no operating system below the runtime", thumb::no_std),
    ("every set of services", features::hold),
    ("size of a firmware", thumb::firmware),
    ("independent reading of the corpus", python::independent_reading),
    ("conformance of nodes", conformance::of_nodes),
    ("every real file as a device", conformance::of_real_files),
    ("tutorial of the gateway", tutorial::of_gateway),
    ("page on virtual time", tutorial::of_virtual_time),
];

/// Runs every step, also behind one that failed, and ends with a summary; with words only the steps whose titles have
/// one of them.
pub(crate) fn run(words: &[&str]) -> ExitCode {
    let is_chosen = |(title, _): &&Step| words.is_empty() || words.iter().any(|word| title.contains(word));
    let mut summary = Vec::new();
    for (title, step) in STEPS.iter().filter(is_chosen) {
        say(format_args!("\n=== {title} ==="));
        let start = Instant::now();
        let outcome = match step() {
            Outcome::LeftOut(reason) if is_ci() => {
                Outcome::Failed(format!("left out, but this is CI: {reason}"))
            }
            outcome => outcome,
        };
        summary.push((title, outcome, start.elapsed()));
    }
    say("\n=== summary ===");
    for (title, outcome, time) in &summary {
        say(format_args!("{title:34} {:>5} s  {outcome}", time.as_secs()));
    }
    let failed = summary.iter().filter(|(_, outcome, _)| matches!(outcome, Outcome::Failed(_))).count();
    if summary.is_empty() {
        say("no step has such a title");
        return ExitCode::FAILURE;
    }
    if failed > 0 {
        say(format_args!("FAILED: {failed} of {} steps", summary.len()));
        return ExitCode::FAILURE;
    }
    say("everything holds");
    ExitCode::SUCCESS
}

/// Of everything, also of what is behind a feature.
fn lints() -> Outcome {
    let what = ["clippy", "--workspace", "--all-targets", "--features", "edskit-host/socketcan"];
    step::run(cargo(&what).args(["--", "-D", "warnings"]))
}

/// With the examples, and with the feature of the lints: then no dependency has other features than there and is checked
/// again.
fn documentation() -> Outcome {
    let what = ["doc", "--workspace", "--no-deps", "--lib", "--bins", "--examples"];
    let mut doc = cargo(&what);
    step::run(doc.args(["--features", "edskit-host/socketcan"]).env("RUSTDOCFLAGS", "-D warnings"))
}

/// Each once, in the build of the tests: they work, and measure nothing. What they print is a line for each that does.
fn benchmarks() -> Outcome {
    let mut test = cargo(&["test", "--quiet", "--workspace", "--bench", "pipeline", "--bench", "node"]);
    step::run(test.stdout(Stdio::null()))
}

/// They are a workspace of their own, which the other steps do not see.
fn fuzz_targets() -> Outcome {
    let manifest = "--manifest-path=tests/fuzz/Cargo.toml";
    match step::run(&mut cargo(&["fmt", manifest, "--check"])) {
        Outcome::Passed => {
            step::run(&mut cargo(&["clippy", manifest, "--target-dir=target/fuzz", "--", "-D", "warnings"]))
        }
        outcome => outcome,
    }
}
