//! The numbers of `[DeviceInfo]` and the sub-objects of 1018h that they repeat.

use edskit_model::{Datasheet, Entry, KeyName, Value};
use edskit_types::{Index, SubIndex};

/// A number of `[DeviceInfo]` and the sub-index of 1018h with the same meaning.
pub(super) const NUMBERS: [(KeyName, SubIndex); 3] = [
    (KeyName::VendorNumber, SubIndex(1)),
    (KeyName::ProductNumber, SubIndex(2)),
    (KeyName::RevisionNumber, SubIndex(3)),
];

/// What 1018h says at `sub_index`: the default value, and the value of a DCF.
pub(super) fn values(sheet: &Datasheet, sub_index: SubIndex) -> impl Iterator<Item = (u32, Entry<'_>)> {
    let sub = sheet.sub_object(Index::IDENTITY, sub_index);
    let fields = sub.map(|sub| [sub.default_value(), sub.parameter_value()]).into_iter().flatten().flatten();
    fields.filter_map(|field| match field.known()? {
        Value::Integer(number) => Some((number.to()?, field.entry)),
        _ => None,
    })
}

/// The value of 1018h that counts first: the default.
pub(super) fn value(sheet: &Datasheet, sub_index: SubIndex) -> Option<(u32, Entry<'_>)> {
    values(sheet, sub_index).next()
}

/// What `[DeviceInfo]` says.
pub(super) fn number(sheet: &Datasheet, name: KeyName) -> Option<(u32, Entry<'_>)> {
    let entry = sheet.device_info()?.filled(name)?;
    Some((entry.unsigned().known()?, entry))
}
