//! PRF: device profiles.

mod profile_object_missing;
mod profile_type_mismatch;
mod profile_without_type;
mod sub_object_missing;
mod sub_object_undefined;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &profile_without_type::PROFILE_WITHOUT_TYPE,
    &profile_object_missing::PROFILE_OBJECT_MISSING,
    &sub_object_missing::SUB_OBJECT_MISSING,
    &sub_object_undefined::SUB_OBJECT_UNDEFINED,
    &profile_type_mismatch::PROFILE_TYPE_MISMATCH,
];
