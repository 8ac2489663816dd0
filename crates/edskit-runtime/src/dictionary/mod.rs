//! The object dictionary: what generated code and dictionaries built at run time give the node.

mod entry;
mod handle;
mod objects;
mod parts;
mod table;
mod text;
mod value;

pub use entry::{Entry, Flags, StorageGroup};
pub use handle::{Constant, Domain, Handle, Key, Readable};
pub use objects::Objects;
pub use parts::{Dictionary, Memory, Parts};
pub use table::{Limits, Position, Table};
pub use text::{OctetString, Octets, Text, UnicodeString, VisibleString, WriteError};
pub use value::{TimeDifference, Value};
pub(crate) use value::{copy, raw, unsigned};

#[cfg(test)]
pub(crate) mod testing {
    use super::{Entry, Flags, Table};
    use edskit_types::{DataType, Index, SubIndex};

    /// An entry of which only the place matters.
    pub(crate) fn entry(index: u16, sub_index: u8) -> Entry {
        Entry {
            index: Index(index),
            sub_index: SubIndex(sub_index),
            data_type: DataType::Unsigned8,
            flags: Flags::NONE,
            offset: 0,
            size: 1,
        }
    }

    /// A table of these entries and nothing else.
    pub(crate) fn table(entries: &[Entry]) -> Table<'_> {
        Table { entries, constants: &[], defaults: &[], limits: &[], dummies: 0, fingerprint: 0 }
    }
}
