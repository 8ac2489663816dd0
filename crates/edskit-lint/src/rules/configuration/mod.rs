//! DCF: device configuration files.

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[];
