//! The entries that the side-file adds.

use super::{Gathered, Item};
use crate::layout::value::Bytes;
use crate::layout::{Array, MOST_ENTRIES, Source};
use crate::side_file::Extra;
use crate::{InputFile, Problem, SideFile};
use edskit_lint::Severity;
use edskit_model::Span;
use edskit_types::{DataTypeKind, Index, SubIndex};

pub(super) fn add(side_file: &SideFile, gathered: &mut Gathered) {
    for extra in side_file.extras() {
        if let Err((span, message)) = add_one(extra, side_file, &mut gathered.items) {
            gathered.errors.push(Problem::in_side_file(&side_file.text, Severity::Error, span, message));
        }
        gathered.items.sort_by_key(Item::key);
    }
}

fn add_one(extra: &Extra, side_file: &SideFile, items: &mut Vec<Item>) -> Result<(), (Span, String)> {
    if extra.data_type.kind() == DataTypeKind::Record {
        return Err((extra.span, format!("{} is no data type of values", extra.data_type)));
    }
    let default = match &extra.default {
        Some((text, span)) => {
            let wrong = |reason| (*span, format!("`{text}` cannot be the default: {reason}"));
            Some(Bytes::of_text(text, extra.data_type).map_err(wrong)?)
        }
        None => None,
    };
    let known = items.len();
    for (index, sub_index) in extra.entries() {
        let described = &items[..known];
        let object = of_object(described, index);
        let is_described = described[object.clone()].iter().any(|item| item.sub_index == sub_index);
        if is_described {
            return Err((extra.span, format!("{index} sub-index {sub_index} is in the dictionary already")));
        }
        if items.len() > MOST_ENTRIES {
            return Ok(());
        }
        let first = described[object.clone()].first();
        if first.is_some_and(|item| item.sub_index == SubIndex(0) && !item.is_count && sub_index.0 > 0) {
            return Err((
                extra.span,
                format!("{index} is described as a variable, which has no sub-objects"),
            ));
        }
        let object_name = first.and_then(|item| item.source.object.clone());
        let array = first.and_then(|item| item.source.array).filter(|array| *array == Array::Object);
        for item in &mut items[object] {
            item.is_extended = true;
        }
        // What is added to an ARRAY belongs to it.
        let array = array.or(extra.has_several_sub_objects().then_some(Array::Added(extra.span)));
        items.push(item(extra, side_file, index, sub_index, default.clone(), object_name, array));
    }
    Ok(())
}

/// Where the entries of an object lie among the sorted items.
fn of_object(items: &[Item], index: Index) -> core::ops::Range<usize> {
    items.partition_point(|item| item.index < index)..items.partition_point(|item| item.index <= index)
}

fn item(
    extra: &Extra,
    side_file: &SideFile,
    index: Index,
    sub_index: SubIndex,
    default: Option<Bytes>,
    object: Option<String>,
    array: Option<Array>,
) -> Item {
    Item {
        index,
        sub_index,
        data_type: extra.data_type,
        access: extra.access,
        is_mappable: extra.is_mappable,
        is_count: false,
        is_extended: true,
        default,
        limits: None,
        value_span: extra.span,
        source: Source {
            file: InputFile::SideFile,
            section: format!("{:X}sub{:X}", index.0, sub_index.0),
            span: extra.span,
            position: Problem::in_side_file(&side_file.text, Severity::Info, extra.span, String::new())
                .position,
            name: extra.name.clone(),
            object,
            access: extra.access,
            unit: side_file.unit(index, sub_index).map(str::to_owned),
            array,
            given_name: None,
            given_object_name: None,
        },
    }
}
