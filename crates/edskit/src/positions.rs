//! Findings with their places resolved to lines and columns, independent of the file they came from.

use edskit_lint::{Applicability, Finding, Rule, Severity};
use edskit_model::{Document, Position, Span};

/// A finding as the machine-readable formats print it.
#[derive(Debug)]
pub(crate) struct Located {
    pub(crate) rule: &'static Rule,
    pub(crate) severity: Severity,
    pub(crate) message: String,
    pub(crate) help: Option<String>,
    /// The place itself first, then those that belong to it.
    pub(crate) places: Vec<Place>,
    pub(crate) fix: Option<LocatedFix>,
}

/// A stretch of the file with a remark.
#[derive(Debug)]
pub(crate) struct Place {
    pub(crate) region: Region,
    pub(crate) text: String,
}

/// A stretch of the file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Region {
    pub(crate) span: Span,
    pub(crate) start: Position,
    pub(crate) end: Position,
}

#[derive(Debug)]
pub(crate) struct LocatedFix {
    pub(crate) title: String,
    pub(crate) applicability: Applicability,
    pub(crate) edits: Vec<(Region, String)>,
}

impl Region {
    pub(crate) fn of(document: &Document, span: Span) -> Self {
        Self { span, start: document.position(span.start), end: document.position(span.end) }
    }
}

impl Located {
    pub(crate) fn new(document: &Document, finding: Finding) -> Self {
        let fix = finding.fix.map(|fix| LocatedFix {
            title: fix.title,
            applicability: fix.applicability,
            edits: fix
                .edits
                .into_iter()
                .map(|edit| (Region::of(document, edit.span), edit.replacement))
                .collect(),
        });
        let place =
            |label: edskit_lint::Label| Place { region: Region::of(document, label.span), text: label.text };
        Self {
            rule: finding.rule,
            severity: finding.severity,
            message: finding.message,
            help: finding.help,
            places: finding.labels.into_iter().map(place).collect(),
            fix,
        }
    }

    pub(crate) fn region(&self) -> Region {
        self.places[0].region
    }
}
