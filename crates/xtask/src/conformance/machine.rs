//! How steadily the machine runs that a check measures times on.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// How long an observer sleeps. What is shorter disturbs no check.
const STEP: Duration = Duration::from_millis(1);

/// Does something, and says also by how much the machine was late meanwhile at most: a virtual machine can stand still for
/// tenths of a second, and then every process on it is late, the node and the check alike.
pub(super) fn observed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let is_over = AtomicBool::new(false);
    let latest = AtomicU64::new(0);
    let observe = || {
        while !is_over.load(Ordering::Relaxed) {
            let start = Instant::now();
            thread::sleep(STEP);
            let late = start.elapsed().saturating_sub(STEP);
            latest.fetch_max(u64::try_from(late.as_micros()).unwrap_or(u64::MAX), Ordering::Relaxed);
        }
    };
    let result = thread::scope(|scope| {
        // One for each processor, since they can stand still one by one.
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(observe);
        }
        let result = work();
        is_over.store(true, Ordering::Relaxed);
        result
    });
    (result, Duration::from_micros(latest.into_inner()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lateness_of_sleeps_is_told_with_the_result() {
        let (result, late) = observed(|| {
            thread::sleep(Duration::from_millis(20));
            7
        });
        assert_eq!(result, 7);
        assert!(late > Duration::ZERO, "no sleep ends exactly on time");
    }
}
