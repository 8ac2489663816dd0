//! Sections of one object together, because one slip is often made in all of its headers.

use edskit_model::SectionKind;
use std::collections::HashMap;

/// Puts what is about the same object together, in the order of the first of each; what is about another section stays
/// alone.
pub(super) fn by_object<T>(items: impl IntoIterator<Item = (SectionKind, T)>) -> Vec<Vec<T>> {
    let mut groups: Vec<Vec<T>> = Vec::new();
    let mut of_object = HashMap::new();
    for (kind, item) in items {
        let is_of_module = matches!(kind, SectionKind::Module(..));
        let position = match kind.index().filter(|_| !is_of_module) {
            Some(index) => *of_object.entry(index).or_insert(groups.len()),
            None => groups.len(),
        };
        match groups.get_mut(position) {
            Some(group) => group.push(item),
            None => groups.push(vec![item]),
        }
    }
    groups
}
