//! The files that defects are put into, read as lines and sections: no more than it takes to find a place.

use crate::{files, root};
use std::rc::Rc;

/// What kind of file a base is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// An electronic data sheet.
    Eds,
    /// A device configuration file.
    Dcf,
    /// A nodelist.cpj.
    Cpj,
}

/// A clean file.
pub struct Base {
    /// The file's own name.
    pub name: String,
    /// What kind of file it is.
    pub kind: Kind,
    pub(crate) lines: Rc<[Line]>,
    sections: Vec<Section>,
    /// The files beside it, by their names, where it lies in the folder of a network.
    pub neighbours: Rc<Vec<(String, String)>>,
}

/// A line and how it ends.
#[derive(Clone)]
pub(crate) struct Line {
    pub(crate) text: String,
    pub(crate) ending: String,
}

/// A section of a base.
#[derive(Clone, Debug)]
pub struct Section {
    /// The name between the brackets.
    pub name: String,
    index: Option<u16>,
    sub_index: Option<u8>,
    /// The line of the header.
    pub header: usize,
    /// The `key=value` lines.
    pub entries: Vec<Entry>,
    /// The line behind the section's last one.
    pub end: usize,
}

/// A `key=value` line of a base.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The line.
    pub line: usize,
    /// What stands before the `=`.
    pub key: String,
    /// What stands behind the `=`.
    pub value: String,
}

impl Base {
    pub(crate) fn new(name: &str, text: &str) -> Self {
        let kind = match name.rsplit('.').next() {
            Some("dcf") => Kind::Dcf,
            Some("cpj") => Kind::Cpj,
            _ => Kind::Eds,
        };
        let lines: Rc<[Line]> = text.split_inclusive('\n').map(line_and_ending).collect();
        let sections = sections(&lines);
        Self { name: name.to_owned(), kind, lines, sections, neighbours: Rc::default() }
    }

    /// The whole text.
    pub fn text(&self) -> String {
        self.lines.iter().flat_map(|line| [line.text.as_str(), &line.ending]).collect()
    }

    /// Every section.
    pub fn sections(&self) -> &[Section] {
        &self.sections
    }

    /// The sections that `wanted` picks.
    pub fn sections_where(&self, wanted: impl Fn(&Section) -> bool) -> Vec<&Section> {
        self.sections.iter().filter(|section| wanted(section)).collect()
    }

    /// The section of this name.
    pub fn section(&self, name: &str) -> Option<&Section> {
        self.sections.iter().find(|section| section.name == name)
    }

    /// The description of an object.
    pub fn object(&self, index: u16) -> Option<&Section> {
        self.sections.iter().find(|section| section.is_object() && section.index() == Some(index))
    }

    /// The description of a sub-object.
    pub fn sub_object(&self, index: u16, sub_index: u8) -> Option<&Section> {
        let place = (Some(index), Some(sub_index));
        self.sections.iter().find(|section| (section.index(), section.sub_index()) == place)
    }

    /// The sub-objects of an object.
    pub fn sub_objects(&self, index: u16) -> Vec<&Section> {
        self.sections_where(|section| section.is_sub_object() && section.index() == Some(index))
    }

    /// An entry by the names of its section and its key.
    pub fn entry(&self, section: &str, key: &str) -> Option<&Entry> {
        self.section(section)?.entry(key)
    }

    /// The lists of objects.
    pub fn lists(&self) -> Vec<&Section> {
        self.sections_where(Section::is_list)
    }

    /// The list that names an object, and the item.
    pub fn listed(&self, index: u16) -> Option<(&Section, &Entry)> {
        let is_it = |entry: &&Entry| entry.is_item() && number(&entry.value) == Some(i64::from(index));
        self.lists().into_iter().find_map(|list| Some((list, list.entries.iter().find(is_it)?)))
    }
}

impl Section {
    fn new(name: &str, header: usize) -> Self {
        let hexadecimal = |text: &str| text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let (index, sub) = name.split_at_checked(4).unwrap_or_default();
        let sub = sub.strip_prefix("sub");
        let index = Some(index).filter(|index| hexadecimal(index) && (name.len() == 4 || sub.is_some()));
        let index = index.and_then(|index| u16::from_str_radix(index, 16).ok());
        let sub_index = index.and(sub).and_then(|sub| u8::from_str_radix(sub, 16).ok());
        Self { name: name.to_owned(), index, sub_index, header, entries: Vec::new(), end: header + 1 }
    }

    /// The index of the object or sub-object that the section describes.
    pub fn index(&self) -> Option<u16> {
        self.index
    }

