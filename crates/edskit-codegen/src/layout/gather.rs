//! Every entry that the dictionary is to have, from all that describes one.

mod extra;
mod implicit;
mod standard;

use super::value::Bytes;
use super::{Array, MOST_ENTRIES, Source, limits};
use crate::{InputFile, Problem, SideFile};
use edskit_lint::Severity;
use edskit_model::{Datasheet, Description, DictionaryEntry, Object, Span};
use edskit_types::{AccessType, DataType, DataTypeKind, Index, ObjectCode, SubIndex};

/// The first index behind the data types, which are described but are no entries.
const FIRST: Index = Index(0x1000);

/// One entry of the dictionary to be.
#[derive(Clone, Debug)]
pub(super) struct Item {
    pub(super) index: Index,
    pub(super) sub_index: SubIndex,
    pub(super) data_type: DataType,
    pub(super) access: AccessType,
    pub(super) is_mappable: bool,
    /// Sub-index 00h of an object with sub-objects.
    pub(super) is_count: bool,
    /// The side-file adds sub-objects to its object.
    pub(super) is_extended: bool,
    pub(super) default: Option<Bytes>,
    /// As bits, where they are tighter than the type.
    pub(super) limits: Option<(u64, u64)>,
    /// Where the default stands, or what describes the entry.
    pub(super) value_span: Span,
    pub(super) source: Source,
}

impl Item {
    pub(super) fn key(&self) -> (Index, SubIndex) {
        (self.index, self.sub_index)
    }
}

/// The entries in ascending order, and what there is to say about them.
#[derive(Default)]
pub(super) struct Gathered {
    /// Not more than one beyond what a dictionary can have.
    pub(super) items: Vec<Item>,
    pub(super) notes: Vec<Problem>,
    /// What the file says of an entry, and the dictionary cannot have.
    pub(super) lost: Vec<Problem>,
    /// What the dictionary has, and the file does not say.
    pub(super) assumptions: Vec<Problem>,
    pub(super) errors: Vec<Problem>,
}

pub(super) fn items(sheet: &Datasheet, side_file: &SideFile) -> Gathered {
    let mut gathered = Gathered::default();
    for object in sheet.objects().filter(|object| object.index() >= FIRST) {
        if let Some(ObjectCode::Null | ObjectCode::DefType | ObjectCode::DefStruct) = object.object_code() {
            continue;
        }
        for entry in object.dictionary_entries() {
            if gathered.items.len() > MOST_ENTRIES {
                return gathered;
            }
            let item = described(sheet, object, entry, side_file, &mut gathered);
            gathered.items.push(item);
        }
    }
    implicit::add(sheet, side_file, &mut gathered.items);
    gathered.items.sort_by_key(Item::key);
    standard::complete(sheet, side_file, &mut gathered);
    extra::add(side_file, &mut gathered);
    gathered
}

/// An entry that a section describes, by itself or with CompactSubObj.
fn described(
    sheet: &Datasheet,
    object: Object<'_>,
    entry: DictionaryEntry<'_>,
    side_file: &SideFile,
    gathered: &mut Gathered,
) -> Item {
    let description = entry.description().unwrap_or(object.description());
    let Gathered { notes, lost, .. } = gathered;
    let problem = |span, message| Problem::in_eds(sheet.document(), Severity::Warning, span, message);
    let mut note = |span, message| notes.push(problem(span, message));
    let mut lost = |span, message| lost.push(problem(span, message));
    let is_compact_count = entry.description().is_none() && entry.sub_index == SubIndex(0);
    let resolved = if is_compact_count { Ok(DataType::Unsigned8) } else { data_type(description) };
    let data_type = resolved.unwrap_or_else(|(span, reason)| {
        let name = description.section().name();
        lost(span, format!("[{name}] becomes a DOMAIN, which only the application knows: {reason}"));
        DataType::Domain
    });
    let access = entry.access().unwrap_or_else(|| {
        let span = description.access_type().map_or(description.name_span(), |field| field.span());
        lost(span, format!("[{}] has no access type that can be read, and becomes ro", description.name()));
        AccessType::Ro
    });
    let field = entry.value_field();
    let value = field.map(|field| field.entry);
    let default = field.and_then(|field| {
        let value = field.entry;
        let bytes = match data_type {
            DataType::Domain => Err("the application has the data of a DOMAIN".to_owned()),
            _ => Bytes::of_field(field, data_type),
        };
        let reason = match bytes {
            Ok(bytes) => return Some(bytes),
            Err(reason) => reason,
        };
        let message = format!("`{}` is left out: {reason}", shortened(&value.text()));
        if data_type == DataType::Domain {
            note(value.value_span(), message)
        } else {
            lost(value.value_span(), message)
        }
        None
    });
    let limits = if access.is_writable() {
        let [low, high] = entry.limits().map(|limit| limit.map(|limit| limit.entry));
        let read = limits::read(data_type, low, high);
        for formula in read.formulas {
            let reason = "a limit that depends on the node-ID is left out: the device has to check it";
            note(formula.value_span(), reason.to_owned());
        }
        read.limits
    } else {
        None
    };
    let has_subs = object.compact_count() > 0 || object.sub_objects().len() > 0;
    let object_name = object.parameter_name().filter(|_| has_subs).map(|name| name.text().into_owned());
    let is_array =
        has_subs && (object.compact_count() > 0 || object.object_code() == Some(ObjectCode::Array));
    let name_span = description.name_span();
    let source = Source {
        file: InputFile::Eds,
        section: description.section().kind().canonical_name().unwrap_or_default(),
        span: name_span,
        position: sheet.document().position(name_span.start),
        name: entry.name().into_owned(),
        object: object_name,
        access,
        unit: side_file.unit(entry.index, entry.sub_index).map(str::to_owned),
        array: is_array.then_some(Array::Object),
        given_name: None,
        given_object_name: None,
    };
    Item {
        index: entry.index,
        sub_index: entry.sub_index,
        data_type,
        access,
        is_mappable: entry.is_mappable(),
        is_count: has_subs && entry.sub_index == SubIndex(0),
        is_extended: false,
        default,
        limits,
        value_span: value.map_or(name_span, |value| value.value_span()),
        source,
    }
}

/// The data type of a description; else why there is none.
fn data_type(described: Description<'_>) -> Result<DataType, (Span, String)> {
    if let Some(data_type) = described.standard_type().filter(has_values) {
        return Ok(data_type);
    }
    Err(match described.data_type() {
        Some(field) => (field.span(), format!("`{}` is no data type of values", shortened(&field.text()))),
        None => (described.name_span(), "it has no data type".to_owned()),
    })
}

fn has_values(data_type: &DataType) -> bool {
    data_type.kind() != DataTypeKind::Record
}

/// A text that is short enough for a message.
fn shortened(text: &str) -> String {
    const MOST: usize = 40;
    if text.chars().count() <= MOST {
        return text.to_owned();
    }
    text.chars().take(MOST).chain(['\u{2026}']).collect()
}
