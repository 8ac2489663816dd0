//! The canonical order of sections and of entries.

use super::layout::Block;
use crate::datasheet::{Datasheet, Identity, Section};
use crate::key::{KeyGroup, KeyName};
use crate::section::{ModuleSection, SectionKind};
use edskit_types::Index;
use std::collections::HashMap;

/// What decides the place of one thing among others.
enum Place<R> {
    /// Its rank; equal ranks keep the order of the file.
    Ranked(R),
    /// Behind the thing that it followed in the file.
    Behind,
    /// Behind the earlier thing at this position that says the same, since the first one of two counts.
    Joins(usize),
}

/// Positions in canonical order.
fn arrange<R: Ord + Copy>(places: impl ExactSizeIterator<Item = Place<R>>) -> Vec<usize> {
    // Rank and position of the head that the thing follows, the position it is sorted by among the followers, and its
    // own. What has no head stands before everything else.
    let mut keys: Vec<(Option<R>, usize, usize, usize)> = Vec::with_capacity(places.len());
    for (position, place) in places.enumerate() {
        let key = match place {
            Place::Ranked(rank) => (Some(rank), position, position, position),
            Place::Behind => match keys.last() {
                Some(&(rank, head, ..)) => (rank, head, position, position),
                None => (None, position, position, position),
            },
            Place::Joins(earlier) => {
                let (rank, head, anchor, _) = keys[earlier];
                (rank, head, anchor, position)
            }
        };
        keys.push(key);
    }
    if !keys.is_sorted() {
        keys.sort_unstable();
    }
    keys.into_iter().map(|(.., position)| position).collect()
}

/// The sections in canonical order, by their positions in the file.
///
/// 1. FileInfo, DeviceInfo, DeviceComissioning, DummyUsage, Comments, Tools, DynamicChannels, modules;
/// 2. data types, then the three lists, each followed by its objects in ascending order; each object by its
///    sub-objects, links, and compact lists. Objects of no list follow those of the list that they should be in;
/// 3. Topology.
///
/// A section that CiA 306 does not know, and one with an error in its syntax, stays behind the section it followed.
pub(super) fn sections(sheet: &Datasheet, blocks: &[Block]) -> Vec<usize> {
    if frozen_is_doubled(sheet, blocks) {
        return (0..blocks.len()).collect();
    }
    let lists = listed(sheet);
    let mut unknown: HashMap<Vec<u8>, usize> = HashMap::new();
    let places = sheet.sections().zip(blocks).enumerate().map(|(position, (section, block))| {
        if let Identity::Unknown(name) = section.identity() {
            let first = *unknown.entry(name).or_insert(position);
            return if first < position && !block.is_frozen { Place::Joins(first) } else { Place::Behind };
        }
        if block.is_frozen { Place::Behind } else { Place::Ranked(rank(section.kind(), &lists)) }
    });
    arrange(places.collect::<Vec<_>>().into_iter())
}

/// Whether a section that cannot be moved has a double, so that moving the others could change which one is first.
fn frozen_is_doubled(sheet: &Datasheet, blocks: &[Block]) -> bool {
    if !blocks.iter().any(|block| block.is_frozen) {
        return false;
    }
    let mut seen: HashMap<Identity<SectionKind>, bool> = HashMap::new();
    sheet.sections().zip(blocks).any(|(section, block)| {
        match seen.insert(section.identity(), block.is_frozen) {
            Some(was_frozen) => was_frozen || block.is_frozen,
            None => false,
        }
    })
}

/// The place of a section of CiA 306: group, then whatever orders the group.
type Rank = (u8, u16, u16, u16, u16);

const MODULES: u8 = 7;
const DATA_TYPES: u8 = 8;
const MANDATORY: u8 = 9;
const OPTIONAL: u8 = 10;
const MANUFACTURER: u8 = 11;

fn rank(kind: SectionKind, lists: &HashMap<Index, u8>) -> Rank {
    let object = |index: Index, part: u16| match lists.get(&index) {
        Some(&list) => (list, 1, index.0, part, 0),
        None => (list_of(index), 2, index.0, part, 0),
    };
    match kind {
        SectionKind::FileInfo => (0, 0, 0, 0, 0),
        SectionKind::DeviceInfo => (1, 0, 0, 0, 0),
        SectionKind::DeviceCommissioning => (2, 0, 0, 0, 0),
        SectionKind::DummyUsage => (3, 0, 0, 0, 0),
        SectionKind::Comments => (4, 0, 0, 0, 0),
        SectionKind::Tools => (5, 0, 0, 0, 0),
        SectionKind::Tool(number) => (5, 1, number, 0, 0),
        SectionKind::DynamicChannels => (6, 0, 0, 0, 0),
        SectionKind::SupportedModules => (MODULES, 0, 0, 0, 0),
        SectionKind::Module(number, section) => {
            let (part, index, sub) = module_part(section);
            (MODULES, number, part, index, sub)
        }
        SectionKind::ConnectedModules => (MODULES, u16::MAX, u16::MAX, 0, 0),
        SectionKind::MandatoryObjects => (MANDATORY, 0, 0, 0, 0),
        SectionKind::OptionalObjects => (OPTIONAL, 0, 0, 0, 0),
        SectionKind::ManufacturerObjects => (MANUFACTURER, 0, 0, 0, 0),
        SectionKind::Object(index) => object(index, 0),
        SectionKind::SubObject(index, sub_index) => object(index, 1 + u16::from(sub_index.0)),
        SectionKind::ObjectLinks(index) => object(index, 300),
        SectionKind::CompactNames(index) => object(index, 301),
        SectionKind::CompactValues(index) => object(index, 302),
        SectionKind::CompactDenotations(index) => object(index, 303),
        // A nodelist.cpj keeps its order.
        SectionKind::Topology(_) | SectionKind::Unknown => (u8::MAX, 0, 0, 0, 0),
    }
}

