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
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The most memory that parsing and linting a hostile file may take, whatever it says.
const MOST_MEMORY: usize = 50_000_000;

/// How often a line, a section or a key is repeated.
const MANY: usize = 100_000;

/// How often where each is to have another number of 16 bits.
const NUMBERS: usize = 65_000;

/// The length of a line that never ends.
const LONG: usize = 1_000_000;

type Hostile = (&'static str, &'static str, usize, fn(usize) -> String);

/// Hostile files: what they are, a name with the ending that counts, and how one of a given size is made. The size is
/// a number of bytes where [`LONG`] stands, else a number of lines.
const FILES: &[Hostile] = &[
    ("one line of NUL", "a.eds", LONG, |size| object(&"\0".repeat(size))),
    ("only NUL", "a.eds", LONG, |size| "\0".repeat(size)),
    ("one line of [", "a.eds", LONG, |size| object(&"[".repeat(size))),
    ("one line of ]", "a.eds", LONG, |size| object(&"]".repeat(size))),
    ("one line of =", "a.eds", LONG, |size| object(&"=".repeat(size))),
    ("one line of ;", "a.eds", LONG, |size| object(&";".repeat(size))),
    ("a long key", "a.eds", LONG, |size| object(&format!("{}=1", "x".repeat(size)))),
    ("a long value", "a.eds", LONG, |size| object(&format!("ParameterName={}", "x".repeat(size)))),
    ("a long number", "a.eds", LONG, |size| {
        object(&format!("DataType=7\nDefaultValue={}", "1".repeat(size)))
    }),
    ("a long access type", "a.eds", LONG, |size| object(&format!("AccessType={}", "rw".repeat(size / 2)))),
    ("a long section name", "a.eds", LONG, |size| object(&format!("[{}]", "1".repeat(size)))),
    ("a long sum", "a.eds", LONG, |size| {
        object(&format!("DataType=7\nDefaultValue=$NODEID{}", "+1".repeat(size / 2)))
    }),
    ("many variables in a sum", "a.eds", LONG, |size| {
        object(&format!("DataType=7\nDefaultValue={}1", "$NODEID+".repeat(size / 8)))
    }),
    ("a line of beginnings of comments", "a.eds", LONG, |size| {
        object(&format!("DataType=7\nDefaultValue=1{}", " ;".repeat(size / 2)))
    }),
    ("lines of [", "a.eds", LONG, |size| object(&"[\n".repeat(size / 2))),
    ("lines of ]", "a.eds", LONG, |size| object(&"]\n".repeat(size / 2))),
    ("lines of =", "a.eds", LONG, |size| object(&"=\n".repeat(size / 2))),
    ("lines of blanks", "a.eds", LONG, |size| object(&" \n".repeat(size / 2))),
    ("lines of three kinds of ending", "a.eds", LONG, |size| object(&"\n\r\r\n".repeat(size / 4))),
    ("merge markers", "a.eds", MANY, |size| object(&"<<<<<<< a\n".repeat(size))),
    ("one section many times", "a.eds", MANY, |size| object(&"[1000]\n".repeat(size))),
    ("one sub-object many times", "a.eds", MANY, |size| object(&"[1018sub1]\n".repeat(size))),
    ("one unknown section many times", "a.eds", MANY, |size| object(&"[Vendor]\n".repeat(size))),
    ("one list many times", "a.eds", MANY, |size| object(&"[OptionalObjects]\n1=0x1000\n".repeat(size))),
    ("[DeviceInfo] many times", "a.eds", MANY, |size| object(&"[DeviceInfo]\nNrOfRXPDO=1\n".repeat(size))),
    ("one key many times", "a.eds", MANY, |size| object(&"ParameterName=a\n".repeat(size))),
    ("one unknown key many times", "a.eds", MANY, |size| object(&"ParamterNane=a\n".repeat(size))),
    ("many unknown sections", "a.eds", MANY, |size| {
        numbered(size, "", &|number| format!("[Vendor{number}]"))
    }),
    ("many unknown keys", "a.eds", MANY, |size| {
        numbered(size, "[1000]", &|number| format!("Vendor{number}=1"))
    }),
    ("many objects", "a.eds", NUMBERS, |size| {
        numbered(size, "", &|number| format!("[{:X}]\nParameterName=a", number))
    }),
    ("many sub-objects", "a.eds", MANY, |size| {
        numbered(size, "", &|number| {
            format!("[{:X}sub{:X}]\nParameterName=a", number >> 8 & 0xFFFF, number & 0xFF)
        })
    }),
    ("many items of objects that do not exist", "a.eds", NUMBERS, |size| {
        numbered(size, "[OptionalObjects]\nSupportedObjects=65535", &|number| {
            format!("{}=0x{:04X}", number + 1, number)
        })
    }),
    ("many items of one object", "a.eds", MANY, |size| {
        numbered(size, "[OptionalObjects]\nSupportedObjects=65535", &|number| {
            format!("{}=0x1000", number + 1)
        })
    }),
    ("many comments", "a.eds", NUMBERS, |size| {
        numbered(size, "[Comments]\nLines=65535", &|number| format!("Line{}=a", number + 1))
    }),
    ("many dummies", "a.eds", NUMBERS, |size| {
        numbered(size, "[DummyUsage]", &|number| format!("Dummy{number:04X}=1"))
    }),
    ("many links", "a.eds", MANY, |size| {
        numbered(size, "[1000ObjectLinks]\nObjectLinks=65535", &|number| format!("{}=0x1000", number + 1))
    }),
    ("many values of a compact object", "a.dcf", MANY, |size| {
        let head = "[2100]\nParameterName=a\nObjectType=8\nDataType=5\nCompactSubObj=254\n[2100Value]\nNrOfEntries=254";
        numbered(size, head, &|number| format!("{}=1", number + 1))
    }),
    ("many modules", "a.eds", NUMBERS, |size| {
        numbered(size, "[SupportedModules]\nNrOfEntries=65535", &|number| {
            format!("[M{number}ModuleInfo]\nProductName=a")
        })
    }),
    ("many fixed objects of a module", "a.eds", MANY, |size| {
        let head = "[SupportedModules]\nNrOfEntries=1\n[M1ModuleInfo]\nProductName=a\n[M1FixedObjects]\nNrOfEntries=65535";
        numbered(size, head, &|number| format!("{}=0x2000", number + 1))
    }),
    ("many connected modules", "a.dcf", MANY, |size| {
        let head = "[SupportedModules]\nNrOfEntries=1\n[M1ModuleInfo]\nProductName=a\n[ConnectedModules]\nNrOfEntries=65535";
        numbered(size, head, &|number| format!("{}=1", number + 1))
    }),
    ("many channels", "a.eds", MANY, |size| {
        numbered(size, "[DynamicChannels]\nNrOfSeg=255", &|number| format!("Type{}=0x0007", number + 1))
    }),
    ("many tools", "a.eds", NUMBERS, |size| {
        numbered(size, "[Tools]\nItems=255", &|number| format!("[Tool{number}]\nName=a"))
    }),
    ("many mapped objects", "a.eds", NUMBERS / 2, |size| {
        numbered(size, "", &|number| {
            let (pdo, sub) = (number / 64, number % 64 + 1);
            format!(
                "[{:X}sub{sub:X}]\nParameterName=a\nDataType=7\nAccessType=rw\nDefaultValue=0x20000020",
                0x1A00 + pdo
            )
        })
    }),
    ("many nodes", "nodelist.cpj", NUMBERS, |size| {
        numbered(size, "[Topology]\nNodes=0x7F", &|number| {
            format!("Node{number}Present=0x01\nNode{number}Name=a")
        })
    }),
    ("many networks", "nodelist.cpj", NUMBERS, |size| {
        numbered(size, "", &|number| format!("[Topology{number}]\nNodes=0x01\nNode1Present=0x01"))
    }),
];

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
    for &(what, name, size, make) in FILES {
        let half = Cost::of(name, make(size / 2).as_bytes());
        let whole = Cost::of(name, make(size).as_bytes());
        // A fixed part and the growth of vectors by doubling make the factor a little less or more than 2.
        let linear = half.allocations * 22 / 10 + 100;
        if whole.peak > MOST_MEMORY || whole.allocations > linear {
            failures.push(format!("{what}: {half:?} for one half, {whole:?} for all"));
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

/// A file with one object that ends with `rest`.
fn object(rest: &str) -> String {
    format!("[FileInfo]\nFileName=a.eds\n[DeviceInfo]\nVendorName=a\n[1000]\n{rest}\n")
}

/// `head` and as many lines as `size` says, each with another number.
fn numbered(size: usize, head: &str, line: &dyn Fn(usize) -> String) -> String {
    let mut text = format!("[FileInfo]\nFileName=a.eds\n{head}\n");
    for number in 0..size {
        text.push_str(&line(number));
        text.push('\n');
    }
    text
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
