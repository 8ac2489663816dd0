//! FIL: `[FileInfo]`.

mod date_format;
mod date_impossible;
mod eds_version_format;
mod file_version_not_u8;
mod filename_mismatch;
mod last_eds;
mod missing_file_info;
mod missing_file_info_entry;
mod string_too_long;
mod time_format;
mod timestamp;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &missing_file_info::MISSING_FILE_INFO,
    &missing_file_info_entry::MISSING_FILE_INFO_ENTRY,
    &file_version_not_u8::FILE_VERSION_NOT_U8,
    &eds_version_format::EDS_VERSION_FORMAT,
    &time_format::TIME_FORMAT,
    &date_format::DATE_FORMAT,
    &date_impossible::DATE_IMPOSSIBLE,
    &filename_mismatch::FILENAME_MISMATCH,
    &string_too_long::STRING_TOO_LONG,
    &last_eds::LAST_EDS,
];
