//! Sub-objects whose names count in decimal: `[6401sub10]` for the tenth.
//!
//! Sub-index names are hexadecimal (CiA 306 v1.3, 4.6.3.2), and nearly every file keeps to it. Where an object has 1 to 9,
//! nothing from Ah to Fh, and sub-index 00h is what the names are in decimal but not in hexadecimal, only one reading fits.

use super::{Datasheet, Object, Section};
use crate::key::{Key, KeyGroup};
use crate::section::SectionKind;
use edskit_types::{Index, SubIndex};

/// The structure of an object, which counts nowhere.
const STRUCTURE: u8 = 0xFF;

impl Section<'_> {
    /// Whether the name has a decimal sub-index, by which the section is read.
    pub fn has_decimal_sub_index(self) -> bool {
        self.sheet().decimal_names.binary_search(&self.id()).is_ok()
    }
}

/// Gives sub-objects with decimal names the sub-index that was meant; whether there are any.
pub(super) fn read(sheet: &mut Datasheet) -> bool {
    let mut found: Vec<(u32, SectionKind)> = Vec::new();
    let mut beyond = None;
    for object in sheet.objects() {
        let has_gap =
            object.sub_objects().any(|sub| sub.sub_index().0 >= 0x10 && sub.sub_index().0 != STRUCTURE)
                && object.sub_objects().all(|sub| !(0xA..=0xF).contains(&sub.sub_index().0));
        if has_gap {
            // Names of three digits are no sub-objects as long as they are read in hexadecimal.
            let beyond = beyond.get_or_insert_with(|| beyond_ff(sheet));
            found.extend(decimal_names(object, beyond));
        }
    }
    let is_any = !found.is_empty();
    for (id, kind) in found {
        let section = &mut sheet.sections[id as usize];
        let was_unknown = section.kind == SectionKind::Unknown;
        section.kind = kind;
        let entries = section.first_entry as usize..section.end_entry as usize;
        if was_unknown {
            let source = sheet.document.to_bytes();
            for id in entries {
                let entry = &mut sheet.entries[id];
                let line = &sheet.document.lines()[entry.line as usize];
                let (key, is_usual) = Key::spelled(KeyGroup::Description, line.key(source).slice(source));
                entry.key = key;
                sheet.keys[key.name as usize] = true;
                if !is_usual {
                    sheet.unusual_keys.push(id as u32);
                }
            }
        }
        sheet.decimal_names.push(id);
    }
    sheet.decimal_names.sort_unstable();
    sheet.unusual_keys.sort_unstable();
    is_any
}

/// The sections of an object's sub-objects with the sub-index that they were meant to have; none where the names are
/// hexadecimal.
fn decimal_names(object: Object<'_>, beyond: &[(Index, u8, u32)]) -> Vec<(u32, SectionKind)> {
    let index = object.index();
    let own = object.sub_objects().filter(|sub| (0x10..STRUCTURE).contains(&sub.sub_index().0));
    let mut named = Vec::new();
    for sub in own {
        let [tens, ones] = [sub.sub_index().0 >> 4, sub.sub_index().0 & 0xF];
        if tens > 9 || ones > 9 {
            return Vec::new();
        }
        named.push((tens * 10 + ones, sub.section().id()));
    }
    named.extend(beyond.iter().filter(|(of, ..)| *of == index).map(|(_, sub_index, id)| (*sub_index, *id)));
    let highest = named.iter().map(|(sub_index, _)| *sub_index).max().unwrap_or(0);
    let has = |sub_index: u8| object.sub_object(SubIndex(sub_index)).is_some();
    if !(1..=9).all(has) || !counts_to(object, highest) {
        return Vec::new();
    }
    let kind = |(sub_index, id)| (id, SectionKind::SubObject(index, SubIndex(sub_index)));
    named.into_iter().map(kind).collect()
}

