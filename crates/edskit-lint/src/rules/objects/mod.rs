//! OBJ: the attributes of objects.

mod sub0_not_u8;

use crate::Rule;

/// The rules of the group, sorted by code.
pub(super) const RULES: &[&Rule] = &[&sub0_not_u8::SUB0_NOT_U8];
