//! SYN: the text of the file.

mod by_object;
mod byte_order_mark;
mod comment_not_in_column_1;
mod control_character;
mod duplicate_key;
mod duplicate_section;
mod entry_not_in_column_1;
mod entry_outside_section;
mod formulas;
mod hash_comment;
pub(crate) mod inline_comment;
mod invalid_number;
mod leading_zero_name;
mod line_too_long;
pub(crate) mod line_without_equals;
pub(crate) mod lost_header;
mod malformed_section;
mod mixed_line_endings;
mod nodeid_bad_expression;
mod nodeid_not_first;
mod nodeid_style;
mod non_ascii;
pub(crate) mod not_canopen;
mod octal_looking_number;
mod quoted_string;
mod repeats;
mod section_alias;
mod section_not_in_column_1;
mod space_before_equals;
mod typed;
mod unknown_key;
mod unknown_section;
pub(crate) mod unused_suppression;
mod unusual_case;
mod wrong_count;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &not_canopen::NOT_CANOPEN,
    &non_ascii::NON_ASCII,
    &byte_order_mark::BYTE_ORDER_MARK,
    &line_too_long::LINE_TOO_LONG,
    &mixed_line_endings::MIXED_LINE_ENDINGS,
    &section_not_in_column_1::SECTION_NOT_IN_COLUMN_1,
    &malformed_section::MALFORMED_SECTION,
    &entry_outside_section::ENTRY_OUTSIDE_SECTION,
    &line_without_equals::LINE_WITHOUT_EQUALS,
    &space_before_equals::SPACE_BEFORE_EQUALS,
    &comment_not_in_column_1::COMMENT_NOT_IN_COLUMN_1,
    &hash_comment::HASH_COMMENT,
    &inline_comment::INLINE_COMMENT,
    &duplicate_section::DUPLICATE_SECTION,
    &duplicate_key::DUPLICATE_KEY,
    &section_alias::SECTION_ALIAS,
    &leading_zero_name::LEADING_ZERO_NAME,
    &invalid_number::INVALID_NUMBER,
    &octal_looking_number::OCTAL_LOOKING_NUMBER,
    &quoted_string::QUOTED_STRING,
    &nodeid_not_first::NODEID_NOT_FIRST,
    &nodeid_style::NODEID_STYLE,
    &nodeid_bad_expression::NODEID_BAD_EXPRESSION,
    &unknown_section::UNKNOWN_SECTION,
    &unknown_key::UNKNOWN_KEY,
    &control_character::CONTROL_CHARACTER,
    &entry_not_in_column_1::ENTRY_NOT_IN_COLUMN_1,
    &unused_suppression::UNUSED_SUPPRESSION,
    &wrong_count::WRONG_COUNT,
    &unusual_case::UNUSUAL_CASE,
];
