//! SDO transfers.

use crate::client::{download, upload, upload_block, upload_segmented};
use crate::device::{Device, LENGTH, bytes};
use crate::edskit::Edskit;
use crate::zencan::Zencan;
use criterion::Criterion;
use std::hint::black_box;

/// A transfer that a node is asked for; the bytes are those that the client has.
type Transfer<D> = fn(&mut D, &mut Vec<u8>);

pub(crate) fn benches(criterion: &mut Criterion, edskit: &mut Edskit, zencan: &mut Zencan) {
    are_right(edskit);
    are_right(zencan);
    let rows: [(&str, Transfer<Edskit>, Transfer<Zencan>); 4] = [
        ("SDO expedited upload", read_number, read_number),
        ("SDO expedited download", write_number, write_number),
        ("SDO segmented upload, 7 kB", upload_segmented, upload_segmented),
        ("SDO block upload, 7 kB", upload_block, upload_block),
    ];
    for (name, of_edskit, of_zencan) in rows {
        let mut group = crate::group(criterion, name);
        let mut into = Vec::with_capacity(LENGTH + 8);
        group.bench_function(Edskit::NAME, |bencher| bencher.iter(|| of_edskit(edskit, &mut into)));
        group.bench_function(Zencan::NAME, |bencher| bencher.iter(|| of_zencan(zencan, &mut into)));
        group.finish();
    }
}

fn read_number<D: Device>(device: &mut D, _: &mut Vec<u8>) {
    black_box(upload(device));
}

fn write_number<D: Device>(device: &mut D, _: &mut Vec<u8>) {
    download(device, black_box(0x0102_0304));
}

/// What is timed gives the right answers.
fn are_right<D: Device>(device: &mut D) {
    download(device, 0x0403_0201);
    assert_eq!(upload(device), 0x0403_0201, "{}", D::NAME);
    for transfer in [upload_segmented, upload_block] {
        let mut into = Vec::new();
        transfer(device, &mut into);
        assert!(into == bytes(), "{}", D::NAME);
    }
}
