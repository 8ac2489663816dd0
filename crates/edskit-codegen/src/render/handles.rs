//! The handles and the keys: which entries have one of their own, which are an array, and what they are called.

use crate::names::{Name, Named, names};
use crate::text::for_docs;
use crate::{Array, Layout, Source};
use core::ops::Range;
use edskit_runtime::{Entry, Flags};
use edskit_types::{DataType, DataTypeKind, SubIndex};
use std::collections::BTreeSet;

/// The most elements of an array whose names its documentation lists.
const MOST_LISTED: usize = 16;
/// Sub-index FFh holds the structure of an object, and is no element.
const STRUCTURE: SubIndex = SubIndex(0xFF);

/// Index and sub-index of an entry as a constant.
pub(super) struct KeyRow {
    pub(super) name: String,
    pub(super) index: String,
    pub(super) sub_index: String,
}

/// A handle, or an array of them.
pub(super) struct HandleRow {
    /// Each line with the blank that it begins with.
    pub(super) docs: Vec<String>,
    pub(super) name: String,
    pub(super) handle_type: String,
    pub(super) value: String,
}

/// What stands in the modules `keys` and `objects`.
pub(super) struct Handles {
    pub(super) keys: Vec<KeyRow>,
    pub(super) rows: Vec<HandleRow>,
    /// What the rows use of the runtime.
    pub(super) imports: BTreeSet<&'static str>,
}

/// What is called something, and its name.
pub(crate) struct Called {
    /// The entries: one, or those of an array.
    pub(crate) entries: Range<usize>,
    pub(crate) is_array: bool,
    is_element: bool,
    pub(crate) name: Name,
}

/// What all entries and arrays of a dictionary are called; where a reason names another one, that is its place here.
pub(crate) fn called(layout: &Layout) -> Vec<Called> {
    let mut wholes: Vec<(Range<usize>, bool, bool)> = Vec::with_capacity(layout.entries.len());
    let mut start = 0;
    for object in layout.entries.chunk_by(|a, b| a.index == b.index) {
        let object = start..start + object.len();
        start = object.end;
        let arrays = arrays(layout, object.clone());
        // An array comes first, so that no element and no number of elements has its name.
        wholes.extend(arrays.iter().map(|array| (array.clone(), true, false)));
        let is_element = |entry: usize| arrays.iter().any(|array| array.contains(&entry));
        wholes.extend(object.map(|entry| (entry..entry + 1, false, is_element(entry))));
    }
    let named: Vec<Named<'_>> = wholes
        .iter()
        .map(|(entries, is_array, is_element)| named(layout, entries.start, *is_array, *is_element))
        .collect();
    let all = wholes.into_iter().zip(names(&named));
    all.map(|((entries, is_array, is_element), name)| Called { entries, is_array, is_element, name })
        .collect()
}

fn named(layout: &Layout, place: usize, is_array: bool, is_element: bool) -> Named<'_> {
    let (entry, source) = (&layout.entries[place], &layout.sources[place]);
    // The array of a whole object has its name, the one of a statement of the side-file that of the statement.
    let is_whole = is_array && source.array == Some(Array::Object);
    Named {
        index: entry.index,
        sub_index: (!is_whole).then_some(entry.sub_index),
        object: source.object.as_deref(),
        name: if is_whole { "" } else { &source.name },
        given_object: source.given_object_name.as_deref(),
        given: if is_whole { source.given_object_name.as_deref() } else { source.given_name.as_deref() },
        is_element,
    }
}

/// The arrays among the entries of an object: all that are described together, if they have one type, no gap, no name of
/// their own, and all or none can change.
fn arrays(layout: &Layout, object: Range<usize>) -> Vec<Range<usize>> {
    let array_of = |place: &usize| {
        let sub_index = layout.entries[*place].sub_index;
        layout.sources[*place].array.filter(|_| sub_index != SubIndex(0) && sub_index != STRUCTURE)
    };
    let described: BTreeSet<_> = object.clone().filter_map(|place| array_of(&place)).collect();
    let whole = |array| {
        let elements: Vec<usize> = object.clone().filter(|place| array_of(place) == Some(array)).collect();
        let (first, last) = (*elements.first()?, *elements.last()?);
        let first_entry = &layout.entries[first];
        let fits = |place: &usize| {
            let entry = &layout.entries[*place];
            usize::from(entry.sub_index.0) - usize::from(first_entry.sub_index.0) == place - first
                && entry.data_type == first_entry.data_type
                && can_change(entry) == can_change(first_entry)
                && layout.sources[*place].given_name.is_none()
        };
        (elements.len() == last + 1 - first && elements.iter().all(fits)).then_some(first..last + 1)
    };
    described.into_iter().filter_map(whole).collect()
}

