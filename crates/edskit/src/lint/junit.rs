//! JUnit XML, which every CI server shows: a suite for each file, a case for each finding, failed where the finding makes
//! the command fail.

use super::format::Format;
use super::report::{FileReport, Summary};
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
    findings: Vec<Case>,
    /// Why the file could not be read.
    error: Option<String>,
}

struct Case {
    name: String,
    severity: &'static str,
    /// Whether it makes the command fail; else the case passes, and says what was found.
    fails: bool,
    message: String,
    place: String,
    help: String,
}

impl Suite {
    fn new(file: &FileReport) -> Self {
        let cases = file.findings().iter().map(|finding| Case {
            name: format!("{} {}", finding.rule.code, finding.rule.name),
            severity: finding.severity.name(),
            fails: file.fails(finding),
            message: printable(&finding.message),
            place: format!("{}:{}", printable(&file.name), finding.region().start),
            help: printable(finding.help.as_deref().unwrap_or_default()),
        });
        let error = file.failure().map(printable);
        Self { name: printable(&file.name), findings: cases.collect(), error }
    }

    /// A file without findings is one case that passed.
    fn cases(&self) -> usize {
        self.findings.len().max(1)
    }

    fn failures(&self) -> usize {
        self.findings.iter().filter(|case| case.fails).count()
    }

    fn errors(&self) -> usize {
        usize::from(self.error.is_some())
    }
}

/// The counts stand before the suites, so that nothing is written before the end.
#[derive(Default)]
pub(super) struct Junit {
    suites: Vec<Suite>,
    unreadable: usize,
}

impl Format for Junit {
    fn file(&mut self, file: &FileReport, _: &mut dyn Write) -> io::Result<()> {
        self.unreadable += usize::from(file.failure().is_some());
        self.suites.push(Suite::new(file));
        Ok(())
    }

    fn end(&mut self, summary: &Summary, out: &mut dyn Write) -> io::Result<()> {
        let mut suites = std::mem::take(&mut self.suites);
        // The others are those of files, which have suites of their own.
        let searched = summary.failures.len() - self.unreadable;
        suites.extend(summary.failures[..searched].iter().map(|failure| Suite {
            name: "edskit".to_owned(),
            findings: Vec::new(),
            error: Some(printable(failure)),
        }));
        let page = JunitReport {
            cases: suites.iter().map(Suite::cases).sum(),
            failures: suites.iter().map(Suite::failures).sum(),
            errors: suites.iter().map(Suite::errors).sum(),
            suites,
        };
        out.write_all(page.render().map_err(io::Error::other)?.as_bytes())
    }
}

/// The text without the characters that XML 1.0 cannot hold even when escaped.
fn printable(text: &str) -> String {
    let allowed = |c: char| matches!(c, '\t' | '\n' | ' '..='\u{FFFD}' | '\u{10000}'..);
    text.chars().map(|c| if allowed(c) { c } else { '\u{FFFD}' }).collect()
}
