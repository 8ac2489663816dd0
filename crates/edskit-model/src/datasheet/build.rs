//! From a document to the index over it.

use super::{Datasheet, EntryRecord, ObjectRecord, SectionRecord, SubObjectRecord, decimal_names};
use crate::document::{Document, LineKind};
use crate::key::{KEY_NAMES, Key, KeyGroup};
use crate::section::SectionKind;

pub(super) fn datasheet(document: Document) -> Datasheet {
    let (sections, entries, keys) = read_lines(&document);
    let mut sheet = Datasheet {
        document,
        sections,
        entries,
        objects: Vec::new(),
        sub_objects: Vec::new(),
        others: Vec::new(),
        decimal_names: Vec::new(),
        keys,
    };
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

fn read_lines(document: &Document) -> (Vec<SectionRecord>, Vec<EntryRecord>, [bool; KEY_NAMES]) {
    let source = document.to_bytes();
    let lines = document.lines();
    let mut sections: Vec<SectionRecord> = Vec::with_capacity(lines.len() / 9);
    let mut entries = Vec::with_capacity(lines.len());
    let mut keys = [false; KEY_NAMES];
    let mut group = KeyGroup::Unknown;
    for (number, line) in lines.iter().enumerate() {
        match line.kind() {
            LineKind::Entry => {
                let key = Key::of(group, line.key(source).slice(source));
                keys[key.name as usize] = true;
                entries.push(EntryRecord { line: number as u32, key });
            }
            LineKind::Section => {
                let first_entry = entries.len() as u32;
                if let Some(previous) = sections.last_mut() {
                    previous.end_entry = first_entry;
                }
                let name = line.section_name(source).slice(source).trim_ascii();
                let kind = SectionKind::of(name);
                group = KeyGroup::of(kind);
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
    (sections, entries, keys)
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
