//! JUnit XML, which every CI server shows: a suite for each file, a failed case for each finding.

use super::report::{FileReport, Outcome, Report};
use askama::Template;
use std::io::{self, Write};

#[derive(Template)]
#[template(path = "report/junit.xml", escape = "xml")]
struct JunitReport {
    cases: usize,
    failures: usize,
    errors: usize,
    suites: Vec<Suite>,
}

struct Suite {
    name: String,
    failures: Vec<Case>,
    /// Why the file could not be read.
    error: Option<String>,
}

struct Case {
    name: String,
    severity: &'static str,
    message: String,
    place: String,
    help: String,
}

impl Suite {
    fn new(file: &FileReport) -> Self {
        let cases = file.findings().iter().map(|finding| Case {
            name: format!("{} {}", finding.rule.code, finding.rule.name),
            severity: finding.severity.name(),
            message: printable(&finding.message),
            place: format!("{}:{}", printable(&file.name), finding.region().start),
            help: printable(finding.help.as_deref().unwrap_or_default()),
        });
        let error = match &file.outcome {
            Outcome::Unreadable(reason) => Some(printable(reason)),
            Outcome::Linted { .. } => None,
        };
        Self { name: printable(&file.name), failures: cases.collect(), error }
    }

    /// A file without findings is one case that passed.
    fn cases(&self) -> usize {
        self.failures.len().max(1)
    }

    fn errors(&self) -> usize {
        usize::from(self.error.is_some())
    }
}

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let mut suites: Vec<Suite> = report.files.iter().map(Suite::new).collect();
    suites.extend(report.failures.iter().map(|failure| Suite {
        name: "edskit".to_owned(),
        failures: Vec::new(),
        error: Some(printable(failure)),
    }));
    let page = JunitReport {
        cases: suites.iter().map(Suite::cases).sum(),
        failures: suites.iter().map(|suite| suite.failures.len()).sum(),
        errors: suites.iter().map(Suite::errors).sum(),
        suites,
    };
    out.write_all(page.render().map_err(io::Error::other)?.as_bytes())
}

/// The text without the characters that XML 1.0 cannot hold even when escaped.
fn printable(text: &str) -> String {
    let allowed = |c: char| matches!(c, '\t' | '\n' | ' '..='\u{FFFD}' | '\u{10000}'..);
    text.chars().map(|c| if allowed(c) { c } else { '\u{FFFD}' }).collect()
}
