//! SDO transfers over a bus that loses frames, doubles them and is late.

use crate::everything;
use crate::line::Line;
use edskit_codegen::Layout;
use edskit_host::sdo::{SdoClient, SdoError, SdoMode};
use edskit_host::{Bus, Delay, Duplication, Loss};
use edskit_runtime::Microseconds;
use edskit_types::{Index, NodeId, SubIndex};
use fastrand::Rng;

/// Each gives other losses at other places.
const SEEDS: [u64; 4] = [1, 2, 3, 4];
/// How many values are written and read again with each seed.
const VALUES: usize = 200;
const LOSS: f64 = 0.05;
const DUPLICATION: f64 = 0.05;
const JITTER: Microseconds = Microseconds::from_milliseconds(50);
const TIME_OUT: Microseconds = Microseconds::from_milliseconds(1000);
/// No transfer here takes longer, whatever happens to it: most have few frames, and each may be late by its jitter.
const LONGEST: Microseconds = Microseconds::from_milliseconds(60_000);

const TEXT: Index = Index(0x2002);
const KEY: Index = Index(0x2003);
const OUTPUTS: Index = Index(0x2000);
const FILE: Index = Index(0x2008);

/// What is written and read.
struct Value {
    index: Index,
    sub_index: SubIndex,
    bytes: Vec<u8>,
    mode: SdoMode,
}

impl Value {
    fn random(random: &mut Rng) -> Self {
        let (index, sub_index, length, modes) = match random.u8(0..6) {
            0 => (OUTPUTS, 1, 4, &[SdoMode::Expedited, SdoMode::Segmented, SdoMode::Block][..]),
            1 => (OUTPUTS, 2, 2, &[SdoMode::Expedited, SdoMode::Segmented][..]),
            2 => (KEY, 0, random.usize(1..=16), &[SdoMode::Segmented, SdoMode::Block][..]),
            3 => (TEXT, 0, random.usize(1..=200), &[SdoMode::Segmented, SdoMode::Block][..]),
            4 => (
                FILE,
                0,
                random.usize(1..=300),
                &[SdoMode::Segmented, SdoMode::Block, SdoMode::Automatic][..],
            ),
            _ => (FILE, 0, random.usize(900..=3000), &[SdoMode::Block, SdoMode::Automatic][..]),
        };
        let bytes = (0..length).map(|_| random.u8(..)).collect();
        let mode = random.choice(modes).copied().unwrap_or_default();
        Self { index, sub_index: SubIndex(sub_index), bytes, mode }
    }
}

/// How the transfers of a run ended.
#[derive(Default, Debug)]
struct Tally {
    succeeded: usize,
    failed: usize,
}

#[test]
fn every_transfer_ends_and_the_node_recovers() {
    let layout = everything();
    for seed in SEEDS {
        let bad = run(&layout, seed, LOSS, DUPLICATION);
        assert!(bad.succeeded > VALUES / 4 && bad.failed > VALUES / 10, "seed {seed}: {bad:?}");
    }
}

#[test]
fn a_bus_that_is_only_late_fails_nothing() {
    let layout = everything();
    for seed in SEEDS {
        let late = run(&layout, seed, 0.0, 0.0);
        assert_eq!(late.failed, 0, "seed {seed}: {late:?}");
    }
}

/// Transfers over a bad bus, then the same ones over a good bus to the same node.
fn run(layout: &Layout, seed: u64, loss: f64, duplication: f64) -> Tally {
    let node_id = NodeId::new(5).expect("5 is a node-ID");
    let mut line = Line::new(layout, node_id);
    let mut random = Rng::with_seed(seed);
    let values: Vec<Value> = (0..VALUES).map(|_| Value::random(&mut random)).collect();
    let mut tally = Tally::default();
    {
        let lossy = Loss::new(&mut line, loss, seed);
        let doubling = Duplication::new(lossy, duplication, seed + 1000);
        let mut bad = Delay::new(doubling, Microseconds(0), JITTER, seed + 2000);
        for value in &values {
            match exchange(&mut bad, node_id, value) {
                Ok(read) => {
                    assert_eq!(read, value.bytes, "seed {seed}: {:?} in {:?}", value.index, value.mode);
                    tally.succeeded += 1;
                }
                Err(_) => tally.failed += 1,
            }
        }
    }
    // What the node still waits for ends by itself.
    let later = line.now() + TIME_OUT + TIME_OUT;
    while line.now() < later {
        line.wait(later).expect("a virtual bus stays");
    }
    while line.receive().expect("a virtual bus stays").is_some() {}
    for value in &values {
        match exchange(&mut line, node_id, value) {
            Ok(read) => assert_eq!(read, value.bytes, "seed {seed}, afterwards: {:?}", value.index),
            Err(error) => panic!("seed {seed}, afterwards: {:?} in {:?}: {error}", value.index, value.mode),
        }
    }
    tally
}

/// Writes a value and reads it again, each within bounded time.
fn exchange(bus: &mut impl Bus, node_id: NodeId, value: &Value) -> Result<Vec<u8>, SdoError> {
    let client = SdoClient::new(node_id).mode(value.mode).time_out(TIME_OUT);
    let start = bus.now();
    let written = client.write(bus, value.index, value.sub_index, &value.bytes);
    assert!(bus.now() < start + LONGEST, "a write takes too long");
    written?;
    let start = bus.now();
    let read = client.read(bus, value.index, value.sub_index);
    assert!(bus.now() < start + LONGEST, "a read takes too long");
    read.map(|value| value.bytes)
}
