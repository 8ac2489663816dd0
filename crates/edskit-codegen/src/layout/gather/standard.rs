//! What a file leaves out, and CiA 301 knows.

use super::{Gathered, Item};
use crate::layout::value::Bytes;
use crate::layout::{Source, fixed_size};
use crate::{InputFile, Problem, SideFile};
use edskit_lint::{Severity, standard_default};
use edskit_model::{Datasheet, DeviceInfo, Field, SectionKind, Span};
use edskit_types::{AccessType, DataType, Index, SubIndex};

/// How many entries a message names.
const MOST_NAMES: usize = 6;
/// The first and the last sub-index of the identity that [DeviceInfo] knows.
const IDENTITY: core::ops::RangeInclusive<u8> = 1..=3;
/// Sub-index FFh holds the structure of an object, and counts nowhere.
const STRUCTURE: SubIndex = SubIndex(0xFF);

/// Completes the sorted items of a file that describes a device. A DCF says what is configured, and what it does not say is
/// not in use; what only the running device can know, neither can say.
pub(super) fn complete(sheet: &Datasheet, side_file: &SideFile, gathered: &mut Gathered) {
    run_time(sheet, gathered);
    let is_configured = sheet.section(SectionKind::DeviceCommissioning).is_some();
    if is_configured || gathered.items.is_empty() {
        return;
    }
    let place = Place { sheet, side_file };
    add_mandatory(&place, gathered);
    add_counts(&place, gathered);
    give_values(sheet, gathered);
}

/// The error register and the history of errors begin with nothing: they tell what has happened since power-on. The number
/// of errors can be set to 0 in every form of storage (CiA 301 v4.2, 7.5.2.2 and 7.5.2.4).
fn run_time(sheet: &Datasheet, gathered: &mut Gathered) {
    let is_of_errors =
        |item: &&mut Item| [Index::ERROR_REGISTER, Index::PREDEFINED_ERROR_FIELD].contains(&item.index);
    for item in gathered.items.iter_mut().filter(is_of_errors) {
        if item.index == Index::PREDEFINED_ERROR_FIELD && item.is_count {
            item.access = AccessType::Rw;
            item.source.access = AccessType::Rw;
            item.limits = None;
        }
        let is_said = |bytes: &Bytes| bytes.is_node_relative || bytes.bytes.iter().any(|byte| *byte != 0);
        if item.default.as_ref().is_some_and(is_said) {
            let text = sheet.text(item.value_span);
            let message =
                format!("`{text}` is left out: {} tells what has happened since power-on", item.index);
            gathered.notes.push(Problem::in_eds(
                sheet.document(),
                Severity::Warning,
                item.value_span,
                message,
            ));
        }
        if item.default.is_some() {
            item.default = fixed_size(item.data_type).map(|size| Bytes::fixed(vec![0; size.into()]));
        }
    }
}

/// Where an entry that no section describes comes from.
struct Place<'a> {
    sheet: &'a Datasheet,
    side_file: &'a SideFile,
}

impl Place<'_> {
    /// An entry that can only be read; at sub-index 00h a single value.
    fn item(&self, entry: (Index, u8), data_type: DataType, value: u32, name: &str, span: Span) -> Item {
        let (index, sub_index) = (entry.0, SubIndex(entry.1));
        let size = fixed_size(data_type).unwrap_or_default().into();
        Item {
            index,
            sub_index,
            data_type,
            access: AccessType::Ro,
            is_mappable: false,
            is_count: false,
            is_extended: false,
            default: Some(Bytes::fixed(&value.to_le_bytes()[..size])),
            limits: None,
            value_span: span,
            source: Source {
                file: InputFile::Eds,
                section: format!("{:X}", index.0),
                span,
                position: self.sheet.document().position(span.start),
                name: name.to_owned(),
                object: None,
                access: AccessType::Ro,
                unit: self.side_file.unit(index, sub_index).map(str::to_owned),
                array: None,
                given_name: None,
                given_object_name: None,
            },
        }
    }

    fn problem(&self, span: Span, message: String) -> Problem {
        Problem::in_eds(self.sheet.document(), Severity::Warning, span, message)
    }
}

/// 1000h, 1001h and 1018h, where the file lacks them; the identity as [DeviceInfo] has it.
fn add_mandatory(place: &Place<'_>, gathered: &mut Gathered) {
    let sheet = place.sheet;
    let list = sheet.section(SectionKind::MandatoryObjects);
    let span = list.map(|list| list.name_span()).unwrap_or_default();
    let info = sheet.device_info();
    let identity = |sub_index| info.and_then(|info| identity(info, sub_index)).unwrap_or(0);
    let byte = DataType::Unsigned8;
    let number = DataType::Unsigned32;
    let objects = [
        (Index::DEVICE_TYPE, "0", vec![(0, number, 0, "Device type")]),
        (Index::ERROR_REGISTER, "0", vec![(0, byte, 0, "Error register")]),
        (
            Index::IDENTITY,
            if info.is_some() { "the numbers of [DeviceInfo]" } else { "0" },
            vec![
                (0, byte, u32::from(*IDENTITY.end()), "Highest sub-index supported"),
                (1, number, identity(1), "Vendor-ID"),
                (2, number, identity(2), "Product code"),
                (3, number, identity(3), "Revision number"),
            ],
        ),
    ];
    for (index, value, entries) in objects {
        if gathered.items.iter().any(|item| item.index == index) {
            continue;
        }
        for (sub_index, data_type, value, name) in entries {
            let mut item = place.item((index, sub_index), data_type, value, name, span);
            let is_part = index == Index::IDENTITY;
            item.is_count = is_part && sub_index == 0;
            item.source.object = is_part.then(|| "Identity object".to_owned());
            gathered.items.push(item);
        }
        let message =
            format!("the mandatory object {index} is missing in the file, and is added with {value}");
        gathered.assumptions.push(place.problem(span, message));
    }
    gathered.items.sort_by_key(Item::key);
}

