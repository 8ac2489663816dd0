//! Which fixes can be applied together, and the text after them.

use super::state::State;
use crate::{Applicability, Edit, Fix};
use edskit_model::{Datasheet, Encoding, LineEnding, Span};

/// The fixes that are sure enough.
pub(super) fn wanted(state: &State, least: Applicability) -> impl Iterator<Item = &Fix> {
    let fixes = state.findings.iter().filter_map(|finding| finding.fix.as_ref());
    fixes.filter(move |fix| is_wanted(fix, least))
}

pub(super) fn is_wanted(fix: &Fix, least: Applicability) -> bool {
    fix.applicability >= least && !fix.edits.is_empty()
}

/// The fixes of one round in the order of the file: those that overlap none before them and can be applied.
pub(super) fn choose<'a>(state: &'a State, least: Applicability, refused: &[Fix]) -> Vec<&'a Fix> {
    let length = state.sheet.document().to_bytes().len();
    let encoding = state.sheet.document().encoding();
    let mut fixes: Vec<&Fix> = wanted(state, least)
        .filter(|fix| is_applicable(fix, length, encoding) && !refused.contains(fix))
        .collect();
    fixes.sort_by_key(|fix| extent(fix));
    let mut last: Option<Span> = None;
    fixes.retain(|fix| {
        let extent = extent(fix);
        // Not even touching: of two that insert at one place, nobody knows which text comes first.
        let is_free = last.is_none_or(|last| last.end < extent.start);
        if is_free {
            last = Some(extent);
        }
        is_free
    });
    fixes
}

/// Whether the edits lie in the file in order and apart, and can be written in its encoding.
pub(super) fn is_applicable(fix: &Fix, length: usize, encoding: Encoding) -> bool {
    let spans = || fix.edits.iter().map(|edit| edit.span);
    let is_in_order = spans().is_sorted_by(|a, b| a.end <= b.start);
    let is_inside = spans().all(|span| span.start <= span.end && span.end as usize <= length);
    is_in_order && is_inside && fix.edits.iter().all(|edit| encoding.can_encode(&edit.replacement))
}

/// From the first edit to the end of the last.
pub(super) fn extent(fix: &Fix) -> Span {
    let (first, last) = (&fix.edits[0], &fix.edits[fix.edits.len() - 1]);
    Span::new(first.span.start, last.span.end)
}

/// A refused fix where it stands after others were applied; `None` where one of them touched its place, so that it may
/// be tried again.
pub(super) fn moved(mut fix: Fix, applied: &[Fix], before: &State) -> Option<Fix> {
    for edit in &mut fix.edits {
        let mut shift = 0;
        for other in applied.iter().flat_map(|fix| &fix.edits) {
            if other.span.start > edit.span.end {
                break;
            }
            if other.span.end >= edit.span.start {
                return None;
            }
            shift += written(other, &before.sheet).len() as i64 - other.span.len() as i64;
        }
        let place = |offset: u32| u32::try_from(i64::from(offset) + shift).ok();
        edit.span = Span::new(place(edit.span.start)?, place(edit.span.end)?);
    }
    Some(fix)
}

pub(super) fn apply(sheet: &Datasheet, fixes: &[&Fix]) -> Vec<u8> {
    let source = sheet.document().to_bytes();
    let mut result = Vec::with_capacity(source.len());
    let mut done = 0;
    for edit in fixes.iter().flat_map(|fix| &fix.edits) {
        result.extend_from_slice(&source[done..edit.span.start as usize]);
        result.extend_from_slice(&written(edit, sheet));
        done = edit.span.end as usize;
    }
    result.extend_from_slice(&source[done..]);
    result
}

/// The replacement in the encoding and with the line endings of the file.
pub(super) fn written(edit: &Edit, sheet: &Datasheet) -> Vec<u8> {
    let document = sheet.document();
    match document.line_ending() {
        LineEnding::Lf | LineEnding::None => document.encoding().encode(&edit.replacement),
        ending => document.encoding().encode(&with_endings(&edit.replacement, ending)),
    }
}

pub(super) fn with_endings(text: &str, ending: LineEnding) -> String {
    text.replace("\r\n", "\n").replace('\n', ending.as_str())
}
