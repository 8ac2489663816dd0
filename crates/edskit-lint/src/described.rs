//! Whether a device has an object.

use edskit_model::{Datasheet, SectionKind};
use edskit_types::Index;

/// Whether an object is described, or at least named by a list, which is the matter of LST004.
pub(crate) fn is_known(sheet: &Datasheet, index: Index) -> bool {
    if sheet.object(index).is_some() {
        return true;
    }
    let lists =
        [SectionKind::MandatoryObjects, SectionKind::OptionalObjects, SectionKind::ManufacturerObjects];
    let mut items = lists.into_iter().filter_map(|kind| sheet.section(kind)).flat_map(|list| list.items());
    items.any(|item| item.index.known() == Some(index.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_counts() {
        let sheet = Datasheet::parse(b"[OptionalObjects]\n1=0x1017\n[1000]\n");
        let known = [0x1000, 0x1017, 0x1018].map(|index| is_known(&sheet, Index(index)));
        assert_eq!(known, [true, true, false]);
    }
}