/// The order within a module; parts count from 1, so that a module 0 does not mix with SupportedModules.
fn module_part(section: ModuleSection) -> (u16, u16, u16) {
    match section {
        ModuleSection::Info => (1, 0, 0),
        ModuleSection::Comments => (2, 0, 0),
        ModuleSection::FixedObjects => (3, 0, 0),
        ModuleSection::Fixed(index) => (4, index.0, 0),
        ModuleSection::FixedSub(index, sub_index) => (4, index.0, 1 + u16::from(sub_index.0)),
        ModuleSection::SubExtends => (5, 0, 0),
        ModuleSection::SubExtension(index) => (6, index.0, 0),
    }
}

/// For each listed object the first of the lists that name it.
fn listed(sheet: &Datasheet) -> HashMap<Index, u8> {
    let mut lists = HashMap::new();
    for section in sheet.sections() {
        let list = match section.kind() {
            SectionKind::MandatoryObjects => MANDATORY,
            SectionKind::OptionalObjects => OPTIONAL,
            SectionKind::ManufacturerObjects => MANUFACTURER,
            _ => continue,
        };
        for index in section.items().filter_map(|item| item.index.known()) {
            let known = lists.entry(Index(index)).or_insert(list);
            *known = list.min(*known);
        }
    }
    lists
}

/// The list that an object should be in (CiA 306 v1.3, 4.6.3.1).
fn list_of(index: Index) -> u8 {
    match index.0 {
        0x0000..=0x0FFF => DATA_TYPES,
        0x1000 | 0x1001 | 0x1018 => MANDATORY,
        0x2000..=0x5FFF => MANUFACTURER,
        _ => OPTIONAL,
    }
}

/// The entries of a section in canonical order, by their positions in it. Unknown keys stay behind the entry that they
/// followed, and sections that CiA 306 does not know and those of a nodelist.cpj keep their order.
pub(super) fn entries(section: Section<'_>) -> Vec<usize> {
    let kind = section.kind();
    if matches!(kind, SectionKind::Unknown | SectionKind::Topology(_)) {
        return (0..section.entries().len()).collect();
    }
    let keys = match KeyGroup::of(kind) {
        KeyGroup::Description | KeyGroup::SubExtension => DESCRIPTION,
        group => group.keys(),
    };
    let mut unknown: HashMap<Vec<u8>, usize> = HashMap::new();
    let places = section.entries().enumerate().map(|(position, entry)| {
        let key = entry.key();
        let Some(rank) = keys.iter().position(|&name| name == key.name) else {
            let first = match entry.identity() {
                Identity::Unknown(name) => *unknown.entry(name).or_insert(position),
                Identity::Known(_) => position,
            };
            return if first < position { Place::Joins(first) } else { Place::Behind };
        };
        // The four keys of one channel belong together; elsewhere each key counts on its own.
        let (rank, number) = (rank as u16, key.number);
        Place::Ranked(if kind == SectionKind::DynamicChannels { (number, rank) } else { (rank, number) })
    });
    arrange(places)
}

/// The attributes of an object in the order that most files have.
const DESCRIPTION: &[KeyName] = {
    use KeyName::*;
    &[
        ParameterName,
        Denotation,
        ParamRefd,
        ObjectType,
        SubNumber,
        DataType,
        AccessType,
        DefaultValue,
        PdoMapping,
        LowLimit,
        HighLimit,
        ParameterValue,
        ObjFlags,
        CompactSubObj,
        UploadFile,
        DownloadFile,
        SrdoMapping,
        InvertedSrad,
        Count,
        ObjExtend,
    ]
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_attribute_has_a_place() {
        for key in KeyGroup::SubExtension.keys() {
            assert!(DESCRIPTION.contains(key), "{}", key.spelling());
        }
        assert_eq!(DESCRIPTION.len(), KeyGroup::SubExtension.keys().len());
    }

    #[test]
    fn what_is_glued_follows_and_what_is_doubled_joins() {
        use Place::*;
        let order = |places: Vec<Place<u8>>| arrange(places.into_iter());
        assert_eq!(order(vec![Ranked(2), Ranked(1), Ranked(2)]), [1, 0, 2]);
        assert_eq!(order(vec![Behind, Ranked(2), Behind, Ranked(1)]), [0, 3, 1, 2]);
        assert_eq!(order(vec![Ranked(2), Behind, Ranked(1), Joins(1), Behind]), [2, 0, 1, 3, 4]);
        assert_eq!(order(vec![Ranked(2), Behind, Behind, Ranked(1), Joins(1)]), [3, 0, 1, 4, 2]);
    }
}
