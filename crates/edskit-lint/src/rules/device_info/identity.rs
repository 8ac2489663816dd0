//! The numbers of `[DeviceInfo]` and the sub-objects of 1018h that they repeat.

use edskit_model::{Datasheet, Entry, KeyName, Value};
use edskit_types::{Index, SubIndex};

/// A number of `[DeviceInfo]` and the sub-index of 1018h with the same meaning.
pub(super) const NUMBERS: [(KeyName, SubIndex); 3] = [
    (KeyName::VendorNumber, SubIndex(1)),
    (KeyName::ProductNumber, SubIndex(2)),
    (KeyName::RevisionNumber, SubIndex(3)),
];

/// What 1018h says at `sub_index`: the default value, or the value of a DCF where there is no default.
pub(super) fn value(sheet: &Datasheet, sub_index: SubIndex) -> Option<(u32, Entry<'_>)> {
    let sub = sheet.sub_object(Index::IDENTITY, sub_index)?;
    let field = sub.default_value().or_else(|| sub.parameter_value())?;
    match field.known()? {
        Value::Integer(number) => Some((number.to()?, field.entry)),
        _ => None,
    }
}

/// What `[DeviceInfo]` says.
pub(super) fn number(sheet: &Datasheet, name: KeyName) -> Option<(u32, Entry<'_>)> {
    let entry = sheet.device_info()?.filled(name)?;
    Some((entry.unsigned().known()?, entry))
}
