//! LST: the lists of objects.

mod decimal_index;
mod edits;
mod extra_mandatory;
mod list_numbering;
mod list_section_missing;
mod listed_twice;
mod listed_without_section;
mod mandatory_object_missing;
mod reserved_index;
mod section_not_listed;
mod supported_objects_count;
mod wrong_list;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &list_section_missing::LIST_SECTION_MISSING,
    &supported_objects_count::SUPPORTED_OBJECTS_COUNT,
    &list_numbering::LIST_NUMBERING,
    &listed_without_section::LISTED_WITHOUT_SECTION,
    &section_not_listed::SECTION_NOT_LISTED,
    &listed_twice::LISTED_TWICE,
    &mandatory_object_missing::MANDATORY_OBJECT_MISSING,
    &wrong_list::WRONG_LIST,
    &extra_mandatory::EXTRA_MANDATORY,
    &reserved_index::RESERVED_INDEX,
    &decimal_index::DECIMAL_INDEX,
];
