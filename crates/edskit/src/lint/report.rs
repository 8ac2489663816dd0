//! What a run found, ready to be printed.

use crate::Exit;
use crate::positions::Located;
use edskit_lint::{FileKind, Severity};
use std::fmt;

/// The result of a run.
pub(crate) struct Report {
    /// One for each file, in the order of the arguments.
    pub(crate) files: Vec<FileReport>,
    /// What could not be searched.
    pub(crate) failures: Vec<String>,
}

/// The result for one file.
pub(crate) struct FileReport {
    /// The path as it is shown.
    pub(crate) name: String,
    pub(crate) kind: FileKind,
    pub(crate) outcome: Outcome,
}

pub(crate) enum Outcome {
    /// The file was read.
    Linted {
        findings: Vec<Located>,
        /// The findings as the human format shows them.
        excerpts: String,
    },
    /// The file could not be read, and why.
    Unreadable(String),
}

impl FileReport {
    pub(crate) fn findings(&self) -> &[Located] {
        match &self.outcome {
            Outcome::Linted { findings, .. } => findings,
            Outcome::Unreadable(_) => &[],
        }
    }
}

impl Report {
    /// Everything that kept a file from being linted.
    pub(crate) fn all_failures(&self) -> impl Iterator<Item = &str> {
        let unreadable = self.files.iter().filter_map(|file| match &file.outcome {
            Outcome::Unreadable(reason) => Some(reason.as_str()),
            Outcome::Linted { .. } => None,
        });
        self.failures.iter().map(String::as_str).chain(unreadable)
    }

    /// Every finding with its file.
    pub(crate) fn findings(&self) -> impl Iterator<Item = (&FileReport, &Located)> {
        self.files.iter().flat_map(|file| file.findings().iter().map(move |finding| (file, finding)))
    }

    pub(crate) fn summary(&self) -> Summary {
        let count = |severity| self.findings().filter(|(_, finding)| finding.severity == severity).count();
        let linted = |file: &&FileReport| matches!(file.outcome, Outcome::Linted { .. });
        Summary {
            files: self.files.iter().filter(linted).count(),
            files_with_findings: self.files.iter().filter(|file| !file.findings().is_empty()).count(),
            errors: count(Severity::Error),
            warnings: count(Severity::Warning),
            infos: count(Severity::Info),
        }
    }

    /// How the run ended when findings count from `threshold` on.
    pub(crate) fn exit(&self, threshold: Severity) -> Exit {
        if self.all_failures().next().is_some() {
            Exit::Failed
        } else if self.findings().any(|(_, finding)| finding.severity >= threshold) {
            Exit::Findings
        } else {
            Exit::Clean
        }
    }
}

/// How much was found.
#[derive(Clone, Copy)]
pub(crate) struct Summary {
    pub(crate) files: usize,
    pub(crate) files_with_findings: usize,
    pub(crate) errors: usize,
    pub(crate) warnings: usize,
    pub(crate) infos: usize,
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plural = |count: usize| if count == 1 { "" } else { "s" };
        if self.files_with_findings == 0 {
            return write!(f, "{} file{}, no findings", self.files, plural(self.files));
        }
        let kinds = [(self.errors, "error"), (self.warnings, "warning"), (self.infos, "info")];
        let mut separator = "";
        for (count, kind) in kinds.into_iter().filter(|(count, _)| *count > 0) {
            write!(f, "{separator}{count} {kind}{}", if kind == "info" { "" } else { plural(count) })?;
            separator = ", ";
        }
        write!(f, " in {} of {} file{}", self.files_with_findings, self.files, plural(self.files))
    }
}