/// Whether sub-index 00h says that the highest sub-index is `highest`. That of a mapping says how many entries are in use:
/// some that only the decimal names have.
fn counts_to(object: Object<'_>, highest: u8) -> bool {
    let Some(sub0) = object.sub_object(SubIndex(0)) else { return false };
    let index = object.index();
    let is_mapping = index.is_rpdo_mapping() || index.is_tpdo_mapping();
    let fits = |said: u8| said == highest || (is_mapping && (0xA..=highest.min(0xF)).contains(&said));
    // A count that changes while the device runs has its largest value as a limit.
    let said = [sub0.value(), sub0.high_limit()].into_iter().flatten();
    said.filter_map(|field| field.entry.unsigned::<u8>().known()).any(fits)
}

/// The sections named like a sub-object with a decimal number from 100 to 254.
fn beyond_ff(sheet: &Datasheet) -> Vec<(Index, u8, u32)> {
    let source = sheet.document().to_bytes();
    let unknown = sheet.sections().filter(|section| section.kind() == SectionKind::Unknown);
    let named = unknown.filter_map(|section| {
        let name = core::str::from_utf8(section.name_span().slice(source)).ok()?.to_ascii_lowercase();
        let (object, digits) = name.split_once("sub")?;
        let SectionKind::Object(index) = SectionKind::of(object.as_bytes()) else { return None };
        let is_decimal = digits.len() == 3 && digits.bytes().all(|byte| byte.is_ascii_digit());
        let sub_index =
            digits.parse().ok().filter(|sub_index| is_decimal && (100..STRUCTURE).contains(sub_index))?;
        Some((index, sub_index, section.id()))
    });
    named.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An object with sub-index 00h of this value, and sub-objects of these names.
    fn sheet(index: &str, count: &str, names: impl IntoIterator<Item = String>) -> Datasheet {
        let mut text = format!("[{index}]\nObjectType=8\n[{index}sub0]\nDataType=5\nDefaultValue={count}\n");
        for name in names {
            text.push_str(&format!("[{index}sub{name}]\nDataType=6\nDefaultValue=0x{name}\n"));
        }
        Datasheet::parse(text.as_bytes())
    }

    fn sub_indices(sheet: &Datasheet) -> Vec<u8> {
        sheet.objects().next().unwrap().sub_objects().map(|sub| sub.sub_index().0).collect()
    }

    fn decimal(last: u8) -> impl Iterator<Item = String> {
        (1..=last).map(|number| number.to_string())
    }

    #[test]
    fn names_count_in_decimal_where_only_that_fits() {
        for last in [10, 11, 20, 99, 100, 120, 254] {
            let sheet = sheet("6401", &last.to_string(), decimal(last));
            assert_eq!(sub_indices(&sheet), (0..=last).collect::<Vec<_>>());
            assert!(
                sheet
                    .objects()
                    .next()
                    .unwrap()
                    .sub_objects()
                    .any(|sub| sub.section().has_decimal_sub_index())
            );
            let value = sheet.dictionary_entry(Index(0x6401), SubIndex(last)).unwrap().value().unwrap();
            let written = i128::from_str_radix(&last.to_string(), 16).unwrap();
            assert_eq!(value.integer(edskit_types::DataType::Unsigned16, None), Ok(written));
        }
        let mapping = sheet("1600", "10", decimal(12));
        assert_eq!(sub_indices(&mapping), (0..=12).collect::<Vec<_>>());
    }

    #[test]
    fn everything_else_is_hexadecimal() {
        let hexadecimal = (1..=0x14).map(|number| format!("{number:X}"));
        let gap = || (1..=9).chain(0x10..=0x14).map(|number| format!("{number:X}"));
        for (index, count, names) in [
            ("6401", "20", hexadecimal.collect::<Vec<_>>()),
            ("6401", "0x14", gap().collect()),
            ("6401", "9", gap().collect()),
            ("6401", "", gap().collect()),
            ("1600", "9", gap().collect()),
            ("6401", "15", (2..=9).chain(0x10..=0x15).map(|number| format!("{number:X}")).collect()),
            ("6401", "15", (1..=9).chain(0x10..=0x1B).map(|number| format!("{number:X}")).collect()),
        ] {
            let sheet = sheet(index, count, names.clone());
            let expected = names.iter().map(|name| u8::from_str_radix(name, 16).unwrap());
            assert_eq!(sub_indices(&sheet)[1..], expected.collect::<Vec<_>>(), "{index} {count}");
        }
    }
}