    /// The sub-index of the sub-object that the section describes.
    pub fn sub_index(&self) -> Option<u8> {
        self.sub_index
    }

    /// Whether it describes an object of the device.
    pub fn is_object(&self) -> bool {
        self.index().is_some() && self.sub_index().is_none()
    }

    /// Whether it describes a sub-object of the device.
    pub fn is_sub_object(&self) -> bool {
        self.sub_index().is_some()
    }

    /// Whether it describes something that holds a single value.
    pub fn is_variable(&self) -> bool {
        self.is_sub_object() || (self.is_object() && self.is_code(7))
    }

    /// Whether it describes an object with sub-objects that have sections of their own.
    pub fn has_sub_objects(&self) -> bool {
        self.is_object() && self.entry("SubNumber").is_some()
    }

    /// Whether it is one of the three lists of objects.
    pub fn is_list(&self) -> bool {
        self.entry("SupportedObjects").is_some()
    }

    /// Whether the index lies in this range.
    pub fn is_within(&self, first: u16, last: u16) -> bool {
        self.index().is_some_and(|index| (first..=last).contains(&index))
    }

    /// Whether the section is in the area of manufacturers.
    pub fn is_of_manufacturer(&self) -> bool {
        self.is_within(0x2000, 0x5FFF)
    }

    /// Whether this is the data type.
    pub fn is_type(&self, data_type: u16) -> bool {
        self.number("DataType") == Some(i64::from(data_type))
    }

    /// Whether this is the object code.
    pub fn is_code(&self, code: u8) -> bool {
        self.number("ObjectType") == Some(i64::from(code))
    }

    /// The entry with this key.
    pub fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    /// The value of this key; empty where there is none.
    pub fn value(&self, key: &str) -> &str {
        self.entry(key).map_or("", |entry| &entry.value)
    }

    /// The value of this key, as a number.
    pub fn number(&self, key: &str) -> Option<i64> {
        number(self.value(key))
    }

    /// The line behind the last entry.
    pub fn behind_entries(&self) -> usize {
        self.entries.last().map_or(self.header, |entry| entry.line) + 1
    }

    /// The items of a list: the entries whose keys are numbers.
    pub fn items(&self) -> Vec<&Entry> {
        self.entries.iter().filter(|entry| entry.is_item()).collect()
    }
}

impl Entry {
    /// Whether the key is a number.
    pub fn is_item(&self) -> bool {
        self.key.bytes().all(|byte| byte.is_ascii_digit())
    }

    /// The value as a number.
    pub fn number(&self) -> Option<i64> {
        number(&self.value)
    }
}

/// A decimal or hexadecimal number; a formula is none.
pub(super) fn number(text: &str) -> Option<i64> {
    match text.strip_prefix("0x") {
        Some(digits) => i64::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    }
}

/// The shipped files, then those that were written for this: every file that defects are put into.
pub fn bases() -> Vec<Base> {
    let written = root().join("tests/fixtures/seeded");
    let mut bases = Vec::new();
    for folder in [root().join("eds"), written.clone()] {
        for file in files(&folder, &["eds"]) {
            bases.push(Base::new(&file.name, &text(file.bytes)));
        }
    }
    let network = files(&written.join("network"), &["cpj", "dcf", "tab"]).into_iter();
    let network: Rc<Vec<_>> = Rc::new(network.map(|file| (file.name, text(file.bytes))).collect());
    for (name, text) in network.iter().filter(|(name, _)| !name.ends_with(".tab")) {
        bases.push(Base { neighbours: network.clone(), ..Base::new(name, text) });
    }
    bases
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).expect("bases are ASCII")
}

fn line_and_ending(line: &str) -> Line {
    let text = line.trim_end_matches(['\r', '\n']);
    Line { text: text.to_owned(), ending: line[text.len()..].to_owned() }
}

fn sections(lines: &[Line]) -> Vec<Section> {
    let mut sections: Vec<Section> = Vec::new();
    for (line, Line { text, .. }) in lines.iter().enumerate() {
        if let Some(name) = text.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            sections.push(Section::new(name, line));
        } else if let Some(section) = sections.last_mut() {
            section.end = line + 1;
            if let Some((key, value)) = text.split_once('=').filter(|_| !text.starts_with(';')) {
                section.entries.push(Entry { line, key: key.to_owned(), value: value.to_owned() });
            }
        }
    }
    // Blanks and comments at the end of a section belong to the next one.
    for section in &mut sections {
        let is_entry = |line: usize| !lines[line].text.is_empty() && !lines[line].text.starts_with(';');
        while !is_entry(section.end - 1) {
            section.end -= 1;
        }
    }
    sections
}
