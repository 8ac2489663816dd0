//! COM: the communication profile of CiA 301.

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[];
