//! `cargo xtask docs`: documents that the programs themselves write. A test says when one is stale.

use crate::step::cargo;
use crate::{root, say};
use std::fs;
use std::process::{ExitCode, Stdio};

/// Each document with the command that prints it.
const DOCUMENTS: &[(&str, &[&str])] = &[(
    "docs/rules.md",
    &["run", "--quiet", "--package", "edskit", "--", "explain", "--all", "--format", "markdown"],
)];

/// The report on real files, which needs them.
const FIELD_REPORT: (&str, &[&str]) =
    ("docs/field-report.md", &["run", "--quiet", "--package", "edskit-tests", "--bin", "field-report"]);

pub(crate) fn run() -> ExitCode {
    write_all(DOCUMENTS)
}

pub(crate) fn run_field_report() -> ExitCode {
    write_all(&[FIELD_REPORT])
}

fn write_all(documents: &[(&str, &[&str])]) -> ExitCode {
    for (path, arguments) in documents {
        if let Err(error) = write(path, arguments) {
            say(format_args!("{path}: {error}"));
            return ExitCode::FAILURE;
        }
        say(format_args!("{path} is written"));
    }
    ExitCode::SUCCESS
}

fn write(path: &str, arguments: &[&str]) -> Result<(), String> {
    let printed = cargo(arguments).stderr(Stdio::inherit()).output().map_err(|error| error.to_string())?;
    if !printed.status.success() {
        return Err(printed.status.to_string());
    }
    let path = root().join(path);
    let folder = path.parent().expect("a document lies in a folder");
    fs::create_dir_all(folder)
        .and_then(|()| fs::write(&path, printed.stdout))
        .map_err(|error| error.to_string())
}