pub(super) fn handles(layout: &Layout, mut called: Vec<Called>) -> Handles {
    called.sort_by_key(|called| (called.entries.start, called.is_array));
    let key = |called: &Called| {
        let entry = &layout.entries[called.entries.start];
        KeyRow {
            name: called.name.name.clone(),
            index: format!("0x{:04X}", entry.index.0),
            sub_index: format!("0x{:02X}", entry.sub_index.0),
        }
    };
    let keys: Vec<KeyRow> = called.iter().filter(|called| !called.is_array).map(key).collect();
    let mut imports = BTreeSet::new();
    let mut rows = Vec::with_capacity(called.len());
    for called in called.iter().filter(|called| !called.is_element) {
        let first = called.entries.start;
        let entry = &layout.entries[first];
        let (kind, value) = (kind(entry), value_type(entry.data_type));
        imports.extend([kind, "Key", "Position"]);
        imports
            .extend(Some(value).filter(|value| value.starts_with(|first: char| first.is_ascii_uppercase())));
        let KeyRow { index, sub_index, .. } = &keys[first];
        let place = format!("(Position({first}), Key::new({index}, {sub_index}))");
        rows.push(HandleRow {
            docs: if called.is_array {
                array_docs(layout, called.entries.clone())
            } else {
                vec![docs(layout, first)]
            },
            name: called.name.name.clone(),
            handle_type: match called.is_array {
                true => format!("[{kind}<{value}>; {}]", called.entries.len()),
                false => format!("{kind}<{value}>"),
            },
            value: format!("{kind}::{}{place}", if called.is_array { "run" } else { "new" }),
        });
    }
    Handles { keys, rows, imports }
}

fn can_change(entry: &Entry) -> bool {
    entry.flags.has(Flags::VARIABLE)
}

fn kind(entry: &Entry) -> &'static str {
    if can_change(entry) { "Handle" } else { "Constant" }
}

/// The Rust type of a value, or what stands for one.
fn value_type(data_type: DataType) -> &'static str {
    match data_type {
        DataType::VisibleString => "VisibleString",
        DataType::OctetString => "OctetString",
        DataType::UnicodeString => "UnicodeString",
        DataType::TimeOfDay => "TimeOfDay",
        DataType::TimeDifference => "TimeDifference",
        _ => match data_type.kind() {
            DataTypeKind::Boolean | DataTypeKind::Signed | DataTypeKind::Unsigned | DataTypeKind::Real => {
                data_type.rust_type()
            }
            _ => "Domain",
        },
    }
}

/// `` `Vendor ID` of `Identity`: `[1018sub1]`, UNSIGNED32, ro. ``
fn docs(layout: &Layout, place: usize) -> String {
    let (entry, source) = (&layout.entries[place], &layout.sources[place]);
    let name = for_docs(&source.name);
    let object = source.object.as_deref().and_then(for_docs);
    let title = match (name, object) {
        (Some(name), Some(object)) => format!("{name} of {object}: "),
        (Some(name), None) | (None, Some(name)) => format!("{name}: "),
        (None, None) => String::new(),
    };
    let given = if entry.flags.has(Flags::GIVEN) { "; given at start" } else { "" };
    let (data_type, access) = (data_type(entry), source.access);
    format!(" {title}`[{}]`, {data_type}, {access}{}{given}.", source.section, unit(source))
}

/// `UNSIGNED16`, `VISIBLE_STRING of up to 16 bytes`
fn data_type(entry: &Entry) -> String {
    match entry.data_type {
        text if text.is_string() && can_change(entry) => format!("{text} of up to {} bytes", entry.size),
        data_type => data_type.to_string(),
    }
}

fn unit(source: &Source) -> String {
    source.unit.as_deref().and_then(for_docs).map_or_else(String::new, |unit| format!(", in {unit}"))
}

/// `` `Torques`: sub-indices 01h to 04h of 2003h, UNSIGNED16. `` and what each is, where they are few.
fn array_docs(layout: &Layout, entries: Range<usize>) -> Vec<String> {
    let (first, last) = (&layout.entries[entries.start], &layout.entries[entries.end - 1]);
    let sources = &layout.sources[entries.clone()];
    let title = sources[0].object.as_deref().and_then(for_docs).map_or_else(String::new, |name| name + ": ");
    let all_alike = |what: fn(&Source) -> String| {
        let of_first = what(&sources[0]);
        sources.iter().all(|source| what(source) == of_first).then_some(of_first)
    };
    let access = all_alike(|source| format!(", {}", source.access));
    let unit_of_all = all_alike(unit);
    let has_one_size = layout.entries[entries.clone()].iter().all(|entry| entry.size == first.size);
    let what = match entries.len() {
        1 => format!("sub-index {}", first.sub_index),
        _ => format!("sub-indices {} to {}", first.sub_index, last.sub_index),
    };
    let mut docs = vec![format!(
        " {title}{what} of {}, {}{}{}.",
        first.index,
        if has_one_size { data_type(first) } else { first.data_type.to_string() },
        access.as_deref().unwrap_or_default(),
        unit_of_all.as_deref().unwrap_or_default()
    )];
    let is_compact = sources.len() > 1 && sources.iter().all(|source| source.section == sources[0].section);
    if entries.len() <= MOST_LISTED && !is_compact {
        docs.push(String::new());
        for (place, source) in sources.iter().enumerate() {
            let name = for_docs(&source.name).map_or_else(String::new, |name| format!("{name} "));
            let own_access = if access.is_none() { format!(", {}", source.access) } else { String::new() };
            let own_unit = if unit_of_all.is_none() { unit(source) } else { String::new() };
            docs.push(format!(" - {place}: {name}`[{}]`{own_access}{own_unit}", source.section));
        }
    }
    docs
}
