//! COM: the communication profile of CiA 301, and what profiles prescribe for each object.

mod default_differs;
mod elements;
mod emcy_default;
mod error_field;
mod error_history;
mod guard_pair;
mod heartbeat_consumer;
mod identity_structure;
mod mappable_by_mistake;
mod no_error_control;
mod pdo_counts_differ;
mod run_time_value;
mod sdo_client_node;
mod sdo_server_default;
mod sync_cob_id;
mod sync_pdo_without_sync;
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
    &heartbeat_consumer::HEARTBEAT_CONSUMER,
    &identity_structure::IDENTITY_STRUCTURE,
    &sdo_server_default::SDO_SERVER_DEFAULT,
    &sdo_client_node::SDO_CLIENT_NODE,
    &sync_pdo_without_sync::SYNC_PDO_WITHOUT_SYNC,
    &default_differs::DEFAULT_DIFFERS,
    &pdo_counts_differ::PDO_COUNTS_DIFFER,
    &mappable_by_mistake::MAPPABLE_BY_MISTAKE,
    &run_time_value::RUN_TIME_VALUE,
];
