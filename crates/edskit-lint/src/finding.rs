//! What a rule reports.

use crate::Rule;
use core::fmt;
use edskit_model::Span;
use serde::{Deserialize, Serialize};

/// How bad a finding is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Worth knowing; nothing breaks.
    Info,
    /// Against the specification, or some tools read it differently.
    Warning,
    /// Tools refuse the file, read it wrongly, or the device cannot be what the file says.
    Error,
}

impl Severity {
    /// `error`, `warning` or `info`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One problem in a file.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The rule that reports it.
    pub rule: &'static Rule,
    /// How bad it is.
    pub severity: Severity,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// Where: the first label is the place itself, the others are places that belong to it. Never empty.
    pub labels: Vec<Label>,
    /// What to write instead.
    pub help: Option<String>,
    /// Edits that would mend it.
    pub fix: Option<Fix>,
    /// How many further findings of the rule were left out behind this one, because nobody reads so many.
    pub omitted: usize,
}

impl Finding {
    /// The place itself.
    pub fn span(&self) -> Span {
        self.labels[0].span
    }

    /// What findings are sorted by: the place, and the rule at it.
    pub(crate) fn place(&self) -> (u32, &'static str, u32) {
        (self.span().start, self.rule.code, self.span().end)
    }

    /// Says something at the place itself.
    pub fn here(&mut self, text: impl Into<String>) -> &mut Self {
        self.labels[0].text = text.into();
        self
    }

    /// Adds a place that belongs to the problem.
    pub fn label(&mut self, span: Span, text: impl Into<String>) -> &mut Self {
        self.labels.push(Label { span, text: text.into() });
        self
    }

    /// Says what to write instead, or what to do.
    pub fn help(&mut self, text: impl Into<String>) -> &mut Self {
        self.help = Some(text.into());
        self
    }

    /// Reports with another severity than the rule's.
    ///
    /// A severity that the user set for the rule wins.
    pub fn severity(&mut self, severity: Severity) -> &mut Self {
        self.severity = severity;
        self
    }

    /// Offers edits that mend it without a change of meaning.
    pub fn safe_fix(&mut self, title: impl Into<String>, edits: Vec<Edit>) -> &mut Self {
        self.fix = Some(Fix { title: title.into(), applicability: Applicability::Safe, edits });
        self
    }

    /// Offers edits that mend it if the intent was guessed right.
    pub fn unsafe_fix(&mut self, title: impl Into<String>, edits: Vec<Edit>) -> &mut Self {
        self.fix = Some(Fix { title: title.into(), applicability: Applicability::Unsafe, edits });
        self
    }
}

/// A place with a remark.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// What is there; may be empty for the place itself.
    pub text: String,
}

/// How sure a fix is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Applicability {
    /// Right only if the intent was guessed right.
    Unsafe,
    /// The file means the same before and after.
    Safe,
}

/// Edits that mend a finding.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fix {
    /// What the edits do, as an order: `Write .. instead`.
    pub title: String,
    /// How sure the fix is.
    pub applicability: Applicability,
    /// The edits, in ascending order and without overlap.
    pub edits: Vec<Edit>,
}

/// One replacement.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Edit {
    /// What is taken out.
    pub span: Span,
    /// What comes in its place.
    pub replacement: String,
}

impl Edit {
    /// Puts `replacement` in the place of `span`.
    pub fn replace(span: Span, replacement: impl Into<String>) -> Self {
        Self { span, replacement: replacement.into() }
    }

    /// Takes `span` out.
    pub fn delete(span: Span) -> Self {
        Self::replace(span, "")
    }

    /// Puts `text` in at an offset.
    pub fn insert(offset: u32, text: impl Into<String>) -> Self {
        Self::replace(Span::at(offset), text)
    }

    /// The source with edits made, which are in ascending order and do not overlap.
    pub fn apply_all(edits: &[Self], source: &[u8]) -> Vec<u8> {
        let mut result = Vec::with_capacity(source.len());
        let mut done = 0;
        for edit in edits {
            result.extend_from_slice(&source[done..edit.span.start as usize]);
            result.extend_from_slice(edit.replacement.as_bytes());
            done = edit.span.end as usize;
        }
        result.extend_from_slice(&source[done..]);
        result
    }
}

impl Fix {
    /// The source with the edits made.
    pub fn apply(&self, source: &[u8]) -> Vec<u8> {
        Edit::apply_all(&self.edits, source)
    }
}
