//! PDOs: one frame in, and one frame out.

use crate::device::{Device, Mapping};
use crate::edskit::Edskit;
use crate::zencan::Zencan;
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion};
use std::hint::black_box;

/// What received frames hold: eight bytes that differ.
const DATA: [u8; 8] = [0x0F, 0xF0, 0x55, 0xAA, 0x01, 0x80, 0xC3, 0x3C];

pub(crate) fn benches(criterion: &mut Criterion, edskit: &mut Edskit, zencan: &mut Zencan) {
    for mapping in [Mapping::Words, Mapping::Bytes, Mapping::Bits] {
        // zencan maps whole bytes, and at most 8 entries.
        let is_with_both = !matches!(mapping, Mapping::Bits);
        let mut receiving = crate::group(criterion, &format!("RPDO, {}", mapping.name()));
        receive(&mut receiving, edskit, mapping);
        if is_with_both {
            receive(&mut receiving, zencan, mapping);
        }
        receiving.finish();
        let mut transmitting = crate::group(criterion, &format!("TPDO, {}", mapping.name()));
        transmit(&mut transmitting, edskit, mapping);
        if is_with_both {
            transmit(&mut transmitting, zencan, mapping);
        }
        transmitting.finish();
    }
}

/// A frame comes, and its values are in the dictionary.
fn receive<D: Device>(group: &mut BenchmarkGroup<'_, WallTime>, device: &mut D, mapping: Mapping) {
    let take = |device: &mut D, data: &[u8; 8]| {
        device.receive(mapping.rpdo(), data);
        device.poll();
        assert!(device.transmit().is_none());
    };
    for data in [[0; 8], DATA] {
        take(device, &data);
        let values = match mapping {
            Mapping::Bits => (0..64).map(|bit| data[bit / 8] >> (bit % 8) & 1).collect(),
            Mapping::Words | Mapping::Bytes => data.to_vec(),
        };
        assert_eq!(device.received(mapping), values, "{}", D::NAME);
    }
    group.bench_function(D::NAME, |bencher| bencher.iter(|| take(device, black_box(&DATA))));
}

/// The device changes a value, and a frame goes.
fn transmit<D: Device>(group: &mut BenchmarkGroup<'_, WallTime>, device: &mut D, mapping: Mapping) {
    let send = |device: &mut D, value: u8| {
        device.change(mapping, value);
        device.poll();
        let frame = device.transmit().expect("the PDO is sent");
        assert!(device.transmit().is_none());
        frame
    };
    for value in [1, 0] {
        let frame = send(device, value);
        assert_eq!(D::can_id(&frame), mapping.tpdo(), "{}", D::NAME);
        assert_eq!(D::data(&frame), [value, 0, 0, 0, 0, 0, 0, 0], "{}", D::NAME);
    }
    group.bench_function(D::NAME, |bencher| bencher.iter(|| send(device, black_box(1))));
}
