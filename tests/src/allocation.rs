//! An allocator that counts: what it costs in memory to do something.
#![allow(
    unsafe_code,
    reason = "a global allocator is unsafe by its trait; this one counts and leaves the work to the system"
)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The allocator; a test that counts makes it the global one:
///
/// ```
/// use edskit_tests::allocation::{self, Counting};
///
/// #[global_allocator]
/// static ALLOCATOR: Counting = Counting;
///
/// # fn main() {
/// allocation::begin();
/// let bytes = vec![0_u8; 100];
/// assert_eq!((allocation::counted().allocations, allocation::counted().peak), (1, 100));
/// # drop(bytes);
/// # }
/// ```
pub struct Counting;

/// What was counted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Counted {
    /// How often memory was asked for.
    pub allocations: usize,
    /// The most memory at one time.
    pub peak: usize,
}

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

/// Counts from nothing again, for this thread.
pub fn begin() {
    COUNTERS.set(Counters { allocations: 0, bytes: 0, peak: 0 });
}

/// What this thread has allocated since [`begin`].
#[must_use]
pub fn counted() -> Counted {
    let Counters { allocations, peak, .. } = COUNTERS.get();
    Counted { allocations, peak: peak.unsigned_abs() }
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
