//! The node beside zencan-node 0.0.5: both run dictionaries that were generated for the same device, are driven frame in,
//! frames out, and are asked to do the same.
//!
//! zencan's node enters a critical section for each value. Here that costs nothing, which is the least that it can cost: a
//! microcontroller masks interrupts. With the feature `zencan-mutex` it is what the crate does on a computer by itself.
//!
//! What zencan-node does not have, so that edskit stands alone there: mapping of single bits, and more than 8 mapped
//! entries. Both are compared with 4 entries of 16 bits and with 8 of 8 bits.

mod client;
mod device;
mod edskit;
mod generate;
mod look_up;
mod pdo;
mod sdo;
mod zencan;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion};
use std::time::Duration;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    // zencan's node lives in statics, so there is one of each for all benchmarks.
    let mut edskit = edskit::Edskit::new();
    let mut zencan = zencan::Zencan::new();
    sdo::benches(&mut criterion, &mut edskit, &mut zencan);
    pdo::benches(&mut criterion, &mut edskit, &mut zencan);
    look_up::benches(&mut criterion);
    generate::benches(&mut criterion);
    criterion.final_summary();
}

/// A group of benchmarks that takes a few seconds.
fn group<'a>(criterion: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = criterion.benchmark_group(name);
    group
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1500))
        .sample_size(30);
    group
}
