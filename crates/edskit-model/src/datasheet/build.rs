//! From a document to the index over it.

use super::{Datasheet, EntryRecord, ObjectRecord, SectionRecord, SubObjectRecord, decimal_names};
use crate::document::{Document, LineKind};
use crate::key::{KEY_NAMES, Key, KeyGroup, KeyName};
use crate::section::SectionKind;

pub(super) fn datasheet(document: Document) -> Datasheet {
    let mut sheet = read_lines(document);
    index(&mut sheet);
    if decimal_names::read(&mut sheet) {
        index(&mut sheet);
    }
    sheet
}

/// Finds the objects, the sub-objects, and the first section of every other kind.
fn index(sheet: &mut Datasheet) {
    let mut objects = Vec::new();
    let mut sub_objects = Vec::new();
    let mut others = Vec::new();
    for (id, section) in sheet.sections.iter().enumerate() {
        let section_id = id as u32;
        match section.kind {
            SectionKind::Object(index) => {
                objects.push(ObjectRecord { index, section: section_id, first_sub: 0, end_sub: 0 });
            }
            SectionKind::SubObject(index, sub_index) => {
                sub_objects.push(SubObjectRecord { index, sub_index, section: section_id });
            }
            SectionKind::Unknown => {}
            kind => others.push((kind, section_id)),
        }
    }
    // Stable sorts keep the file's order among equals, so the first of each kind survives.
    objects.sort_by_key(|object| object.index);
    objects.dedup_by_key(|object| object.index);
    sub_objects.sort_by_key(|sub| (sub.index, sub.sub_index));
    sub_objects.dedup_by_key(|sub| (sub.index, sub.sub_index));
    others.sort_by_key(|&(kind, _)| kind);
    others.dedup_by_key(|&mut (kind, _)| kind);
    join(&mut objects, &sub_objects);
    (sheet.objects, sheet.sub_objects, sheet.others) = (objects, sub_objects, others);
}

/// Every section and entry, before the objects are known.
fn read_lines(document: Document) -> Datasheet {
    let source = document.to_bytes();
    let lines = document.lines();
    let mut sections: Vec<SectionRecord> = Vec::with_capacity(lines.len() / 9);
    let mut entries = Vec::with_capacity(lines.len());
    let mut unusual_keys = Vec::new();
    let mut keys = [false; KEY_NAMES];
    let mut reader = KeyReader::new(KeyGroup::Unknown);
    for (number, line) in lines.iter().enumerate() {
        match line.kind() {
            LineKind::Entry => {
                let (key, is_usual) = reader.read(line.key(source).slice(source));
                keys[key.name as usize] = true;
                if !is_usual {
                    unusual_keys.push(entries.len() as u32);
                }
                entries.push(EntryRecord { line: number as u32, key });
            }
            LineKind::Section => {
                let first_entry = entries.len() as u32;
                if let Some(previous) = sections.last_mut() {
                    previous.end_entry = first_entry;
                }
                let name = line.section_name(source).slice(source).trim_ascii();
                let kind = SectionKind::of(name);
                reader.enter(KeyGroup::of(kind));
                sections.push(SectionRecord {
                    line: number as u32,
                    first_entry,
                    end_entry: first_entry,
                    kind,
                });
            }
            LineKind::Blank | LineKind::Comment | LineKind::Other => {}
        }
    }
    if let Some(last) = sections.last_mut() {
        last.end_entry = entries.len() as u32;
    }
    Datasheet {
        document,
        sections,
        entries,
        objects: Vec::new(),
        sub_objects: Vec::new(),
        others: Vec::new(),
        decimal_names: Vec::new(),
        unusual_keys,
        keys,
    }
}

/// Reads the keys of a file one after the other.
///
/// The sections of a file have their keys in the same order, so the key that stood behind the last one before is tried first.
struct KeyReader {
    group: KeyGroup,
    previous: KeyName,
    /// For each key of the group the one that stood behind it; those with numbers are not among them.
    following: [KeyName; KEY_NAMES],
}

impl KeyReader {
    fn new(group: KeyGroup) -> Self {
        Self { group, previous: KeyName::Unknown, following: [KeyName::Unknown; KEY_NAMES] }
    }

    /// Goes on with a section that has the keys of `group`.
    #[inline]
    fn enter(&mut self, group: KeyGroup) {
        if group == self.group {
            self.previous = KeyName::Unknown;
        } else {
            *self = Self::new(group);
        }
    }

    /// The next key, and whether it is written in the case of CiA 306.
    #[inline]
    fn read(&mut self, text: &[u8]) -> (Key, bool) {
        let expected = &mut self.following[self.previous as usize];
        if text == expected.spelling().as_bytes() {
            self.previous = *expected;
            return (Key::fixed(*expected), true);
        }
        let (key, is_usual) = Key::spelled(self.group, text);
        *expected = if key.name.is_fixed() { key.name } else { KeyName::Unknown };
        self.previous = key.name;
        (key, is_usual)
    }
}

/// Gives each object the range of its sub-objects; both are sorted by index.
fn join(objects: &mut [ObjectRecord], sub_objects: &[SubObjectRecord]) {
    let mut position = 0;
    let count = |from: usize, belongs: &dyn Fn(&SubObjectRecord) -> bool| {
        from + sub_objects[from..].iter().take_while(|sub| belongs(sub)).count()
    };
    for object in objects {
        let index = object.index;
        let first = count(position, &|sub| sub.index < index);
        let end = count(first, &|sub| sub.index == index);
        (object.first_sub, object.end_sub) = (first as u32, end as u32);
        position = end;
    }
}
