//! Finding entries in dictionaries of different size.

use crate::generate::device_of;
use criterion::{Criterion, Throughput};
use edskit_runtime::types::{Index, SubIndex};
use std::hint::black_box;
use zencan_node::common::objects::ObjectCode;
use zencan_node::object_dict::{CallbackObject, ODEntry, find_object_entry};

/// How many look-ups are timed together.
const LOOK_UPS: usize = 1000;

pub(crate) fn benches(criterion: &mut Criterion) {
    for size in [100, 1_000, 10_000] {
        let layout = edskit_codegen::parse(device_of(size).as_bytes(), None).expect("it is laid out");
        let table = layout.table();
        let objects: Vec<u16> = layout
            .entries
            .iter()
            .filter(|entry| entry.sub_index == SubIndex(0))
            .map(|entry| entry.index.0)
            .collect();
        // With 1018h, which the file leaves out.
        assert_eq!(objects.len(), usize::from(size) + 1);
        let indices = in_no_order(&objects);
        let object = CallbackObject::new(ObjectCode::Var);
        let entries: Vec<ODEntry> = objects.iter().map(|&index| ODEntry { index, data: &object }).collect();
        for &index in &indices {
            let position = table.find(Index(index), SubIndex(0)).expect("it is there");
            assert_eq!(table.entry(position).map(|entry| entry.index.0), Some(index));
            assert_eq!(find_object_entry(&entries, index).map(|entry| entry.index), Some(index));
        }

        let mut group = crate::group(criterion, &format!("look-up among {size}"));
        group.throughput(Throughput::Elements(LOOK_UPS as u64));
        group.bench_function("edskit", |bencher| {
            bencher.iter(|| {
                for &index in &indices {
                    black_box(table.find(Index(black_box(index)), SubIndex(0)).ok());
                }
            });
        });
        group.bench_function("zencan", |bencher| {
            bencher.iter(|| {
                for &index in &indices {
                    black_box(find_object_entry(&entries, black_box(index)));
                }
            });
        });
        group.finish();
    }
}

/// As many of these indices as are looked up, in an order without a pattern.
fn in_no_order(indices: &[u16]) -> Vec<u16> {
    let mut state: u32 = 1;
    let next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        indices[(state >> 16) as usize % indices.len()]
    };
    std::iter::repeat_with(next).take(LOOK_UPS).collect()
}
