//! PDO: PDO communication and mapping.

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[];
