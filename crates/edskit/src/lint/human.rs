//! Findings as people read them: excerpts with labels, and a help line.

use super::format::Format;
use super::report::{FileReport, Outcome, Summary};
use super::source::Source;
use edskit_lint::{Applicability, Finding, Label, Severity};
use edskit_model::Document;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};
use std::fmt::{self, Write as _};
use std::io::{self, Write};

/// How excerpts look.
#[derive(Clone, Copy)]
pub(crate) struct Style {
    pub(crate) color: bool,
    /// Columns.
    pub(crate) width: usize,
}

pub(super) struct Human {
    pub(super) quiet: bool,
}

impl Format for Human {
    fn file(&mut self, file: &FileReport, out: &mut dyn Write) -> io::Result<()> {
        match &file.outcome {
            Outcome::Linted { excerpts, .. } => out.write_all(excerpts.as_bytes()),
            Outcome::Unreadable(_) => Ok(()),
        }
    }

    fn end(&mut self, summary: &Summary, out: &mut dyn Write) -> io::Result<()> {
        if self.quiet { Ok(()) } else { writeln!(out, "{summary}") }
    }
}

/// What is shown of one problem.
#[derive(Debug)]
pub(crate) struct Notice<'a> {
    /// The code and the name of what reports it.
    pub(crate) title: String,
    pub(crate) severity: Severity,
    pub(crate) message: &'a str,
    /// The first is the place itself.
    pub(crate) labels: &'a [Label],
    pub(crate) help: Option<String>,
}

impl<'a> From<&'a Finding> for Notice<'a> {
    fn from(finding: &'a Finding) -> Self {
        let fix = match &finding.fix {
            Some(fix) if fix.applicability == Applicability::Safe => " (safe fix)",
            _ => "",
        };
        Self {
            title: format!("{} {}", finding.rule.code, finding.rule.name),
            severity: finding.severity,
            message: &finding.message,
            labels: &finding.labels,
            help: finding.help.as_ref().map(|help| format!("{help}{fix}")),
        }
    }
}

/// Every notice on a file, rendered.
pub(crate) fn excerpts<'a, N: Into<Notice<'a>>>(
    name: &str,
    document: &Document,
    notices: impl IntoIterator<Item = N>,
    style: Style,
) -> String {
    let mut text = String::new();
    let mut notices = notices.into_iter().map(N::into).peekable();
    if notices.peek().is_none() {
        return text;
    }
    let source = Source::new(name, document);
    let theme = if style.color { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(style.width)
        .with_links(false)
        .with_context_lines(1)
        .with_wrap_lines(true);
    for notice in notices {
        let shown = notice.labels.iter().all(|label| source.is_showable(label.span));
        let start = notice.labels.first().map_or(0, |label| label.span.start);
        let place = format!("{name}:{}", document.position(start));
        let excerpt = Excerpt { notice, source: shown.then_some(&source), place };
        // Writing into a string cannot fail; a renderer that gives up must not lose the finding.
        if handler.render_report(&mut text, &excerpt).is_err() {
            let _ = writeln!(text, "{}: {} {excerpt}", excerpt.place, excerpt.notice.title);
        }
        text.push('\n');
    }
    text
}

/// A notice as miette wants it.
#[derive(Debug)]
struct Excerpt<'a> {
    notice: Notice<'a>,
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
        f.write_str(self.notice.message)?;
        match self.source {
            Some(_) => Ok(()),
            None => write!(f, " ({}, the line is too long to show)", self.place),
        }
    }
}

impl std::error::Error for Excerpt<'_> {}

impl Diagnostic for Excerpt<'_> {
    fn code<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        Some(Box::new(format!("{} ({})", self.notice.title, self.notice.severity)))
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.notice.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
            Severity::Info => miette::Severity::Advice,
        })
    }

    fn help<'b>(&'b self) -> Option<Box<dyn fmt::Display + 'b>> {
        self.notice.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let source = self.source?;
        Some(Box::new(self.notice.labels.iter().enumerate().map(move |(position, label)| {
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
