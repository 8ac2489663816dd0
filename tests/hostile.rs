//! What a hostile file may cost: memory by its size, work in proportion to it.
//!
//! An allocator counts. No test looks at a clock: where memory and the number of allocations are proportional to the
//! input for every kind of input, so is the time, or the test does not end.
#![allow(
    unsafe_code,
    reason = "a global allocator is unsafe by its trait; this one counts and leaves the work to the system"
)]

use edskit_lint::{FileKind, Linter, RuleSet};
use edskit_model::Datasheet;
use edskit_tests::hostile;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The most memory that parsing and linting a hostile file may take, whatever it says.
const MOST_MEMORY: usize = 50_000_000;

/// Ten lines that claim 65,535 objects with 254 sub-objects each, and all the PDOs that there can be.
const CLAIMS: &str = "\
[DeviceInfo]
NrOfRXPDO=65535
CompactPDO=255
[OptionalObjects]
SupportedObjects=65535
[2100]
ObjectType=8
CompactSubObj=254
[2100Value]
NrOfEntries=254
";

#[test]
fn claims_cost_nothing() {
    let cost = Cost::of("a.dcf", CLAIMS.as_bytes());
    assert!(cost.peak < 100_000, "{cost:?}");
}

#[test]
fn no_hostile_file_takes_much_memory_or_more_work_than_its_size() {
    let mut failures = Vec::new();
    for hostile in hostile::ALL {
        let half = Cost::of(hostile.name, hostile.text(2).as_bytes());
        let whole = Cost::of(hostile.name, hostile.text(1).as_bytes());
        // A fixed part and the growth of vectors by doubling make the factor a little less or more than 2.
        let linear = half.allocations * 22 / 10 + 100;
        if whole.peak > MOST_MEMORY || whole.allocations > linear {
            failures.push(format!("{}: {half:?} for one half, {whole:?} for all", hostile.what));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn real_files_take_memory_in_proportion_to_their_size() {
    let Some(corpus) = edskit_tests::corpus("the memory that real files take") else { return };
    for file in &corpus {
        let cost = Cost::of(&file.name, &file.bytes);
        assert!(cost.peak <= 20 * file.bytes.len() + 10_000_000, "{}: {cost:?}", file.name);
    }
}

/// What parsing and linting a file cost.
#[derive(Clone, Copy, Debug)]
struct Cost {
    /// How often memory was asked for.
    allocations: usize,
    /// The most memory at one time, without the file itself.
    peak: usize,
}

impl Cost {
    fn of(file_name: &str, bytes: &[u8]) -> Self {
        let linter = Linter::new(RuleSet::all());
        // The first file of a process also pays for reading the profiles of CiA.
        linter.lint(&Datasheet::parse(b"[1000]\n"), FileKind::Eds, None);
        COUNTERS.set(Counters { allocations: 0, bytes: 0, peak: 0 });
        let sheet = Datasheet::parse(bytes);
        linter.lint(&sheet, FileKind::of(file_name), Some(file_name));
        let Counters { allocations, peak, .. } = COUNTERS.get();
        Self { allocations, peak: peak.unsigned_abs() }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

struct Counting;

/// What one thread has allocated.
#[derive(Clone, Copy)]
struct Counters {
    allocations: usize,
    /// May go below zero where another thread allocated what this one frees.
    bytes: isize,
    peak: isize,
}

thread_local! {
    static COUNTERS: Cell<Counters> = const { Cell::new(Counters { allocations: 0, bytes: 0, peak: 0 }) };
}

fn count(allocated: usize, freed: usize) {
    let mut counters = COUNTERS.get();
    counters.allocations += usize::from(allocated > 0);
    counters.bytes += allocated as isize - freed as isize;
    counters.peak = counters.peak.max(counters.bytes);
    COUNTERS.set(counters);
}

// SAFETY: every call goes to the system's allocator unchanged. The counters are of this thread, need no destructor and
// allocate nothing.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size(), 0);
        // SAFETY: what the caller guarantees.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(0, layout.size());
        // SAFETY: what the caller guarantees.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size(), 0);
        // SAFETY: what the caller guarantees.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // Old and new block exist at the same time while one is copied to the other.
        count(size, 0);
        count(0, layout.size());
        // SAFETY: what the caller guarantees.
        unsafe { System.realloc(pointer, layout, size) }
    }
}
