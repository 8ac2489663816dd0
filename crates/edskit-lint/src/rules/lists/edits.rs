//! Edits of a list that keep its keys and its count right.

use crate::listing::{Item, ItemKey, List};
use crate::{Context, Edit};
use edskit_model::{KeyName, Section};
use edskit_types::Index;

/// Whether the items of a list are numbered 1 to n in the order of the file and `SupportedObjects` is n.
pub(super) fn is_regular(context: &Context<'_>, list: List) -> bool {
    let items = context.listing().items_of(list);
    let document = context.document();
    let has_number = |(position, item): (usize, &Item)| {
        item.key == ItemKey::Number(position as u16 + 1)
            && item.key_span(document).slice(context.source())[0] != b'0'
    };
    let count = list
        .section(context.sheet)
        .and_then(|section| section.filled(KeyName::SupportedObjects)?.unsigned::<u16>().known());
    count.map(usize::from) == Some(items.len()) && items.iter().enumerate().all(has_number)
}

/// Takes items out of a list and numbers the others from 1 in the order of the file.
pub(super) fn renumber(context: &Context<'_>, list: List, keep: impl Fn(&Item) -> bool) -> Vec<Edit> {
    let document = context.document();
    let mut edits = Vec::new();
    let mut count = 0;
    for item in context.listing().items_of(list) {
        if !keep(item) {
            edits.push(Edit::delete(item.line_span(document)));
            continue;
        }
        count += 1;
        let key = item.key_span(document);
        let number = count.to_string();
        if key.slice(context.source()) != number.as_bytes() {
            edits.push(Edit::replace(key, number));
        }
    }
    with_count(context, list, count, edits)
}

/// Puts indices at the end of a list.
pub(super) fn append(context: &Context<'_>, list: List, indices: &[Index]) -> Vec<Edit> {
    let Some(section) = list.section(context.sheet) else { return Vec::new() };
    let before = context.listing().items_of(list).len();
    let edit = Edit::insert(section.end().start, items(context, before, indices));
    with_count(context, list, before + indices.len(), vec![edit])
}

/// Lines with the items after the first `before` ones, each with a line ending before it.
pub(super) fn items(context: &Context<'_>, before: usize, indices: &[Index]) -> String {
    let ending = context.document().line_ending().as_str();
    let line =
        |(position, index): (usize, &Index)| format!("{ending}{}=0x{index:04X}", before + position + 1);
    indices.iter().enumerate().map(line).collect()
}

/// An edit that writes `SupportedObjects`, unless it is right already.
pub(super) fn count(context: &Context<'_>, section: Section<'_>, count: usize) -> Option<Edit> {
    let count = count.to_string();
    match section.entry(KeyName::SupportedObjects) {
        None => {
            let ending = context.document().line_ending().as_str();
            let line = format!("{ending}SupportedObjects={count}");
            Some(Edit::insert(section.line().span().end, line))
        }
        Some(entry)
            if entry.unsigned::<u16>().known().map(|known| known.to_string()) == Some(count.clone()) =>
        {
            None
        }
        Some(entry) => Some(Edit::replace(entry.value_span(), count)),
    }
}

/// The edits and the one for `SupportedObjects`, in the order of the file.
fn with_count(context: &Context<'_>, list: List, number: usize, mut edits: Vec<Edit>) -> Vec<Edit> {
    edits.extend(list.section(context.sheet).and_then(|section| count(context, section, number)));
    edits.sort_by_key(|edit| edit.span);
    edits
}
