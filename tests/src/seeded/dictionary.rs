//! Changes of the object dictionary that keep the lists right.

use super::base::{Base, Entry, Section};
use super::mutant::Mutant;

/// The base without the item that lists an object; the items behind it move up.
pub(crate) fn unlisted(base: &Base, index: u16) -> Option<Mutant> {
    let (list, item) = base.listed(index)?;
    let items = list.items();
    let from = items.iter().position(|known| known.line == item.line)?;
    let count = list.entry("SupportedObjects")?;
    let mut mutant = Mutant::of(base).set_too(count, &(items.len() - 1).to_string());
    for pair in items[from..].windows(2) {
        mutant = mutant.set_too(pair[0], &pair[1].value);
    }
    Some(mutant.delete(items.last()?.line))
}

/// The base without an object, its sub-objects and its item in a list.
pub(crate) fn without_object(base: &Base, index: u16) -> Option<Mutant> {
    let mutant = unlisted(base, index)?;
    let name = format!("{index:04X}");
    let sections = base.sections_where(|section| section.name.starts_with(&name));
    Some(sections.into_iter().fold(mutant, Mutant::delete_section))
}

/// The mutant with one item more in a list.
pub(crate) fn also_listed(mutant: Mutant, list: &Section, index: u16) -> Option<Mutant> {
    let count = list.entry("SupportedObjects")?;
    let more = list.items().len() + 1;
    let item = format!("{more}=0x{index:04X}");
    Some(mutant.set_too(count, &more.to_string()).insert_too(list.behind_entries(), item))
}

/// The base without the last sub-object of an object; SubNumber and sub-index 00h say so.
pub(crate) fn without_last_sub_object(base: &Base, index: u16) -> Option<Mutant> {
    let subs = base.sub_objects(index);
    let [.., before, last] = subs[..] else { return None };
    let mutant = Mutant::of(base).delete_section(last);
    let mutant = mutant.set_too(base.object(index)?.entry("SubNumber")?, &(subs.len() - 1).to_string());
    let highest = base.sub_object(index, 0)?.entry("DefaultValue")?;
    Some(mutant.set_too(highest, &before.sub_index()?.to_string()))
}

/// The base with a sub-object more behind the last one; SubNumber and sub-index 00h say so. The finding is expected at
/// the new section.
pub(crate) fn with_sub_object(base: &Base, index: u16, sub_index: u8, entries: &[&str]) -> Option<Mutant> {
    let subs = base.sub_objects(index);
    let line = subs.last()?.end;
    let mutant = Mutant::of(base).insert_section(line, &format!("{index:04X}sub{sub_index:X}"), entries);
    let mutant = mutant.set_too(base.object(index)?.entry("SubNumber")?, &(subs.len() + 1).to_string());
    let highest = base.sub_object(index, 0)?.entry("DefaultValue")?;
    Some(mutant.set_too(highest, &sub_index.to_string()))
}

/// Every item of a list with the list.
pub(crate) fn items(base: &Base) -> Vec<(&Section, &Entry)> {
    let lists = base.lists();
    lists.into_iter().flat_map(|list| list.items().into_iter().map(move |item| (list, item))).collect()
}
