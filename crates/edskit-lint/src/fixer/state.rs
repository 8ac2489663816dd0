//! A file and what there is to complain about, by rule and by section.

use crate::{Finding, Severity};
use edskit_model::{Datasheet, Span};
use std::collections::{HashMap, HashSet};

/// A file and what is found in it.
pub(super) struct State {
    pub(super) sheet: Datasheet,
    pub(super) findings: Vec<Finding>,
}

/// The number of errors and warnings of each rule and severity.
pub(super) type Counts = HashMap<(&'static str, Severity), usize>;

/// The sections that something is about, by their names in lower case; the empty name for what is in none.
pub(super) type Places = HashSet<Vec<u8>>;

impl State {
    /// How much there is to complain about; errors weigh more than any number of warnings.
    pub(super) fn burden(&self) -> [usize; 3] {
        let count = |severity| {
            let findings = self.findings.iter().filter(|finding| finding.severity == severity);
            findings.map(|finding| 1 + finding.omitted).sum()
        };
        [count(Severity::Error), count(Severity::Warning), count(Severity::Info)]
    }

    /// Whether no rule finds more errors or warnings here than there.
    pub(super) fn has_no_more_than(&self, other: &State) -> bool {
        has_no_more(&self.counts(), &other.counts())
    }

    pub(super) fn counts(&self) -> Counts {
        let mut counts = Counts::new();
        for finding in self.complaints() {
            *counts.entry((finding.rule.code, finding.severity)).or_default() += 1 + finding.omitted;
        }
        counts
    }

    /// The same for each section that a finding points at.
    pub(super) fn counts_by_place(&self) -> HashMap<Vec<u8>, Counts> {
        let mut counts: HashMap<Vec<u8>, Counts> = HashMap::new();
        for finding in self.complaints() {
            for place in places(&self.sheet, finding.labels.iter().map(|label| label.span)) {
                let counts = counts.entry(place).or_default();
                *counts.entry((finding.rule.code, finding.severity)).or_default() += 1 + finding.omitted;
            }
        }
        counts
    }

    /// Errors and warnings; what is only worth knowing keeps no fix back.
    pub(super) fn complaints(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|finding| finding.severity > Severity::Info)
    }
}

pub(super) fn has_no_more(here: &Counts, there: &Counts) -> bool {
    here.iter().all(|(rule, count)| there.get(rule).is_some_and(|others| count <= others))
}

/// The sections in which these spans lie.
pub(super) fn places(sheet: &Datasheet, spans: impl Iterator<Item = Span>) -> Places {
    let name = |span: Span| {
        let section = sheet.section_at(span.start);
        section.map(|section| {
            // A section is the same however its name is spelt.
            let canonical = section.kind().canonical_name().map(String::into_bytes);
            let own = || section.name_span().slice(sheet.document().to_bytes()).to_vec();
            canonical.unwrap_or_else(own).to_ascii_lowercase()
        })
    };
    spans.map(|span| name(span).unwrap_or_default()).collect()
}

/// The sections in which a rule finds more errors or warnings than before.
pub(super) fn worse_places(before: &State, after: &State) -> Places {
    let (there, here) = (before.counts_by_place(), after.counts_by_place());
    let none = Counts::new();
    let worse =
        here.into_iter().filter(|(place, counts)| !has_no_more(counts, there.get(place).unwrap_or(&none)));
    worse.map(|(place, _)| place).collect()
}
