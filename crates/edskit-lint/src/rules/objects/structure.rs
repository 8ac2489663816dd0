//! What several rules ask about the structure of an object.

use crate::{Context, Variable};
use edskit_model::meant::value_length;
use edskit_model::{Entry, Object, Section, SectionKind, SubObject};
use edskit_types::{Index, ObjectCode, SubIndex};

/// Sub-index FFh, which holds the structure of the object and counts nowhere.
const STRUCTURE: SubIndex = SubIndex(0xFF);

/// The described sub-objects without FFh, in ascending order.
pub(super) fn counted_subs<'a>(
    object: Object<'a>,
) -> impl ExactSizeIterator<Item = SubObject<'a>> + DoubleEndedIterator {
    let subs = object.sub_objects();
    let structure =
        usize::from(object.sub_objects().next_back().is_some_and(|sub| sub.sub_index() == STRUCTURE));
    let count = subs.len() - structure;
    subs.take(count)
}

/// The described sub-objects that are elements or members: neither 00h nor FFh.
pub(super) fn elements<'a>(
    object: Object<'a>,
) -> impl ExactSizeIterator<Item = SubObject<'a>> + DoubleEndedIterator {
    let skipped = usize::from(sub0(object).is_some());
    counted_subs(object).skip(skipped)
}

/// The described sub-index 00h.
pub(super) fn sub0(object: Object<'_>) -> Option<SubObject<'_>> {
    object.sub_objects().next().filter(|sub| sub.sub_index().0 == 0)
}

/// Whether the section must say `DataType` and `AccessType`: it holds a value of its own, or
/// stands for the compact sub-objects.
pub(super) fn needs_attributes(context: &Context<'_>, variable: &Variable<'_>) -> bool {
    match (variable.code, variable.sub_index) {
        (Some(ObjectCode::Var | ObjectCode::DefType), Some(_)) => !is_under_value(context, variable),
        // A VAR with sub-objects is the matter of OBJ011.
        (Some(ObjectCode::Var | ObjectCode::DefType), None) => {
            context.sheet.object(variable.index).is_none_or(|object| counted_subs(object).len() == 0)
        }
        (Some(ObjectCode::Array | ObjectCode::Record | ObjectCode::DefStruct), None) => variable
            .description
            .compact_sub_obj()
            .and_then(|field| field.known())
            .is_some_and(|count| count > 0),
        _ => false,
    }
}

/// Whether this is a sub-object of an object that has none: the matter of OBJ011 as a whole.
pub(super) fn is_under_value(context: &Context<'_>, variable: &Variable<'_>) -> bool {
    let has_none =
        |object: Object<'_>| object.description().object_code().is_some_and(|code| !code.has_sub_objects());
    variable.sub_index.is_some() && context.sheet.object(variable.index).is_some_and(has_none)
}

/// What CiA 301 fixes for objects that are often described with the wrong one of ARRAY and RECORD.
pub(super) fn fixed_code(index: Index) -> Option<ObjectCode> {
    match index.0 {
        0x1018 | 0x1200..=0x12FF | 0x1400..=0x1BFF => Some(ObjectCode::Record),
        0x1003 | 0x1010 | 0x1011 | 0x1016 | 0x1029 => Some(ObjectCode::Array),
        _ => None,
    }
}

/// Whether a value is left to another rule: SYN012 for text behind it, SYN020 to SYN022 for a formula.
pub(super) fn belongs_elsewhere(entry: Entry<'_>) -> bool {
    let raw = entry.raw();
    value_length(raw).is_some() || raw.contains(&b'$')
}

/// The object of a section that is named like a sub-object with a sub-index above FFh (OBJ027).
pub(super) fn beyond_ff(section: Section<'_>) -> Option<Index> {
    if section.kind() != SectionKind::Unknown {
        return None;
    }
    let name = section.name_span().slice(section.sheet().document().to_bytes());
    let position = name.windows(3).position(|window| window.eq_ignore_ascii_case(b"sub"))?;
    let SectionKind::Object(index) = SectionKind::of(&name[..position]) else { return None };
    let digits = &name[position + 3..];
    let significant = digits.iter().skip_while(|&&digit| digit == b'0').count();
    (significant > 2 && digits.iter().all(u8::is_ascii_hexdigit)).then_some(index)
}

/// Whether sub-objects with such names follow the described ones, so that there are more than seem to be.
pub(super) fn goes_beyond_ff(object: Object<'_>) -> bool {
    let Some(last) = counted_subs(object).next_back() else { return false };
    last.section().following().and_then(beyond_ff) == Some(object.index())
}
