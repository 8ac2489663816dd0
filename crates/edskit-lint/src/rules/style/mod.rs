//! STY: style.

mod end_of_line_noise;
mod hex_style;
mod placeholder_text;
mod section_order;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[
    &section_order::SECTION_ORDER,
    &hex_style::HEX_STYLE,
    &end_of_line_noise::END_OF_LINE_NOISE,
    &placeholder_text::PLACEHOLDER_TEXT,
];
