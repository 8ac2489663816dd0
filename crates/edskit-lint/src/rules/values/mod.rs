//! VAL: data types and values.

mod boolean_value;
mod const_without_value;
mod formula_overflow;
mod hex_ambiguous;
mod limit_on_nonnumeric;
mod limits;
mod low_above_high;
mod nodeid_on_noninteger;
mod octet_string_format;
mod reading;
mod redundant_limits;
mod unknown_datatype;
mod unreadable_value;
mod value_out_of_range;
mod value_outside_limits;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &unknown_datatype::UNKNOWN_DATATYPE,
    &value_out_of_range::VALUE_OUT_OF_RANGE,
    &low_above_high::LOW_ABOVE_HIGH,
    &value_outside_limits::VALUE_OUTSIDE_LIMITS,
    &limit_on_nonnumeric::LIMIT_ON_NONNUMERIC,
    &nodeid_on_noninteger::NODEID_ON_NONINTEGER,
    &formula_overflow::FORMULA_OVERFLOW,
    &boolean_value::BOOLEAN_VALUE,
    &octet_string_format::OCTET_STRING_FORMAT,
    &hex_ambiguous::HEX_AMBIGUOUS,
    &const_without_value::CONST_WITHOUT_VALUE,
    &redundant_limits::REDUNDANT_LIMITS,
    &unreadable_value::UNREADABLE_VALUE,
];
