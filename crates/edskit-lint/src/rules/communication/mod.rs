//! COM: the communication profile of CiA 301, and what profiles prescribe for each object.

mod elements;
mod emcy_default;
mod error_history;
mod guard_pair;
mod no_error_control;
mod sync_cob_id;
mod sync_without_period;
mod value_not_allowed;
mod window_exceeds_period;
mod wording;
mod wrong_access;
mod wrong_datatype;
mod wrong_object_code;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &wrong_object_code::WRONG_OBJECT_CODE,
    &wrong_datatype::WRONG_DATATYPE,
    &wrong_access::WRONG_ACCESS,
    &error_history::ERROR_HISTORY,
    &sync_cob_id::SYNC_COB_ID,
    &sync_without_period::SYNC_WITHOUT_PERIOD,
    &window_exceeds_period::WINDOW_EXCEEDS_PERIOD,
    &value_not_allowed::VALUE_NOT_ALLOWED,
    &emcy_default::EMCY_DEFAULT,
    &no_error_control::NO_ERROR_CONTROL,
    &guard_pair::GUARD_PAIR,
];
