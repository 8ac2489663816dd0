//! What a kind of defect is, and the usual ways to make one.

use super::base::{Base, Section};
use super::mutant::Mutant;

/// How many places of one kind are taken from a base, evenly spread over it.
pub const MOST_PLACES: usize = 8;

/// Finds all places in a base, and gives the base with the defect for each.
type Places = dyn Fn(&Base) -> Vec<Mutant>;

/// One kind of defect.
pub struct Defect {
    /// The rule that has to report it, by its code.
    pub rule: &'static str,
    /// What is wrong, in words.
    pub kind: String,
    /// Whether the rule points at the other end of the contradiction, and gives the mutated line a label.
    pub by_label: bool,
    /// Errors of other rules that cannot but follow, each with the reason.
    pub consequences: Vec<(&'static str, &'static str)>,
    places: Box<Places>,
}

impl Defect {
    /// A defect at each of the places that `places` finds in a base.
    pub fn new(
        rule: &'static str,
        kind: impl Into<String>,
        places: impl Fn(&Base) -> Vec<Mutant> + 'static,
    ) -> Self {
        Self { rule, kind: kind.into(), by_label: false, consequences: Vec::new(), places: Box::new(places) }
    }

    /// The rule points at the other end of the contradiction, and gives the mutated line a label.
    pub fn by_label(mut self) -> Self {
        self.by_label = true;
        self
    }

    /// Another rule cannot but report an error too.
    pub fn with_consequence(mut self, rule: &'static str, reason: &'static str) -> Self {
        self.consequences.push((rule, reason));
        self
    }

    /// The base with this defect, once for each place: at most [`MOST_PLACES`], evenly spread.
    pub fn mutants(&self, base: &Base) -> Vec<Mutant> {
        let all = (self.places)(base);
        let kept = all.len().min(MOST_PLACES);
        (0..kept).map(|place| all[place * all.len() / kept].clone()).collect()
    }
}

/// The entries with this key of the sections that `wanted` picks get another value.
pub(crate) fn value(
    rule: &'static str,
    kind: &'static str,
    key: &'static str,
    wanted: fn(&Section) -> bool,
    new: &'static str,
) -> Defect {
    value_of(rule, kind, key, wanted, move |_, _| Some(new.to_owned()))
}

/// The items of the lists that `wanted` picks get another value.
pub(crate) fn item(
    rule: &'static str,
    kind: &'static str,
    wanted: fn(&Section) -> bool,
    new: &'static str,
) -> Defect {
    Defect::new(rule, kind, move |base| {
        let items = base.sections_where(wanted).into_iter().flat_map(Section::items);
        items.map(|item| Mutant::of(base).set(item, new)).collect()
    })
}

/// The entries with this key get the value that `new` makes of the section and the old one.
pub(crate) fn value_of(
    rule: &'static str,
    kind: &'static str,
    key: &'static str,
    wanted: fn(&Section) -> bool,
    new: impl Fn(&Section, &str) -> Option<String> + 'static,
) -> Defect {
    Defect::new(rule, kind, move |base| {
        let sections = base.sections_where(wanted);
        let entries = sections.iter().filter_map(|section| Some((section, section.entry(key)?)));
        let changed = entries.filter_map(|(section, entry)| {
            let new = new(section, &entry.value)?;
            (new != entry.value).then(|| Mutant::of(base).set(entry, &new))
        });
        changed.collect()
    })
}

/// The sections that `wanted` picks lose an entry; the finding is expected at their header.
pub(crate) fn missing(
    rule: &'static str,
    kind: impl Into<String>,
    key: &'static str,
    wanted: fn(&Section) -> bool,
) -> Defect {
    Defect::new(rule, kind, move |base| {
        let sections = base.sections_where(wanted).into_iter();
        let lost = sections.filter_map(|section| {
            let entry = section.entry(key)?;
            Some(Mutant::of(base).delete(entry.line).expect(section.header))
        });
        lost.collect()
    })
}

/// The sections that `wanted` picks get a line more.
pub(crate) fn added(
    rule: &'static str,
    kind: &'static str,
    wanted: fn(&Section) -> bool,
    line: &'static str,
) -> Defect {
    Defect::new(rule, kind, move |base| {
        let sections = base.sections_where(wanted).into_iter();
        sections.map(|section| Mutant::of(base).insert(section.behind_entries(), line)).collect()
    })
}

/// The headers of the sections that `wanted` picks are written otherwise.
pub(crate) fn header(
    rule: &'static str,
    kind: &'static str,
    wanted: fn(&Section) -> bool,
    new: fn(&Section) -> String,
) -> Defect {
    Defect::new(rule, kind, move |base| {
        let sections = base.sections_where(wanted).into_iter();
        sections.map(|section| Mutant::of(base).rewrite(section.header, new(section))).collect()
    })
}

/// A line is put before the headers of the sections that `wanted` picks.
pub(crate) fn line_before(
    rule: &'static str,
    kind: &'static str,
    wanted: fn(&Section) -> bool,
    line: &'static str,
) -> Defect {
    Defect::new(rule, kind, move |base| {
        let sections = base.sections_where(wanted).into_iter();
        sections.map(|section| Mutant::of(base).insert(section.header, line)).collect()
    })
}

/// A defect that a base has at one place, or not at all.
pub(crate) fn once(
    rule: &'static str,
    kind: &'static str,
    place: impl Fn(&Base) -> Option<Mutant> + 'static,
) -> Defect {
    Defect::new(rule, kind, move |base| place(base).into_iter().collect())
}
