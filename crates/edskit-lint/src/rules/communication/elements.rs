//! Elements of an ARRAY that share one defect get one finding.

use crate::{Context, Edit, Variable};
use edskit_model::{Field, Span, SubObject};
use edskit_types::{AccessType, ObjectCode};

/// The further elements that are wrong in the same way as this variable; `None` where it is itself one of those that an
/// earlier element is reported for. Only the elements of an ARRAY and the entries of a mapping are taken together.
pub(super) fn further<'a>(
    context: &Context<'a>,
    variable: &Variable<'a>,
    is_wrong_too: impl Fn(SubObject<'a>) -> bool,
) -> Option<Vec<SubObject<'a>>> {
    let Some(own) = variable.sub_index.filter(|sub_index| (1..0xFF).contains(&sub_index.0)) else {
        return Some(Vec::new());
    };
    let is_mapping = variable.index.is_rpdo_mapping() || variable.index.is_tpdo_mapping();
    let is_array = |code: &[ObjectCode]| code.is_empty() || code.contains(&ObjectCode::Array);
    if !is_mapping && !variable.prescriptions.iter().any(|prescription| is_array(&prescription.object.codes))
    {
        return Some(Vec::new());
    }
    let mut later = Vec::new();
    for sub in context.sheet.object(variable.index)?.sub_objects() {
        let sub_index = sub.sub_index();
        if sub_index.0 == 0 || sub_index.0 == 0xFF || sub_index == own || !is_wrong_too(sub) {
            continue;
        }
        if sub_index < own {
            return None;
        }
        later.push(sub);
    }
    Some(later)
}

/// What a message says about the further elements: nothing, or ` (like 3 further elements)`.
pub(super) fn like(further: &[SubObject<'_>]) -> String {
    match further.len() {
        0 => String::new(),
        1 => " (like one further element)".to_owned(),
        count => format!(" (like {count} further elements)"),
    }
}

/// Writes `access` here and at the further elements.
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
