//! Tasks of this repository: `cargo xtask`.

mod conformance;
mod docs;
mod features;
mod python;
mod step;
mod test;
mod thumb;
mod tutorial;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fmt};

const USAGE: &str = "\
Usage: cargo xtask TASK

Tasks:
  test [WORD]   Everything that has to hold: formatting, lints, tests, documents, benchmarks that compile; with words,
                only the steps whose titles have one of them
  docs          Write the generated documents again
  field-report  Write docs/field-report.md again; needs the shared folder
";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["test", ref words @ ..] => test::run(words),
        ["docs"] => docs::run(),
        ["field-report"] => docs::run_field_report(),
        ["help" | "--help" | "-h"] => {
            say(USAGE);
            ExitCode::SUCCESS
        }
        _ => {
            let _ = io::stderr().write_all(USAGE.as_bytes());
            ExitCode::from(2)
        }
    }
}

/// The root of the repository.
fn root() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().nth(2).expect("this package lies in crates/").to_owned()
}

/// Whether this is a run in continuous integration: `CI` is set to something.
fn is_ci() -> bool {
    env::var_os("CI").is_some_and(|value| !value.is_empty())
}

/// Prints a line to standard output, at once and in order with what the commands print.
fn say(line: impl fmt::Display) {
    let mut out = io::stdout();
    // Nobody is left to tell where standard output is gone.
    let _ = writeln!(out, "{line}").and_then(|()| out.flush());
}
