//! What a hostile file may cost: memory by its size, work in proportion to it.
//!
//! An allocator counts. No test looks at a clock: where memory and the number of allocations are proportional to the
//! input for every kind of input, so is the time, or the test does not end.

use edskit_lint::{FileKind, Linter, RuleSet};
use edskit_model::Datasheet;
use edskit_tests::allocation::{self, Counted, Counting};
use edskit_tests::hostile;

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
        allocation::begin();
        let sheet = Datasheet::parse(bytes);
        linter.lint(&sheet, FileKind::of(file_name), Some(file_name));
        let Counted { allocations, peak } = allocation::counted();
        Self { allocations, peak }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;
