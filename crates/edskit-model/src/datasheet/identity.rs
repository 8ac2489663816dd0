//! What tells one section or one entry from another.

use super::{Entry, Section};
use crate::key::{Key, KeyName};
use crate::section::SectionKind;

/// A known name, or an unknown one in lower case. Two sections or entries that are equal are doubled.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Identity<T> {
    /// What CiA 306 knows.
    Known(T),
    /// Anything else.
    Unknown(Vec<u8>),
}

impl Section<'_> {
    /// What tells the section from others.
    pub(crate) fn identity(self) -> Identity<SectionKind> {
        match self.kind() {
            SectionKind::Unknown => {
                let name = self.name_span().slice(self.sheet().document().to_bytes());
                Identity::Unknown(name.to_ascii_lowercase())
            }
            kind => Identity::Known(kind),
        }
    }
}

impl Entry<'_> {
    /// What tells the entry from others of its section.
    pub(crate) fn identity(self) -> Identity<Key> {
        match self.key() {
            Key { name: KeyName::Unknown, .. } => {
                let key = self.key_span().slice(self.sheet.document().to_bytes());
                Identity::Unknown(key.to_ascii_lowercase())
            }
            key => Identity::Known(key),
        }
    }
}
