//! Workflow commands of GitHub Actions, which become annotations.

use super::report::Report;
use edskit_lint::Severity;
use std::io::{self, Write};

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    for (file, finding) in report.findings() {
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
    for failure in report.all_failures() {
        writeln!(out, "::error title=edskit::{}", data(failure))?;
    }
    Ok(())
}

/// Escapes the text of a command.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// Escapes a property of a command.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
