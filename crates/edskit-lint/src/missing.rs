//! Mandatory entries that a section lacks.

use crate::wording::series;
use crate::{Context, Edit, Finding, Report};
use edskit_model::{Entry, KeyName, Section, Span};

/// Where a missing value is shown: at its entry, where there is one without a value, else at the section.
pub(crate) fn place_of(section: Section<'_>, key: KeyName) -> Span {
    section.entry(key).map_or(section.span(), |entry| entry.span())
}

/// What a section lacks of a set of keys.
pub(crate) struct Missing<'a> {
    section: Section<'a>,
    absent: Vec<KeyName>,
    /// Entries without a value, which count as none (CiA 306 v1.3, 4.2).
    empty: Vec<Entry<'a>>,
}

impl<'a> Missing<'a> {
    /// What `section` lacks of `keys`; `None` where all have values.
    pub(crate) fn of(section: Section<'a>, keys: &[KeyName]) -> Option<Self> {
        let mut missing = Self { section, absent: Vec::new(), empty: Vec::new() };
        for &key in keys {
            match section.entry(key) {
                None => missing.absent.push(key),
                Some(entry) if entry.is_empty() => missing.empty.push(entry),
                Some(_) => {}
            }
        }
        (!missing.absent.is_empty() || !missing.empty.is_empty()).then_some(missing)
    }

    /// The keys that are absent or empty.
    pub(crate) fn keys(&self) -> impl Iterator<Item = KeyName> {
        self.absent.iter().copied().chain(self.empty.iter().map(|entry| entry.key().name))
    }

    /// Reports all of it as one finding, with the values that `computed` knows as an unsafe fix.
    pub(crate) fn report<'r>(
        &self,
        context: &Context<'_>,
        computed: impl Fn(KeyName) -> Option<String>,
        report: &'r mut Report,
    ) -> &'r mut Finding {
        let quote = |key: &KeyName| format!("`{}`", key.spelling());
        let absent: Vec<String> = self.absent.iter().map(quote).collect();
        let empty: Vec<String> = self.empty.iter().map(|entry| quote(&entry.key().name)).collect();
        let section = self.section.name();
        let are = if empty.len() == 1 { "is" } else { "are" };
        let (span, message) = match (absent.is_empty(), empty.is_empty()) {
            (false, true) => (self.section.span(), format!("`[{section}]` has no {}", series(&absent, "or"))),
            (true, _) => {
                (self.empty[0].span(), format!("{} of `[{section}]` {are} empty", series(&empty, "and")))
            }
            (false, false) => {
                let message = format!(
                    "`[{section}]` has no {}; {} {are} empty",
                    series(&absent, "or"),
                    series(&empty, "and")
                );
                (self.section.span(), message)
            }
        };
        let finding = report.add(span, message);
        for (position, entry) in self.empty.iter().enumerate() {
            if position == 0 && absent.is_empty() {
                finding.here("an empty entry counts as missing");
            } else {
                finding.label(entry.span(), "empty, which counts as missing");
            }
        }
        let known: Vec<(KeyName, String)> =
            self.keys().filter_map(|key| computed(key).map(|value| (key, value))).collect();
        if known.is_empty() {
            let pronoun = if absent.len() + empty.len() == 1 { "it" } else { "each of them" };
            finding.help(format!("give {pronoun} a value"));
        } else {
            let lines: Vec<String> =
                known.iter().map(|(key, value)| format!("`{}={value}`", key.spelling())).collect();
            finding
                .help(format!("the file itself tells {}", series(&lines, "and")))
                .unsafe_fix("Add what the file itself tells", self.edits(context, &known));
        }
        finding
    }

    /// Edits that write `values`, in the order of the file.
    fn edits(&self, context: &Context<'_>, values: &[(KeyName, String)]) -> Vec<Edit> {
        let ending = context.document().line_ending().as_str();
        let mut edits = Vec::new();
        let mut lines = String::new();
        for (key, value) in values {
            match self.empty.iter().find(|entry| entry.key().name == *key) {
                Some(entry) => edits.push(Edit::insert(entry.value_span().start, value)),
                None => lines.push_str(&format!("{ending}{}={value}", key.spelling())),
            }
        }
        edits.sort_by_key(|edit| edit.span);
        if !lines.is_empty() {
            edits.push(Edit::insert(self.section.end().start, lines));
        }
        edits
    }
}
