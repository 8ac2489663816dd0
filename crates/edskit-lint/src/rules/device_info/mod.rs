//! DEV: `[DeviceInfo]`.

mod boolean_not_0_1;
mod compact_pdo_reserved;
mod dynamic_channels_section;
mod granularity_range;
mod granularity_vs_mapping;
mod identity;
mod identity_mismatch;
mod lss_needs_identity;
mod missing_device_info;
mod missing_device_info_entry;
mod no_baud_rate;
mod pdo_count_mismatch;
mod pdos;
mod unknown_baud_rate_key;
mod vendor_number_zero;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &missing_device_info::MISSING_DEVICE_INFO,
    &missing_device_info_entry::MISSING_DEVICE_INFO_ENTRY,
    &boolean_not_0_1::BOOLEAN_NOT_0_1,
    &no_baud_rate::NO_BAUD_RATE,
    &unknown_baud_rate_key::UNKNOWN_BAUD_RATE_KEY,
    &identity_mismatch::IDENTITY_MISMATCH,
    &vendor_number_zero::VENDOR_NUMBER_ZERO,
    &granularity_range::GRANULARITY_RANGE,
    &granularity_vs_mapping::GRANULARITY_VS_MAPPING,
    &pdo_count_mismatch::PDO_COUNT_MISMATCH,
    &compact_pdo_reserved::COMPACT_PDO_RESERVED,
    &dynamic_channels_section::DYNAMIC_CHANNELS_SECTION,
    &lss_needs_identity::LSS_NEEDS_IDENTITY,
];
