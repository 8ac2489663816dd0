//! What a run found, ready to be printed.

use super::baseline::Fingerprint;
use crate::Exit;
use crate::positions::Located;
use edskit_lint::{FileKind, Severity};
use std::fmt;

/// The result for one file.
pub(crate) struct FileReport {
    /// The path as it is shown.
    pub(crate) name: String,
    pub(crate) kind: FileKind,
    /// From which severity on a finding makes the command fail.
    pub(crate) threshold: Severity,
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
    /// How many fixes were left out, or would be, because they would have made the file worse.
    pub(crate) refused: usize,
    /// What would make the file what it would be; only with `--diff`.
    pub(crate) patch: Vec<u8>,
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

    /// Whether a finding of the file makes the command fail.
    pub(crate) fn fails(&self, finding: &Located) -> bool {
        finding.severity >= self.threshold
    }

    /// Why the file could not be linted.
    pub(crate) fn failure(&self) -> Option<&str> {
        match &self.outcome {
            Outcome::Unreadable(reason) => Some(reason),
            Outcome::Linted { .. } => None,
        }
    }
}

/// How much was found, and what could not be done.
#[derive(Default)]
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
    /// Fixes that were left out, or would be.
    pub(crate) refused: usize,
    /// Whether fixes are made, or shown as a patch.
    pub(crate) fixes: bool,
    /// Whether the files stay as they are, and fixes only would be made.
    pub(crate) only_looks: bool,
    /// What could not be searched or read, and why.
    pub(crate) failures: Vec<String>,
    /// Whether a finding makes the command fail.
    pub(crate) fails: bool,
}

impl Summary {
    /// Adds a file.
    pub(crate) fn add(&mut self, file: &FileReport) {
        let Outcome::Linted { findings, known, fixes, .. } = &file.outcome else {
            self.failures.extend(file.failure().map(str::to_owned));
            return;
        };
        let count = |severity| findings.iter().filter(|finding| finding.severity == severity).count();
        self.files += 1;
        self.files_with_findings += usize::from(!findings.is_empty());
        self.errors += count(Severity::Error);
        self.warnings += count(Severity::Warning);
        self.infos += count(Severity::Info);
        self.known += known;
        self.fixed += fixes.applied;
        self.refused += fixes.refused;
        self.fails |= findings.iter().any(|finding| file.fails(finding));
    }

    /// What is said of fixes that were left out, if any were.
    pub(crate) fn left_out(&self) -> Option<String> {
        let (fixes, they) = if self.refused == 1 { ("fix", "it") } else { ("fixes", "they") };
        let count = self.refused;
        let told = || match self.fixes {
            true => format!("{count} {fixes} left out: {they} would uncover other errors"),
            false => format!("{count} {fixes} that `--fix` leaves out: {they} would uncover other errors"),
        };
        (count > 0).then(told)
    }

    /// How the run ended.
    pub(crate) fn exit(&self) -> Exit {
        if !self.failures.is_empty() {
            Exit::Failed
        } else if self.fails {
            Exit::Findings
        } else {
            Exit::Clean
        }
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.found(f)?;
        if self.fixed > 0 {
            let done = if self.only_looks { "would be fixed" } else { "fixed" };
            write!(f, ", {} {done}", self.fixed)?;
        }
        if let Some(left_out) = self.left_out() {
            write!(f, ", {left_out}")?;
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
