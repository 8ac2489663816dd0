//! What an EDS or DCF knows of a device on the bus.

use crate::files::{self, own_file, unreadable};
use crate::printable;
use edskit_model::{Datasheet, DictionaryEntry, Document, Object};
use edskit_types::{Index, SubIndex};
use std::fs;
use std::path::Path;

/// A device with its file.
pub(crate) struct KnownDevice {
    /// The file as it was named.
    pub(crate) file: String,
    pub(crate) sheet: Datasheet,
}

impl KnownDevice {
    pub(crate) fn read(path: &Path) -> Result<Self, String> {
        let path = files::one(path.as_os_str().to_owned())?;
        let file = path.to_string_lossy().into_owned();
        let bytes = fs::read(&path).map_err(|error| unreadable(&file, &error))?;
        if let Some(reason) = own_file(&bytes) {
            return Err(format!("{file}: {reason}"));
        }
        let sheet = Datasheet::new(Document::from_vec(bytes));
        if sheet.objects().next().is_none() {
            return Err(format!(
                "{file}: the file describes no object; `edskit lint` says what is wrong with it"
            ));
        }
        Ok(Self { file, sheet })
    }

    pub(crate) fn entry(&self, index: Index, sub_index: SubIndex) -> Option<DictionaryEntry<'_>> {
        self.sheet.dictionary_entry(index, sub_index)
    }

    /// What a DCF calls the entry in this device (`Denotation`), else `Identity object/Vendor-ID`, or the name alone for
    /// an object without sub-objects; `None` where the file names nothing there.
    pub(crate) fn name(&self, index: Index, sub_index: SubIndex) -> Option<String> {
        let object = self.sheet.object(index)?;
        let entry = object.dictionary_entry(sub_index)?;
        let name = match entry.denotation() {
            Some(denotation) => printable::line(&denotation),
            None => full_name(object, entry),
        };
        Some(name).filter(|name| !name.is_empty())
    }
}

/// The name of an object.
pub(crate) fn object_name(object: Object<'_>) -> String {
    let name = object.description().parameter_name();
    printable::line(&name.map(|name| name.text().into_owned()).unwrap_or_default())
}

/// The name of an entry behind that of its object.
pub(crate) fn full_name(object: Object<'_>, entry: DictionaryEntry<'_>) -> String {
    let has_sub_objects =
        object.compact_count() > 0 || object.object_code().is_none_or(|code| code.has_sub_objects());
    let name = object_name(object);
    if has_sub_objects { format!("{name}/{}", printable::line(&entry.name())) } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_dcf_calls_an_entry_goes_before_its_name() {
        let text = "[OptionalObjects]\nSupportedObjects=1\n1=0x6000\n\n[6000]\nParameterName=Inputs\nObjectType=0x8\n\
                    SubNumber=3\n\n[6000sub0]\nParameterName=Count\n\n[6000sub1]\nParameterName=Input 1\n\
                    Denotation=Oil\tpressure\n\n[6000sub2]\nParameterName=Input 2\nDenotation=\n";
        let device = KnownDevice { file: "a.dcf".to_owned(), sheet: Datasheet::parse(text.as_bytes()) };
        let name = |sub_index| device.name(Index(0x6000), SubIndex(sub_index));
        assert_eq!(name(1).as_deref(), Some("Oil\u{2409}pressure"), "and it is printable");
        assert_eq!(name(2).as_deref(), Some("Inputs/Input 2"));
        assert_eq!(name(3), None);
    }
}
