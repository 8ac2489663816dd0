//! Stored parameters live through an update of the firmware: any two revisions of an EDS, any stored values, any node-IDs.

use edskit_codegen::{Layout, LoadedDictionary, parse};
use edskit_host::MemoryStorage;
use edskit_runtime::{
    Application, Emergency, Entry, Flags, Frame, Instant, Key, Node, Objects, Services, Settings,
};
use edskit_types::{CanId, Index, NodeId, SubIndex};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// The indices that a revision may describe: parameters of the communication, the manufacturer and the profile.
const PLACES: [u16; 10] = [0x1014, 0x1017, 0x1019, 0x2000, 0x2001, 0x2002, 0x2003, 0x2004, 0x6000, 0x6001];

/// An object of a revision.
#[derive(Clone, Debug)]
struct Object {
    data_type: u8,
    default: u8,
    is_node_relative: bool,
    /// The highest value, for a number.
    high: Option<u8>,
    /// The group, where the side-file says one.
    group: Option<u8>,
}

fn object() -> impl Strategy<Value = Object> {
    let data_type = prop::sample::select(&[1_u8, 2, 3, 4, 5, 6, 7, 9, 10][..]);
    let group = prop_oneof![3 => Just(None), 1 => (2..6_u8).prop_map(Some)];
    (data_type, 0..100_u8, any::<bool>(), prop::option::weighted(0.3, 100..=120_u8), group).prop_map(
        |(data_type, default, is_node_relative, high, group)| Object {
            data_type,
            default,
            is_node_relative,
            high,
            group,
        },
    )
}

/// A revision: which places have an object, and which sub-indices 1010h has.
type Revision = (BTreeMap<u16, Object>, bool);

fn revision() -> impl Strategy<Value = Revision> {
    let objects = prop::collection::btree_map(prop::sample::select(&PLACES[..]), object(), 0..PLACES.len());
    (objects, any::<bool>())
}

fn layout((objects, has_groups): &Revision) -> Layout {
    let mut eds = Vec::new();
    let mut side_file = vec!["[storage]".to_owned()];
    let subs = if *has_groups { &[1, 2, 4][..] } else { &[1] };
    eds.push(format!("[1010]\nParameterName=Store\nObjectType=8\nSubNumber={}", subs.len() + 1));
    eds.push("[1010sub0]\nParameterName=n\nDataType=5\nAccessType=ro\nDefaultValue=4".to_owned());
    for sub in subs {
        eds.push(format!("[1010sub{sub}]\nParameterName=s\nDataType=7\nAccessType=rw\nDefaultValue=1"));
    }
    for (index, object) in objects {
        let Object { data_type, default, is_node_relative, high, group } = object;
        // The objects of the communication profile have the types that CiA 301 gives them.
        let data_type = match index {
            0x1014 => 7,
            0x1017 => 6,
            0x1019 => 5,
            _ => *data_type,
        };
        let is_number = (2..=7).contains(&data_type);
        let default = match (index, data_type) {
            (0x1014, _) => 0x80 + u32::from(*default) / 50,
            (0x1019, _) => u32::from(default % 3),
            (_, 1) => u32::from(default % 2),
            _ => u32::from(*default),
        };
        let formula = if *is_node_relative && is_number && *index != 0x1019 { "$NODEID+" } else { "" };
        eds.push(format!("[{index:X}]\nParameterName=x\nDataType={data_type}\nAccessType=rw"));
        eds.push(format!("DefaultValue={formula}{default}"));
        if let Some(high) = high.filter(|_| is_number && *index >= 0x2000) {
            eds.push(format!("HighLimit={high}"));
        }
        if let Some(group) = group {
            side_file.push(format!("\"{index:X}\" = {group}"));
        }
    }
    parse(eds.join("\n").as_bytes(), Some(&side_file.join("\n"))).expect("the revision can be laid out")
}

/// Notes what the node tells.
#[derive(Default)]
struct Notes {
    dropped: Vec<Index>,
    has_lost: bool,
}

impl Application for Notes {
    fn stored_value_dropped(&mut self, _: &mut Services<'_>, index: Index, _: SubIndex) {
        self.dropped.push(index);
    }

    fn emergency(&mut self, _: &mut Services<'_>, emergency: &mut Emergency) {
        self.has_lost |= emergency.code == 0x6300;
    }
}

/// The bytes of every parameter.
fn values(layout: &Layout, objects: &Objects<'_>) -> BTreeMap<Index, Vec<u8>> {
    let table = layout.table();
    let parameters = table.all().filter(|(_, entry)| entry.index != Index::STORE_PARAMETERS);
    parameters.map(|(position, entry)| (entry.index, objects.bytes(position).to_vec())).collect()
}

/// The default of an entry on a node.
fn default(layout: &Layout, entry: &Entry, node_id: NodeId) -> Vec<u8> {
    let offset = layout.default_of(entry).to_vec();
    let is_relative = entry.flags.has(Flags::NODE_RELATIVE);
    if is_relative { with_node_id(&offset, node_id) } else { offset }
}

