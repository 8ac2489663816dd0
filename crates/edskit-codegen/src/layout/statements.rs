//! Whether what the side-file says can be so, and has an effect.

use super::fixed_size;
use super::gather::Item;
use crate::side_file::Key;
use crate::{Problem, SideFile};
use edskit_lint::Severity;
use edskit_model::Span;
use edskit_runtime::{Entry, Flags, StorageGroup};
use edskit_types::{DataType, SubIndex};

/// What there is to say about the statements of a side-file.
#[derive(Default)]
pub(super) struct Checked {
    /// Those that change nothing, or not what they seem to.
    pub(super) without_effect: Vec<Problem>,
    /// Those that cannot be.
    pub(super) contradictions: Vec<Problem>,
}

/// Looks at each statement with the entries that it is about. A statement over many entries is fine where it is for one.
pub(super) fn check(items: &[Item], entries: &[Entry], side_file: &SideFile) -> Checked {
    let mut checked = Checked::default();
    let problem =
        |severity, span: Span, message| Problem::in_side_file(&side_file.text, severity, span, message);
    for said in side_file.statements() {
        let meant = || {
            let all = items.iter().zip(entries);
            all.filter(|(item, _)| said.places.contain(item.index, item.sub_index))
        };
        let mut note = |message| checked.without_effect.push(problem(Severity::Warning, said.span, message));
        if meant().next().is_none() {
            note("the dictionary has no such entry".to_owned());
            continue;
        }
        let remarks = || meant().map(|(item, entry)| remark(said.what, item, entry, side_file));
        if let Some(Some(message)) = remarks().next().filter(|_| remarks().all(|remark| remark.is_some())) {
            note(message);
        }
        if said.what == Key::Given
            && let Some(reason) = meant().find_map(|(item, entry)| why_not_given(item, entry))
        {
            checked.contradictions.push(problem(Severity::Error, said.span, reason));
        }
    }
    checked
}

/// What is odd about a statement for one entry.
fn remark(key: Key, item: &Item, entry: &Entry, side_file: &SideFile) -> Option<String> {
    let place = place(item);
    let is_variable = entry.flags.has(Flags::VARIABLE);
    let data_type = item.data_type;
    Some(match key {
        Key::Capacity(_) if !data_type.is_string() => {
            let size = fixed_size(data_type).map(|size| format!(", and has {size} bytes"));
            format!("only a text has a capacity: {place} is {data_type}{}", size.unwrap_or_default())
        }
        Key::Capacity(capacity) if entry.size > capacity => {
            format!("the default of {place} has {} bytes, and so has the text", entry.size)
        }
        Key::Storage(_) if data_type == DataType::Domain => {
            format!("{place} is a DOMAIN, whose data the application has: nothing of it is stored")
        }
        Key::Storage(_) if entry.flags.has(Flags::GIVEN) => {
            format!("{place} is given at start, and so it is not stored")
        }
        Key::Storage(_) if !is_variable => format!("{place} cannot change, and so it is not stored"),
        Key::Storage(Some(StorageGroup(_))) if !item.access.is_writable() => format!(
            "clients cannot write {place}: what it has at the time of a save is its value after each reset, whatever the \
             device has changed since"
        ),
        Key::Storage(None) if !item.access.is_writable() => {
            format!("clients cannot write {place}: it is not stored anyhow")
        }
        Key::Variable if data_type == DataType::Domain => {
            format!("{place} is a DOMAIN, whose data the application has: it does not lie in RAM")
        }
        Key::Variable if item.access.is_writable() => format!("clients write {place}: it lies in RAM anyhow"),
        Key::Variable if side_file.is_given(item.index, item.sub_index) => {
            format!("{place} is given at start: it lies in RAM anyhow")
        }
        Key::Rpdo if !entry.flags.has(Flags::RPDO) => {
            format!("no PDO carries {data_type}, the type of {place}")
        }
        _ => return None,
    })
}

/// Why an entry cannot be given its value at start.
fn why_not_given(item: &Item, entry: &Entry) -> Option<String> {
    let place = place(item);
    Some(if item.data_type == DataType::Domain {
        format!("{place} cannot be given: it is a DOMAIN, whose data the application has")
    } else if item.access.is_writable() {
        format!("{place} cannot be given: clients write it")
    } else if entry.flags.has(Flags::RPDO) {
        format!("{place} cannot be given: RPDOs write it")
    } else if entry.flags.has(Flags::NODE_RELATIVE) {
        format!("{place} cannot be given: it follows the node-ID")
    } else if matches!(item.index.0, 0x1001..=0x1003) {
        format!("{place} cannot be given: it tells what has happened since power-on")
    } else {
        return None;
    })
}

/// `2001h`, `2001h sub-index 02h`
fn place(item: &Item) -> String {
    match (item.sub_index, &item.source.object) {
        (SubIndex(0), None) => item.index.to_string(),
        (sub_index, _) => format!("{} sub-index {sub_index}", item.index),
    }
}
