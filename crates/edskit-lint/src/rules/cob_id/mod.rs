//! COB: COB-IDs and CAN-IDs.

mod cross_node_conflict;
mod duplicate_can_id;
mod extended_frame;
mod forgotten_node_id;
mod frame_bits;
mod hard_coded_node_id;
mod judged;
mod parameters;
mod predefined_deviation;
mod restricted_can_id;

pub(crate) use judged::JudgedCobId;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &restricted_can_id::RESTRICTED_CAN_ID,
    &forgotten_node_id::FORGOTTEN_NODE_ID,
    &duplicate_can_id::DUPLICATE_CAN_ID,
    &frame_bits::FRAME_BITS,
    &extended_frame::EXTENDED_FRAME,
    &hard_coded_node_id::HARD_CODED_NODE_ID,
    &predefined_deviation::PREDEFINED_DEVIATION,
    &cross_node_conflict::CROSS_NODE_CONFLICT,
];
