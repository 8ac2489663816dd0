//! CPJ: nodelist.cpj.

mod baudrates_differ;
mod dcf_not_found;
pub(crate) mod network;
mod node_key_range;
mod nodes_count;
mod present_reserved;
mod several_managers;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &nodes_count::NODES_COUNT,
    &dcf_not_found::DCF_NOT_FOUND,
    &node_key_range::NODE_KEY_RANGE,
    &present_reserved::PRESENT_RESERVED,
    &several_managers::SEVERAL_MANAGERS,
    &baudrates_differ::BAUDRATES_DIFFER,
];
