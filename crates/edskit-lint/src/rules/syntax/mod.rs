//! SYN: the text of the file.

mod duplicate_section;
pub(crate) mod not_canopen;
pub(crate) mod unused_suppression;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &not_canopen::NOT_CANOPEN,
    &duplicate_section::DUPLICATE_SECTION,
    &unused_suppression::UNUSED_SUPPRESSION,
];
