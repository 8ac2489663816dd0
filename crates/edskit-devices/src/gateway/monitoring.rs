//! Monitoring in main cycles: of RPDOs by the governor, of the partner's heartbeat by the gateway.

use super::period::Period;
use edskit_runtime::{Instant, Microseconds};

/// Monitors that something arrives in time.
///
/// It looks once per main cycle: the time is over in the first one that is as long as the effective time, or longer, behind
/// the last arrival or the begin (7.1.5, 7.2.3; GW-TIMING-10, GW-TIMING-12).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Monitoring {
    /// The last arrival, or the begin.
    since: Instant,
    has_ever_arrived: bool,
    is_triggered: bool,
}

impl Monitoring {
    /// The monitoring begins.
    pub(super) fn begun(now: Instant) -> Self {
        Self { since: now, ..Self::default() }
    }

    /// Something has arrived.
    pub(super) fn arrived(&mut self, now: Instant) {
        self.since = now;
        self.has_ever_arrived = true;
    }

    /// A main cycle passes; `None` switches the monitoring off.
    pub(super) fn main_cycle(&mut self, now: Instant, period: Option<Period>) {
        let is_over = |period: Period| now.since(self.since) >= Microseconds(period.micros().into());
        self.is_triggered = period.is_some_and(is_over);
    }

    /// Whether the time is over.
    pub(super) fn is_triggered(self) -> bool {
        self.is_triggered
    }

    /// Whether anything has arrived since the monitoring began.
    pub(super) fn has_ever_arrived(self) -> bool {
        self.has_ever_arrived
    }
}

#[cfg(test)]
mod tests {
    use super::super::period::MainCycle;
    use super::*;

    /// A main cycle of the governor.
    const CYCLE: u64 = 15_625;

    // GW-TIMING-11, GW-APP-08
    #[test]
    fn it_triggers_in_time_and_clears_itself() {
        let period = MainCycle::GOVERNOR.period(100);
        // It begins, and something arrives, at any time between two main cycles.
        for offset in [0, 1, 7_000, 15_624] {
            let mut monitoring = Monitoring::begun(Instant(offset));
            let triggered_at = |monitoring: &mut Monitoring, from: u64| {
                (from..from + 20).find(|cycle| {
                    monitoring.main_cycle(Instant(cycle * CYCLE), period);
                    monitoring.is_triggered()
                })
            };
            let first = if offset == 0 { 6 } else { 7 };
            assert_eq!(triggered_at(&mut monitoring, 1), Some(first), "93.75 ms are 6 cycles");
            monitoring.arrived(Instant(30 * CYCLE + offset));
            assert_eq!(triggered_at(&mut monitoring, 31), Some(30 + first));
            assert!(monitoring.has_ever_arrived());
        }
    }

    // GW-TIMING-09, GW-HB-04
    #[test]
    fn without_a_time_it_never_triggers() {
        let mut monitoring = Monitoring::begun(Instant(0));
        monitoring.main_cycle(Instant(u64::MAX), None);
        assert!(!monitoring.is_triggered() && !monitoring.has_ever_arrived());
    }
}
