//! Prints the report on real files; `cargo xtask field-report` writes it.

use edskit_tests::field_report::field_report;
use std::io::{self, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    let Some(corpus) = edskit_tests::corpus("the report on real files") else { return ExitCode::FAILURE };
    let judgements = edskit_tests::read(&edskit_tests::root().join("docs/field-report.toml"));
    match field_report(&corpus, &String::from_utf8_lossy(&judgements)) {
        Ok(page) => {
            let written = io::stdout().write_all(page.as_bytes());
            if written.is_ok() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(problems) => {
            // Nobody is left to tell where standard error is gone.
            let _ = io::stderr().write_all(problems.as_bytes());
            ExitCode::FAILURE
        }
    }
}
