//! What the entries of 1003h are, for the rules about them.

use crate::Variable;
use edskit_types::{Index, SubIndex};

/// A part of the pre-defined error field.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Part {
    /// Sub-index 00h: how many errors there are.
    Count,
    /// One of the errors.
    Error,
    /// The object's own section, which describes all errors where it is compact.
    Object,
}

/// Which part of 1003h a variable is; `None` for all other objects, and for sub-index FFh, which only tells the structure
/// (CiA 301 v4.2, 7.4.6).
#[inline]
pub(super) fn part(variable: &Variable<'_>) -> Option<Part> {
    if variable.index != Index::PREDEFINED_ERROR_FIELD {
        return None;
    }
    match variable.sub_index {
        None => Some(Part::Object),
        Some(SubIndex(0)) => Some(Part::Count),
        Some(SubIndex(0xFF)) => None,
        Some(_) => Some(Part::Error),
    }
}
