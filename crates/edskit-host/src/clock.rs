//! The time of buses that are not simulated.

use edskit_runtime::Instant;
use std::sync::OnceLock;
use std::time::{Duration, Instant as Steady, SystemTime, UNIX_EPOCH};

/// Microseconds since 1970-01-01 00:00 UTC. The calendar is asked once in the life of the process, after that a steady
/// clock counts: the time never goes back, and all buses of the process have the same.
#[must_use]
pub fn system_now() -> Instant {
    static START: OnceLock<(Steady, u64)> = OnceLock::new();
    let (steady, calendar) = START.get_or_init(|| {
        // A calendar before 1970 is wrong anyway; time then begins at 0.
        let calendar = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        (Steady::now(), microseconds(calendar))
    });
    Instant(calendar.saturating_add(microseconds(steady.elapsed())))
}

/// How long it is until `deadline`; `None` for ever.
pub(crate) fn time_until(deadline: Instant) -> Option<Duration> {
    (deadline != Instant::NEVER).then(|| Duration::from_micros(deadline.since(system_now()).0))
}

fn microseconds(duration: Duration) -> u64 {
    u64::try_from(duration.as_micros()).unwrap_or(u64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_is_the_calendar_and_does_not_go_back() {
        let first = system_now();
        // 2020-01-01.
        assert!(first > Instant(1_577_836_800_000_000));
        assert!(system_now() >= first);
    }

    #[test]
    fn a_deadline_that_has_passed_is_due_now() {
        assert_eq!(time_until(Instant(0)), Some(Duration::ZERO));
        assert_eq!(time_until(Instant::NEVER), None);
    }
}
