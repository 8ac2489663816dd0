//! Findings as people read them: excerpts with labels, and a help line.

use super::report::{Outcome, Report};
use super::source::Source;
use edskit_lint::{Applicability, Finding, Severity};
use edskit_model::Datasheet;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};
use std::fmt::{self, Write as _};
use std::io::{self, Write};

/// How excerpts look.
#[derive(Clone, Copy)]
pub(super) struct Style {
    pub(super) color: bool,
    /// Columns.
    pub(super) width: usize,
}

pub(super) fn write(report: &Report, quiet: bool, out: &mut dyn Write) -> io::Result<()> {
    for file in &report.files {
        if let Outcome::Linted { excerpts, .. } = &file.outcome {
            out.write_all(excerpts.as_bytes())?;
        }
    }
    if quiet { Ok(()) } else { writeln!(out, "{}", report.summary()) }
}

/// Every finding of a file, rendered.
pub(super) fn excerpts(name: &str, sheet: &Datasheet, findings: &[Finding], style: Style) -> String {
    let mut text = String::new();
    if findings.is_empty() {
        return text;
    }
    let source = Source::new(name, sheet);
    let theme = if style.color { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(style.width)
        .with_links(false)
        .with_context_lines(1)
        .with_wrap_lines(true);
    for finding in findings {
        let shown = finding.labels.iter().all(|label| source.is_showable(label.span));
        let place = sheet.document().position(finding.span().start);
        let excerpt = Excerpt { finding, source: shown.then_some(&source), place: format!("{name}:{place}") };
        // Writing into a string cannot fail; a renderer that gives up must not lose the finding.
        if handler.render_report(&mut text, &excerpt).is_err() {
            let _ = writeln!(text, "{}: {} {excerpt}", excerpt.place, finding.rule.code);
        }
        text.push('\n');
    }
    text
}

/// A finding as miette wants it.
#[derive(Debug)]
struct Excerpt<'a> {
    finding: &'a Finding,
    /// `None` where the lines are too long to show.
    source: Option<&'a Source<'a>>,
    place: String,
}

impl fmt::Debug for Source<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Source")
    }
}

impl fmt::Display for Excerpt<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.finding.message)?;
        match self.source {
            Some(_) => Ok(()),
            None => write!(f, " ({}, the line is too long to show)", self.place),
        }
    }
}

impl std::error::Error for Excerpt<'_> {}

impl Diagnostic for Excerpt<'_> {
    fn code<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        let rule = self.finding.rule;
        Some(Box::new(format!("{} {} ({})", rule.code, rule.name, self.finding.severity)))
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.finding.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
            Severity::Info => miette::Severity::Advice,
        })
    }

    fn help<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        let fix = match &self.finding.fix {
            Some(fix) if fix.applicability == Applicability::Safe => " (safe fix)",
            _ => "",
        };
        self.finding.help.as_ref().map(|help| Box::new(format!("{help}{fix}")) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let source = self.source?;
        Some(Box::new(self.finding.labels.iter().enumerate().map(move |(position, label)| {
            let text = (!label.text.is_empty()).then(|| label.text.clone());
            let span = source.span(label.span);
            if position == 0 {
                LabeledSpan::new_primary_with_span(text, span)
            } else {
                LabeledSpan::new_with_span(text, span)
            }
        })))
    }
}
