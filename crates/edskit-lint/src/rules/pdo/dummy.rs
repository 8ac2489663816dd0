//! Mapping entries that name a data type to fill a gap (CiA 306 v1.3, 4.6.2).

use edskit_model::{Datasheet, Entry, Field, KeyName, SectionKind};
use edskit_types::{DataType, Index, MappingEntry};

/// What `[DummyUsage]` says about a data type.
pub(super) fn flag(sheet: &Datasheet, index: Index) -> Option<Field<'_, bool>> {
    let entry = sheet.section(SectionKind::DummyUsage)?.numbered(KeyName::Dummy, index.0)?;
    (!entry.is_empty()).then(|| Entry::flag(entry))
}

/// Whether an entry is a dummy of the form that CiA 301 gives it: one of the types 0001h to 0007h, sub-index 00h, all
/// its bits.
pub(super) fn is_plain(entry: MappingEntry) -> bool {
    let data_type = DataType::from_index(entry.index()).filter(|data_type| data_type.can_be_dummy());
    entry.sub_index().0 == 0
        && data_type.is_some_and(|data_type| data_type.bits() == Some(u16::from(entry.bits())))
}
