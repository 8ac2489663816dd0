//! MOD: modular devices.

mod fixed_and_described;
mod fixed_and_extended;
mod module_list_count;
mod module_list_object;
mod module_object_not_described;
mod module_object_not_listed;
mod module_objects_differ;
mod module_section_missing;
mod module_values;
mod parts;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &module_section_missing::MODULE_SECTION_MISSING,
    &module_values::MODULE_VALUES,
    &fixed_and_described::FIXED_AND_DESCRIBED,
    &fixed_and_extended::FIXED_AND_EXTENDED,
    &module_object_not_described::MODULE_OBJECT_NOT_DESCRIBED,
    &module_object_not_listed::MODULE_OBJECT_NOT_LISTED,
    &module_list_count::MODULE_LIST_COUNT,
    &module_objects_differ::MODULE_OBJECTS_DIFFER,
    &module_list_object::MODULE_LIST_OBJECT,
];
