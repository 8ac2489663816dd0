//! DCF: device configuration files.

mod baudrate_unsupported;
mod commissioning_entry_missing;
mod commissioning_missing;
mod commissioning_spelling;
mod dcf_entry_in_eds;
mod download_upload_access;
mod lss_serial_mismatch;
mod manager_without_1f80;
mod node_id_mismatch;
mod node_id_range;
mod parameter_value_read_only;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &commissioning_missing::COMMISSIONING_MISSING,
    &commissioning_spelling::COMMISSIONING_SPELLING,
    &node_id_range::NODE_ID_RANGE,
    &baudrate_unsupported::BAUDRATE_UNSUPPORTED,
    &dcf_entry_in_eds::DCF_ENTRY_IN_EDS,
    &parameter_value_read_only::PARAMETER_VALUE_READ_ONLY,
    &download_upload_access::DOWNLOAD_UPLOAD_ACCESS,
    &node_id_mismatch::NODE_ID_MISMATCH,
    &manager_without_1f80::MANAGER_WITHOUT_1F80,
    &lss_serial_mismatch::LSS_SERIAL_MISMATCH,
    &commissioning_entry_missing::COMMISSIONING_ENTRY_MISSING,
];
