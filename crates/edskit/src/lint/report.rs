//! What a run found, ready to be printed.

use super::baseline::Fingerprint;
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
        /// What makes each finding the same in a later run; only where a baseline is in use.
        fingerprints: Vec<Fingerprint>,
        /// Findings that the baseline knows, which are not among the others.
        known: usize,
        /// What fixes did.
        fixes: Fixes,
    },
    /// The file could not be read, and why.
    Unreadable(String),
}

/// What fixes did to a file.
#[derive(Clone, Default)]
pub(crate) struct Fixes {
    /// How many findings were fixed.
    pub(crate) applied: usize,
    /// The file as it would be, as a difference; only with `--diff`.
    pub(crate) diff: String,
}

impl FileReport {
    pub(crate) fn fingerprints(&self) -> &[Fingerprint] {
        match &self.outcome {
            Outcome::Linted { fingerprints, .. } => fingerprints,
            Outcome::Unreadable(_) => &[],
        }
    }

    pub(crate) fn fixes(&self) -> Option<&Fixes> {
        match &self.outcome {
            Outcome::Linted { fixes, .. } => Some(fixes),
            Outcome::Unreadable(_) => None,
        }
    }

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
        let known = |file: &FileReport| match file.outcome {
            Outcome::Linted { known, .. } => known,
            Outcome::Unreadable(_) => 0,
        };
        let linted = |file: &&FileReport| matches!(file.outcome, Outcome::Linted { .. });
        Summary {
            files: self.files.iter().filter(linted).count(),
            files_with_findings: self.files.iter().filter(|file| !file.findings().is_empty()).count(),
            errors: count(Severity::Error),
            warnings: count(Severity::Warning),
            infos: count(Severity::Info),
            known: self.files.iter().map(known).sum(),
            fixed: self.files.iter().filter_map(FileReport::fixes).map(|fixes| fixes.applied).sum(),
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
    /// Findings that the baseline knows.
    pub(crate) known: usize,
    /// Findings that were fixed.
    pub(crate) fixed: usize,
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.found(f)?;
        if self.fixed > 0 {
            write!(f, ", {} fixed", self.fixed)?;
        }
        if self.known > 0 {
            write!(f, ", {} known from the baseline", self.known)?;
        }
        Ok(())
    }
}

impl Summary {
    fn found(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
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
