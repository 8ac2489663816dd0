//! Time, as the caller tells it.

use core::ops::Add;

/// A point in time: microseconds since any start that the caller likes. It never goes back.
///
/// ```
/// use edskit_runtime::{Instant, Microseconds};
///
/// let start = Instant(1_000);
/// let later = start + Microseconds::from_milliseconds(2);
/// assert_eq!(later, Instant(3_000));
/// assert_eq!(later.since(start), Microseconds(2_000));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Instant(
    /// Microseconds since the start.
    pub u64,
);

impl Instant {
    /// The end of time: nothing is due.
    pub const NEVER: Self = Self(u64::MAX);

    /// How long ago `earlier` was; 0 where it is later.
    #[must_use]
    pub const fn since(self, earlier: Self) -> Microseconds {
        Microseconds(self.0.saturating_sub(earlier.0))
    }
}

impl Add<Microseconds> for Instant {
    type Output = Self;

    fn add(self, duration: Microseconds) -> Self {
        Self(self.0.saturating_add(duration.0))
    }
}

/// A length of time in microseconds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Microseconds(
    /// How many.
    pub u64,
);

impl Microseconds {
    /// Milliseconds, the unit of 1017h, 1016h, 100Ch and event timers.
    #[must_use]
    pub const fn from_milliseconds(milliseconds: u32) -> Self {
        Self(milliseconds as u64 * 1000)
    }

    /// Multiples of 100 microseconds, the unit of inhibit times.
    #[must_use]
    pub const fn from_inhibit_time(multiples: u16) -> Self {
        Self(multiples as u64 * 100)
    }
}

/// A timer: off, or due at some time.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Timer(Instant);

impl Timer {
    pub(crate) const OFF: Self = Self(Instant::NEVER);

    /// Due from a time on.
    pub(crate) const fn at(time: Instant) -> Self {
        Self(time)
    }

    /// Due after `duration`; off where that is 0.
    #[inline(never)]
    pub(crate) fn after(now: Instant, duration: Microseconds) -> Self {
        if duration.0 == 0 { Self::OFF } else { Self(now + duration) }
    }

    pub(crate) fn is_running(self) -> bool {
        self != Self::OFF
    }

    /// Whether it is due at a time; that of a timer that is off, the end of time, never comes.
    pub(crate) fn is_due(self, now: Instant) -> bool {
        self.0 <= now
    }

    /// When it is due; never where it is off.
    pub(crate) fn deadline(self) -> Instant {
        self.0
    }

    /// The next time of a cycle that this timer began: late calls do not make the cycle longer. Where whole cycles were
    /// missed, it goes on from now.
    pub(crate) fn again(self, now: Instant, period: Microseconds) -> Self {
        if period.0 == 0 {
            return Self::OFF;
        }
        let next = self.0 + period;
        if next > now { Self(next) } else { Self::after(now, period) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_timer_is_due_from_its_time_on() {
        let timer = Timer::after(Instant(10), Microseconds(5));
        assert!(!timer.is_due(Instant(14)) && timer.is_due(Instant(15)) && timer.is_due(Instant(99)));
        assert!(!Timer::after(Instant(10), Microseconds(0)).is_running());
        assert!(!Timer::OFF.is_due(Instant(u64::MAX - 1)));
    }

    #[test]
    fn a_late_call_does_not_shift_the_cycle() {
        let timer = Timer::after(Instant(0), Microseconds(100));
        assert_eq!(timer.again(Instant(103), Microseconds(100)).deadline(), Instant(200));
        assert_eq!(timer.again(Instant(1_000), Microseconds(100)).deadline(), Instant(1_100));
    }

    #[test]
    fn units() {
        assert_eq!(Microseconds::from_inhibit_time(u16::MAX), Microseconds(6_553_500));
        assert_eq!(Instant(5).since(Instant(9)), Microseconds(0));
        assert_eq!(Instant(u64::MAX) + Microseconds(1), Instant::NEVER);
    }
}
