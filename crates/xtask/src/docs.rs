//! `cargo xtask docs`: documents that the programs themselves write. A test says when one is stale.

use crate::step::cargo;
use crate::{root, say};
use std::fs;
use std::process::{ExitCode, Stdio};

/// Each document with the format in which `edskit explain --all` prints it.
const DOCUMENTS: &[(&str, &str)] =
    &[("docs/rules.md", "markdown"), ("docs/cross-reference.md", "cross-reference")];

/// Programs of `edskit-tests` that write documents themselves, with what they write.
const WRITERS: &[(&str, &str)] = &[("pictures", "docs/pictures"), ("conformance-pages", "docs/conformance")];

/// The report on real files, which needs them.
const FIELD_REPORT: (&str, &[&str]) =
    ("docs/field-report.md", &["run", "--quiet", "--package", "edskit-tests", "--bin", "field-report"]);

pub(crate) fn run() -> ExitCode {
    for (path, format) in DOCUMENTS {
        let explain = ["run", "--quiet", "--package", "edskit", "--", "explain", "--all", "--format", format];
        if let Err(error) = write(path, &explain) {
            say(format_args!("{path}: {error}"));
            return ExitCode::FAILURE;
        }
        say(format_args!("{path} is written"));
    }
    for (program, folder) in WRITERS {
        let outcome = match cargo(&["run", "--quiet", "--package", "edskit-tests", "--bin", program]).status()
        {
            Ok(status) if status.success() => Ok(()),
            Ok(status) => Err(status.to_string()),
            Err(error) => Err(error.to_string()),
        };
        if let Err(error) = outcome {
            say(format_args!("{folder}: {error}"));
            return ExitCode::FAILURE;
        }
        say(format_args!("{folder} is written"));
    }
    ExitCode::SUCCESS
}

pub(crate) fn run_field_report() -> ExitCode {
    let (path, arguments) = FIELD_REPORT;
    match write(path, arguments) {
        Ok(()) => {
            say(format_args!("{path} is written"));
            ExitCode::SUCCESS
        }
        Err(error) => {
            say(format_args!("{path}: {error}"));
            ExitCode::FAILURE
        }
    }
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
