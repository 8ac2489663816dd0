//! What the values of entries are, also where the section decides it.

use edskit_model::{Entry, KeyName, Section, SectionKind, Shape};
use edskit_types::DataType;

/// What the value of a key is in a section of some kind. Items of lists are indices and numbers, names, or values.
#[inline]
pub(super) fn shape_in(section: SectionKind, name: KeyName) -> Shape {
    section.shape_of(name)
}

/// What the value of an entry is; text where CiA 306 does not know the key.
pub(super) fn shape(entry: Entry<'_>) -> Shape {
    let section = entry.section().map_or(SectionKind::Unknown, Section::kind);
    shape_in(section, entry.key().name)
}

/// The data type of the values in a section, if it is one of CiA 301.
pub(super) fn data_type(section: Section<'_>) -> Option<DataType> {
    section.value_type()
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_model::Datasheet;

    #[test]
    fn items_of_lists_depend_on_the_list() {
        let text = "[1000]\nDataType=0x7\n[1000Name]\n1=a\n[1000Value]\n1=5\n[MandatoryObjects]\n1=0x1000\n[x]\n1=2\n";
        let sheet = Datasheet::parse(text.as_bytes());
        let shapes: Vec<_> = sheet.entries().map(shape).collect();
        assert_eq!(
            shapes,
            [Shape::Unsigned(16), Shape::Text(0), Shape::Value, Shape::Unsigned(16), Shape::Text(0)]
        );
        let types: Vec<_> = sheet.sections().map(data_type).collect();
        assert_eq!(types, [Some(DataType::Unsigned32), None, Some(DataType::Unsigned32), None, None]);
    }
}
