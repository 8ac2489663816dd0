//! Sub-objects that share one defect get one finding.

use crate::profile::Prescribed;
use crate::{Context, Edit, Variable};
use edskit_model::{Field, Span, SubObject};
use edskit_types::AccessType;

/// The further sub-objects for which the same is prescribed, and which are wrong in the same way as this variable;
/// `None` where it is itself one of those that an earlier sub-object is reported for.
pub(super) fn further<'a>(
    context: &'a Context<'_>,
    variable: &Variable<'a>,
    prescribed: Prescribed<'a>,
    is_wrong_too: impl Fn(SubObject<'a>) -> bool,
) -> Option<Vec<SubObject<'a>>> {
    let Some(own) = variable.sub_index else { return Some(Vec::new()) };
    let mut later = Vec::new();
    for sub in context.sheet.object(variable.index).into_iter().flat_map(|object| object.sub_objects()) {
        let sibling = prescribed.sibling(sub.sub_index());
        let is_alike = sibling.is_some_and(|sibling| sibling.attributes == prescribed.attributes);
        if sub.sub_index() == own || !is_alike || !is_wrong_too(sub) {
            continue;
        }
        if sub.sub_index() < own {
            return None;
        }
        later.push(sub);
    }
    Some(later)
}

/// What a message says about the further sub-objects: nothing, or ` (like 3 further sub-indices)`.
pub(super) fn like(further: &[SubObject<'_>]) -> String {
    match further.len() {
        0 => String::new(),
        1 => " (like one further sub-index)".to_owned(),
        count => format!(" (like {count} further sub-indices)"),
    }
}

/// Writes `access` here and at the further sub-objects.
pub(super) fn rewrite(
    field: Field<'_, AccessType>,
    further: &[SubObject<'_>],
    access: AccessType,
) -> Vec<Edit> {
    let others = further.iter().filter_map(|sub| sub.access_type()).map(|field| field.span());
    let mut spans: Vec<Span> = others.chain([field.span()]).collect();
    spans.sort_unstable();
    spans.into_iter().map(|span| Edit::replace(span, access.as_str())).collect()
}
