//! PDO: PDO communication and mapping.

mod compact_pdo_unused;
mod double_mapping;
mod dummy;
mod dummy_invalid;
mod dummy_not_enabled;
mod dummy_usage_incomplete;
mod granularity_violated;
mod group_messaging;
mod incomplete_pdo;
mod leftover_entry;
mod length_mismatch;
mod mappable_rw;
mod mappable_without_pdo;
mod mapping_access;
mod mapping_count;
mod mapping_gap;
mod mapping_needs_cob_id;
mod mapping_too_long;
mod not_mappable;
mod pdo_parameter_missing;
mod reserved_type;
mod rtr_type_without_rtr;
mod sync_start_range;
mod target_missing;
mod timer_with_sync_type;
mod unmappable_type;
mod wrong_direction;
mod zero_entry;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &incomplete_pdo::INCOMPLETE_PDO,
    &mapping_count::MAPPING_COUNT,
    &mapping_too_long::MAPPING_TOO_LONG,
    &target_missing::TARGET_MISSING,
    &length_mismatch::LENGTH_MISMATCH,
    &not_mappable::NOT_MAPPABLE,
    &wrong_direction::WRONG_DIRECTION,
    &dummy_not_enabled::DUMMY_NOT_ENABLED,
    &dummy_invalid::DUMMY_INVALID,
    &reserved_type::RESERVED_TYPE,
    &rtr_type_without_rtr::RTR_TYPE_WITHOUT_RTR,
    &leftover_entry::LEFTOVER_ENTRY,
    &zero_entry::ZERO_ENTRY,
    &double_mapping::DOUBLE_MAPPING,
    &sync_start_range::SYNC_START_RANGE,
    &timer_with_sync_type::TIMER_WITH_SYNC_TYPE,
    &mappable_without_pdo::MAPPABLE_WITHOUT_PDO,
    &mapping_gap::MAPPING_GAP,
    &unmappable_type::UNMAPPABLE_TYPE,
    &mapping_access::MAPPING_ACCESS,
    &granularity_violated::GRANULARITY_VIOLATED,
    &group_messaging::GROUP_MESSAGING,
    &mappable_rw::MAPPABLE_RW,
    &compact_pdo_unused::COMPACT_PDO_UNUSED,
    &mapping_needs_cob_id::MAPPING_NEEDS_COB_ID,
    &pdo_parameter_missing::PDO_PARAMETER_MISSING,
    &dummy_usage_incomplete::DUMMY_USAGE_INCOMPLETE,
];
