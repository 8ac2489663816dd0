//! Workflow commands of GitHub Actions, which become annotations.

use super::format::Format;
use super::report::{FileReport, Summary};
use edskit_lint::Severity;
use std::io::{self, Write};

pub(super) struct Github;

impl Format for Github {
    fn file(&mut self, file: &FileReport, out: &mut dyn Write) -> io::Result<()> {
        for finding in file.findings() {
            let command = match finding.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Info => "notice",
            };
            let region = finding.region();
            let mut message = finding.message.clone();
            if let Some(help) = &finding.help {
                message = format!("{message}\n{help}");
            }
            writeln!(
                out,
                "::{command} file={},line={},col={},endLine={},endColumn={},title={}::{}",
                property(&file.name),
                region.start.line,
                region.start.column,
                region.end.line,
                region.end.column,
                property(&format!("{} {}", finding.rule.code, finding.rule.name)),
                data(&message),
            )?;
        }
        Ok(())
    }

    fn end(&mut self, summary: &Summary, out: &mut dyn Write) -> io::Result<()> {
        for failure in &summary.failures {
            writeln!(out, "::error title=edskit::{}", data(failure))?;
        }
        Ok(())
    }
}

/// Escapes the text of a command.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// Escapes a property of a command.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
