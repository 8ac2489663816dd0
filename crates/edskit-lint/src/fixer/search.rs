//! The search for the fixes that do harm, in all sections at once.

use super::edits::{apply, extent};
use super::state::{Places, State, places, worse_places};
use crate::{Applicability, Fix};
use std::collections::HashMap;

/// The search for the fixes of one round that make the file no worse.
pub(super) struct Round<'a, L> {
    pub(super) before: &'a State,
    /// In the order of the file.
    pub(super) accepted: Vec<&'a Fix>,
    /// The file with these, once there is one.
    pub(super) after: Option<State>,
    /// How often the search may still lint.
    pub(super) trials: usize,
    pub(super) lint: &'a L,
}

impl<'a, L: Fn(Vec<u8>) -> State> Round<'a, L> {
    /// Accepts all of these if they do no harm besides those that are accepted, else looks for the fixes to blame, which
    /// it returns. Where there is no time left for this, it blames them all.
    pub(super) fn try_all(&mut self, fixes: &[&'a Fix]) -> Vec<&'a Fix> {
        if fixes.is_empty() {
            return Vec::new();
        }
        let Some((together, after)) = self.with(fixes) else { return fixes.to_vec() };
        let before = self.after.as_ref().unwrap_or(self.before);
        let is_harmless = match fixes {
            [fix] => is_harmless(fix, before, &after),
            // What one fix mends must not hide what another one breaks.
            _ => after.has_no_more_than(before),
        };
        if is_harmless {
            self.accepted = together;
            self.after = Some(after);
            return Vec::new();
        }
        if fixes.len() == 1 {
            return fixes.to_vec();
        }
        let mut blamed = Vec::new();
        for part in self.divide(fixes, &worse_places(before, &after)) {
            blamed.extend(self.try_all(&part));
        }
        blamed
    }

    /// Two parts of fixes that do harm together: those in sections that got worse apart from the others, or where that
    /// says nothing, half of the fixes of every section. So many sections are searched at once.
    fn divide(&self, fixes: &[&'a Fix], worse: &Places) -> [Vec<&'a Fix>; 2] {
        let own_places = |fix: &&Fix| places(&self.before.sheet, fix.edits.iter().map(|edit| edit.span));
        let is_innocent = |fix: &&Fix| own_places(fix).is_disjoint(worse);
        let (innocent, suspect): (Vec<&Fix>, Vec<&Fix>) = fixes.iter().copied().partition(is_innocent);
        if !innocent.is_empty() && !suspect.is_empty() {
            return [innocent, suspect];
        }
        let place = |fix: &Fix| self.before.sheet.section_at(extent(fix).start).map(|section| section.id());
        let mut sizes: HashMap<Option<u32>, usize> = HashMap::new();
        for fix in fixes {
            *sizes.entry(place(fix)).or_default() += 1;
        }
        if sizes.len() == fixes.len() {
            let (left, right) = fixes.split_at(fixes.len() / 2);
            return [left.to_vec(), right.to_vec()];
        }
        let mut taken: HashMap<Option<u32>, usize> = HashMap::new();
        let (first, second) = fixes.iter().copied().partition(|fix| {
            let place = place(fix);
            let taken = taken.entry(place).or_default();
            *taken += 1;
            *taken <= sizes[&place].div_ceil(2)
        });
        [first, second]
    }

    /// Tries one after the other, and returns those that do harm.
    pub(super) fn try_each(&mut self, fixes: &[&'a Fix]) -> Vec<&'a Fix> {
        fixes.iter().flat_map(|fix| self.try_all(&[fix])).collect()
    }

    /// The file with these fixes besides those that are accepted; `None` where there is no time left for that.
    fn with(&mut self, fixes: &[&'a Fix]) -> Option<(Vec<&'a Fix>, State)> {
        self.trials = self.trials.checked_sub(1)?;
        let mut together: Vec<&Fix> = self.accepted.iter().chain(fixes).copied().collect();
        together.sort_by_key(|fix| extent(fix));
        let after = (self.lint)(apply(&self.before.sheet, &together));
        Some((together, after))
    }
}

/// Whether one fix leaves no more to complain about.
///
/// A safe fix may bring to light what its own mistake hid, since the file means the same before and after. An unsafe one
/// after which another rule complains has guessed wrong.
pub(super) fn is_harmless(fix: &Fix, before: &State, after: &State) -> bool {
    let is_lighter = after.burden() <= before.burden();
    is_lighter && (fix.applicability == Applicability::Safe || after.has_no_more_than(before))
}
