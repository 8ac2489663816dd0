//! OBJ: the attributes of objects.

mod access_type_invalid;
mod access_type_missing;
mod array_mixed_types;
mod compact_and_sub_number;
mod compact_list_mismatch;
mod data_type_missing;
mod decimal_sub_index;
mod domain_incomplete;
mod duplicate_name;
mod key_not_supported;
mod obj_flags_redundant;
mod obj_flags_reserved;
mod object_links_dangling;
mod object_type_invalid;
mod orphan_sub_object;
mod parameter_name_missing;
mod pdo_mapping_invalid;
mod pdo_mapping_unmappable;
mod process_access_unmapped;
mod record_as_array;
mod save_objects_flags;
pub(crate) mod structure;
mod sub0_limit_undescribed;
mod sub0_missing;
mod sub0_not_u8;
mod sub0_wrong_value;
mod sub_index_too_large;
mod sub_number_mismatch;
mod sub_number_missing;
mod sub_object_under_var;
mod words;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &parameter_name_missing::PARAMETER_NAME_MISSING,
    &object_type_invalid::OBJECT_TYPE_INVALID,
    &data_type_missing::DATA_TYPE_MISSING,
    &access_type_missing::ACCESS_TYPE_MISSING,
    &access_type_invalid::ACCESS_TYPE_INVALID,
    &key_not_supported::KEY_NOT_SUPPORTED,
    &sub_number_missing::SUB_NUMBER_MISSING,
    &sub_number_mismatch::SUB_NUMBER_MISMATCH,
    &compact_and_sub_number::COMPACT_AND_SUB_NUMBER,
    &orphan_sub_object::ORPHAN_SUB_OBJECT,
    &sub_object_under_var::SUB_OBJECT_UNDER_VAR,
    &sub0_missing::SUB0_MISSING,
    &sub0_not_u8::SUB0_NOT_U8,
    &sub0_wrong_value::SUB0_WRONG_VALUE,
    &array_mixed_types::ARRAY_MIXED_TYPES,
    &record_as_array::RECORD_AS_ARRAY,
    &compact_list_mismatch::COMPACT_LIST_MISMATCH,
    &obj_flags_reserved::OBJ_FLAGS_RESERVED,
    &obj_flags_redundant::OBJ_FLAGS_REDUNDANT,
    &save_objects_flags::SAVE_OBJECTS_FLAGS,
    &object_links_dangling::OBJECT_LINKS_DANGLING,
    &pdo_mapping_invalid::PDO_MAPPING_INVALID,
    &pdo_mapping_unmappable::PDO_MAPPING_UNMAPPABLE,
    &process_access_unmapped::PROCESS_ACCESS_UNMAPPED,
    &duplicate_name::DUPLICATE_NAME,
    &sub0_limit_undescribed::SUB0_LIMIT_UNDESCRIBED,
    &sub_index_too_large::SUB_INDEX_TOO_LARGE,
    &decimal_sub_index::DECIMAL_SUB_INDEX,
    &domain_incomplete::DOMAIN_INCOMPLETE,
];
