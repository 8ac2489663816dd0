//! A node is given millions of frames, most of which want something of it, and some of which are noise.

mod frames;
mod harness;
mod identifiers;
mod nmt;
mod scripts;

use edskit_codegen::Layout;
use edskit_runtime::Frame;
use edskit_types::CanId;
use harness::Harness;
use std::thread;

/// How many frames a run has.
const FRAMES: u32 = 200_000;

/// Each gives a run of its own.
const SEEDS: [u64; 10] = [1, 2, 3, 5, 8, 13, 21, 34, 55, 89];

#[test]
fn no_frames_harm_the_node_of_the_conformance_check() {
    let Some(shared) = edskit_tests::shared("the device of the conformance check") else { return };
    survives_every_seed(&crate::layout_of(&shared.join("conformance/full.eds")));
}

#[test]
fn no_frames_harm_a_node_with_every_service() {
    survives_every_seed(&crate::everything());
}

fn survives_every_seed(layout: &Layout) {
    let failures: Vec<String> = thread::scope(|scope| {
        let runs = SEEDS.map(|seed| (seed, scope.spawn(move || run(layout, seed))));
        let outcome = |(seed, run): (u64, thread::ScopedJoinHandle<'_, Result<(), String>>)| {
            let failure = run.join().unwrap_or_else(|_| Err("the node has panicked".to_owned())).err()?;
            Some(format!("seed {seed}: {failure}"))
        };
        runs.into_iter().filter_map(outcome).collect()
    });
    assert!(failures.is_empty(), "{failures:#?}");
}

fn frame(can_id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(can_id).expect("it has eleven bits"), data)
}

/// One run; afterwards the node answers as if nothing had happened, and once more after a power cycle with what was
/// stored meanwhile.
fn run(layout: &Layout, seed: u64) -> Result<(), String> {
    let mut storage = edskit_host::MemoryStorage::default();
    let mut harness = Harness::new(layout, &mut storage, seed);
    harness.power_on()?;
    for number in 0..FRAMES {
        harness.step().map_err(|problem| format!("frame {number}: {problem}"))?;
    }
    let reached = harness.reached();
    if !reached.is_far() {
        return Err(format!("the frames did not get far: {reached:?}"));
    }
    harness.come_back()?;
    let mut harness = Harness::new(layout, &mut storage, seed);
    harness.power_on()?;
    harness.come_back()
}