/// What [DeviceInfo] says of the identity.
fn identity(info: DeviceInfo<'_>, sub_index: u8) -> Option<u32> {
    match sub_index {
        1 => info.vendor_number(),
        2 => info.product_number(),
        3 => info.revision_number(),
        _ => None,
    }
    .and_then(Field::known)
}

/// Sub-index 00h of objects that have sub-objects and not this one.
fn add_counts(place: &Place<'_>, gathered: &mut Gathered) {
    let mut missing = Vec::new();
    for object in gathered.items.chunk_by(|a, b| a.index == b.index) {
        let first = &object[0];
        if first.sub_index == SubIndex(0) || first.sub_index == STRUCTURE {
            continue;
        }
        let header = place.sheet.section(SectionKind::Object(first.index));
        let span = header.map_or(first.source.span, |section| section.name_span());
        let mut item = place.item(
            (first.index, 0),
            DataType::Unsigned8,
            highest(object).into(),
            "Highest sub-index supported",
            span,
        );
        item.is_count = true;
        item.source.object.clone_from(&first.source.object);
        if first.index == Index::PREDEFINED_ERROR_FIELD {
            item.access = AccessType::Rw;
            item.source.access = AccessType::Rw;
        }
        missing.push(item);
    }
    for item in missing {
        let value = item.default.as_ref().map_or(0, |default| default.bytes[0]);
        let message =
            format!("sub-index 00h of {} is missing in the file, and is added with {value}", item.index);
        gathered.assumptions.push(place.problem(item.value_span, message));
        gathered.items.push(item);
    }
    gathered.items.sort_by_key(Item::key);
}

/// What sub-index 00h of an object is by what is described: of a mapping how many entries are mapped, of the history of
/// errors that there are none.
fn highest(object: &[Item]) -> u8 {
    let index = object[0].index;
    if index == Index::PREDEFINED_ERROR_FIELD {
        return 0;
    }
    let elements = object.iter().filter(|item| item.sub_index != SubIndex(0) && item.sub_index != STRUCTURE);
    if !index.is_rpdo_mapping() && !index.is_tpdo_mapping() {
        return elements.map(|item| item.sub_index.0).max().unwrap_or(0);
    }
    let is_mapped = |item: &&Item| {
        item.default.as_ref().is_some_and(|default| default.bytes.iter().any(|byte| *byte != 0))
    };
    let mapped =
        (1..).zip(elements).take_while(|(number, item)| item.sub_index.0 == *number && is_mapped(item));
    mapped.map(|(number, _)| number).last().unwrap_or(0)
}

/// Gives entries without a value the one of CiA 301, and says which other than 0.
fn give_values(sheet: &Datasheet, gathered: &mut Gathered) {
    let counts: Vec<(Index, u8)> = gathered
        .items
        .chunk_by(|a, b| a.index == b.index)
        .filter(|object| object[0].is_count && object[0].default.is_none())
        .map(|object| (object[0].index, highest(object)))
        .collect();
    let mut given: Vec<(Span, String)> = Vec::new();
    for item in gathered.items.iter_mut().filter(|item| item.default.is_none()) {
        let Some(size) = fixed_size(item.data_type).map(usize::from).filter(|size| *size <= 4) else {
            continue;
        };
        let known = |number: u32| Some((number, false, format!("{number:X}h")));
        let value = if item.is_count {
            let count = counts.iter().find(|(index, _)| *index == item.index);
            count.and_then(|(_, highest)| known((*highest).into()))
        } else if item.index == Index::IDENTITY && IDENTITY.contains(&item.sub_index.0) {
            sheet.device_info().and_then(|info| identity(info, item.sub_index.0)).and_then(known)
        } else {
            standard_default(item.index, item.sub_index)
                .map(|default| (default.number, default.adds_node_id, default.to_string()))
        };
        let Some((number, adds_node_id, text)) = value.filter(|(number, ..)| *number != 0) else { continue };
        let bytes = number.to_le_bytes()[..size].to_vec();
        item.default = Some(Bytes { bytes, is_node_relative: adds_node_id });
        let sub_index = match (item.is_count, item.source.object.is_some()) {
            (false, false) => String::new(),
            _ => format!(" sub-index {}", item.sub_index),
        };
        given.push((item.value_span, format!("{}{sub_index} = {text}", item.index)));
    }
    let Some((span, _)) = given.first() else { return };
    let names: Vec<&str> = given.iter().take(MOST_NAMES).map(|(_, name)| name.as_str()).collect();
    let more = match given.len() - names.len() {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    let what =
        if given.len() == 1 { "1 entry has".to_owned() } else { format!("{} entries have", given.len()) };
    let message = format!("{what} no value in the file, and what CiA 301 gives: {}{more}", names.join(", "));
    gathered.assumptions.push(Problem::in_eds(sheet.document(), Severity::Warning, *span, message));
}