fn with_node_id(offset: &[u8], node_id: NodeId) -> Vec<u8> {
    let mut bytes = [0; 8];
    bytes[..offset.len()].copy_from_slice(offset);
    let value = u64::from_le_bytes(bytes).wrapping_add(node_id.get().into());
    value.to_le_bytes()[..offset.len()].to_vec()
}

/// Whether a client could write a value.
fn can_have(revision: &Revision, entry: &Entry, value: &[u8]) -> bool {
    if entry.flags.has(Flags::LIMITED) {
        let high = revision.0[&entry.index.0].high.expect("limits come from the revision");
        let mut bytes = [if value.last().is_some_and(|byte| byte & 0x80 != 0) && entry.data_type.is_signed() {
            0xFF
        } else {
            0
        }; 8];
        bytes[..value.len()].copy_from_slice(value);
        return i64::from_le_bytes(bytes) <= high.into();
    }
    match (entry.index.0, entry.data_type.index().0) {
        (0x1019, _) => matches!(value[0], 0 | 2..=240),
        (0x1014, _) => {
            let cob_id = u32::from_le_bytes(value.try_into().expect("1014h has four bytes"));
            let is_restricted = matches!(cob_id & 0x7FF, 0..=0x7F | 0x101..=0x180 | 0x581..=0x5FF | 0x601..=0x67F | 0x6E0..=0x6FF | 0x701..=0x77F | 0x780..=0x7FF);
            cob_id & 0x3FFF_F800 == 0 && (cob_id & 0x8000_0000 != 0 || !is_restricted)
        }
        (_, 1) => value[0] <= 1,
        _ => true,
    }
}

fn settings(node_id: NodeId) -> Settings {
    Settings { node_id: Some(node_id), ..Settings::DEFAULT }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn stored_values_live_through_any_update(
        old in revision(),
        new in revision(),
        is_same in prop::bool::weighted(0.2),
        stored in prop::collection::btree_map(prop::sample::select(&PLACES[..]), prop::collection::vec(any::<u8>(), 8), 0..8),
        nodes in [1..=127_u8, 1..=127_u8],
    ) {
        let new = if is_same { old.clone() } else { new };
        let [first, second] = nodes.map(|node_id| NodeId::new(node_id).expect("it is a node-ID"));
        let (old_layout, new_layout) = (layout(&old), layout(&new));
        let mut storage = MemoryStorage::default();

        let mut node = Node::new(LoadedDictionary::new(&old_layout), settings(first), &mut storage);
        node.poll(Instant(0), &mut Notes::default());
        for (index, value) in &stored {
            if let Ok(position) = old_layout.table().find(Index(*index), SubIndex(0)) {
                let size = usize::from(old_layout.entries[usize::from(position.0)].size);
                let stored = node.objects().store_by_key(Key::new(*index, 0), &value[..size.min(value.len())]);
                prop_assert_eq!(stored, Ok(()));
            }
        }
        let saved = values(&old_layout, &node.objects());
        let request = [0x23, 0x10, 0x10, 1, b's', b'a', b'v', b'e'];
        let request = Frame::new(CanId::standard(0x600 + u16::from(first.get())).expect("it has eleven bits"), &request);
        node.receive(Instant(1), &request, &mut Notes::default());

        let mut notes = Notes::default();
        let mut node = Node::new(LoadedDictionary::new(&new_layout), settings(second), &mut storage);
        node.poll(Instant(0), &mut notes);
        let mut now = values(&new_layout, &node.objects());

        let (mut expected, mut dropped, mut is_lost) = (BTreeMap::new(), Vec::new(), false);
        // A lost value is an error, which the node itself tells in the error register.
        let is_compared = |index: Index| ![Index::STORE_PARAMETERS, Index::ERROR_REGISTER].contains(&index);
        now.retain(|index, _| is_compared(*index));
        for entry in new_layout.entries.iter().filter(|entry| is_compared(entry.index)) {
            expected.insert(entry.index, default(&new_layout, entry, second));
        }
        for entry in old_layout.entries.iter().filter(|entry| entry.flags.group().is_some()) {
            let was = &saved[&entry.index];
            let offset = old_layout.default_of(entry);
            let follows = entry.flags.has(Flags::NODE_RELATIVE) && *was == default(&old_layout, entry, first);
            let value = if follows { with_node_id(offset, second) } else { was.clone() };
            let place = new_layout.table().find(entry.index, SubIndex(0)).ok();
            let place = place.and_then(|position| new_layout.table().entry(position));
            let place = place.filter(|place| place.flags.group().is_some());
            let fits = |place: &&Entry| {
                let size = usize::from(place.size);
                let has_length = place.data_type.is_string();
                (value.len() == size || (has_length && value.len() < size)) && can_have(&new, place, &value)
            };
            match place.filter(fits) {
                Some(_) => drop(expected.insert(entry.index, value.clone())),
                None => {
                    dropped.push(entry.index);
                    is_lost |= place.is_some();
                }
            }
        }
        notes.dropped.sort_unstable();
        prop_assert_eq!(now, expected);
        prop_assert_eq!(notes.dropped, dropped);
        prop_assert_eq!(notes.has_lost, is_lost);
    }
}
