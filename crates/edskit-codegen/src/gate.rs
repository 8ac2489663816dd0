//! Which findings stop a build.
//!
//! An error of the linter says that a file is wrong. An error of a build is what makes the dictionary wrong or ambiguous;
//! whatever else the linter says is a warning, because the dictionary is that of the file without the mistake.

use crate::Layout;
use edskit_lint::{Finding, RuleSet, Severity};
use edskit_model::{Datasheet, SectionKind, Span, is_merge_marker};
use edskit_types::Index;

/// Where findings of a rule stop a build.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Stops {
    /// Everywhere: there is no dictionary.
    Everywhere,
    /// In the description of an object: it can be read in two ways, or contradicts itself.
    InDescriptions,
    /// In a description of which the dictionary has to leave something out: what is read as it was meant does not stop.
    WhereLost,
    /// At the marks of a merge: there are two files in one.
    AtMergeMarkers,
}

/// The rules whose errors stop a build, with where they do.
const GATE: &[(&str, Stops)] = &[
    ("SYN000", Stops::Everywhere),
    ("SYN008", Stops::AtMergeMarkers),
    ("SYN012", Stops::WhereLost),
    ("SYN013", Stops::InDescriptions),
    ("SYN014", Stops::InDescriptions),
    ("SYN015", Stops::InDescriptions),
    ("SYN017", Stops::WhereLost),
    ("SYN020", Stops::WhereLost),
    ("SYN022", Stops::WhereLost),
    ("OBJ002", Stops::WhereLost),
    ("OBJ003", Stops::WhereLost),
    ("OBJ004", Stops::WhereLost),
    ("OBJ005", Stops::WhereLost),
    ("OBJ013", Stops::WhereLost),
    ("VAL001", Stops::WhereLost),
    ("VAL002", Stops::WhereLost),
    ("VAL003", Stops::InDescriptions),
    ("VAL006", Stops::WhereLost),
    ("VAL007", Stops::WhereLost),
    ("VAL013", Stops::WhereLost),
    ("COM002", Stops::WhereLost),
];

/// What the findings of one file mean for its dictionary.
pub(crate) struct Gate<'a> {
    sheet: &'a Datasheet,
    rules: &'a RuleSet,
    /// The sections of which something is left out.
    lost: Vec<u32>,
}

impl<'a> Gate<'a> {
    /// The gate of a file; `layout` is its dictionary, where there is one.
    pub(crate) fn new(sheet: &'a Datasheet, rules: &'a RuleSet, layout: Option<&Layout>) -> Self {
        let lost = layout.into_iter().flat_map(|layout| &layout.lost);
        let sections = lost.filter_map(|problem| sheet.section_at(problem.span.start));
        Self { sheet, rules, lost: sections.map(|section| section.id()).collect() }
    }

    /// Whether there is no build with this finding. Whoever gives a rule the severity "error" wants that.
    pub(crate) fn stops(&self, finding: &Finding) -> bool {
        if finding.severity != Severity::Error {
            return false;
        }
        if self.rules.said_severity(finding.rule) == Some(Severity::Error) {
            return true;
        }
        let place = finding.span();
        match GATE.iter().find(|(code, _)| *code == finding.rule.code) {
            None => false,
            Some((_, Stops::Everywhere)) => true,
            Some((_, Stops::InDescriptions)) => self.is_description(place),
            Some((_, Stops::WhereLost)) => {
                self.sheet.section_at(place.start).is_some_and(|section| self.lost.contains(&section.id()))
            }
            Some((_, Stops::AtMergeMarkers)) => {
                let document = self.sheet.document();
                let line = document.lines()[document.line_at(place.start)];
                is_merge_marker(line.trimmed(document.to_bytes()).slice(document.to_bytes()))
            }
        }
    }

    fn is_description(&self, place: Span) -> bool {
        match self.sheet.section_at(place.start).map(|section| section.kind()) {
            Some(
                SectionKind::Object(index)
                | SectionKind::SubObject(index, _)
                | SectionKind::CompactValues(index),
            ) => index >= Index::DEVICE_TYPE,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_is_that_of_a_rule() {
        for (code, _) in GATE {
            assert_eq!(edskit_lint::find(code).map(|rules| rules.len()), Ok(1), "{code}");
        }
    }
}
