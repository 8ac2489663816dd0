//! Comments behind values, which SYN012 moves to a line of their own.
//!
//! Every other rule reads the value without the comment, and would take it away together with the value.

use crate::rules::syntax::inline_comment::INLINE_COMMENT;
use crate::{Context, Edit, Finding};
use edskit_model::meant::value_length;
use edskit_model::{Shape, Span};

/// Takes out fixes that would delete such a comment: once SYN012 has moved it, they are offered again.
pub(crate) fn protect(context: &Context<'_>, findings: &mut [Finding]) {
    let comments: Vec<Span> = context
        .odd_entries()
        .filter(|entry| {
            let shape = entry.section().map(|section| section.kind().shape_of(entry.key().name));
            !matches!(shape, None | Some(Shape::Text(_)))
        })
        .filter_map(|entry| {
            let value = entry.value_span();
            let length = value_length(entry.raw())?;
            Some(value.sub(length, value.len() - length))
        })
        .collect();
    if comments.is_empty() {
        return;
    }
    for finding in findings.iter_mut().filter(|finding| *finding.rule != INLINE_COMMENT) {
        let deletes = |edit: &Edit| {
            comments.iter().any(|comment| edit.span.start < comment.end && comment.start < edit.span.end)
        };
        if finding.fix.as_ref().is_some_and(|fix| fix.edits.iter().any(deletes)) {
            finding.fix = None;
        }
    }
}
