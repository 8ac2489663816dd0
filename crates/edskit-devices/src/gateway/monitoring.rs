//! Monitoring in main cycles: of RPDOs by the governor, of the partner's heartbeat by the gateway.

use super::period::Period;

/// Monitors that something arrives within a number of main cycles.
///
/// It looks once per main cycle. The time runs from the cycle that has seen the last arrival, or in which the monitoring
/// began, and is over after as many cycles as the setting gives (7.1.5, 7.2.3; GW-TIMING-10, GW-TIMING-12).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Monitoring {
    cycles_without: u16,
    has_arrived: bool,
    has_ever_arrived: bool,
    is_triggered: bool,
}

impl Monitoring {
    /// Something has arrived.
    pub(super) fn arrived(&mut self) {
        self.has_arrived = true;
        self.has_ever_arrived = true;
    }

    /// A main cycle passes; `None` switches the monitoring off.
    pub(super) fn main_cycle(&mut self, period: Option<Period>) {
        if core::mem::take(&mut self.has_arrived) {
            self.cycles_without = 0;
            self.is_triggered = false;
            return;
        }
        let Some(period) = period else { return };
        self.cycles_without = self.cycles_without.saturating_add(1);
        self.is_triggered |= self.cycles_without >= period.cycles;
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

    // GW-TIMING-11, GW-APP-08
    #[test]
    fn it_triggers_after_its_cycles_and_clears_itself() {
        let mut monitoring = Monitoring::default();
        let period = MainCycle::GOVERNOR.period(100);
        let triggered = |monitoring: &mut Monitoring, cycles: u16| {
            (0..cycles).for_each(|_| monitoring.main_cycle(period));
            monitoring.is_triggered()
        };
        assert!(!triggered(&mut monitoring, 5) && triggered(&mut monitoring, 1), "6 cycles of 15.625 ms");
        monitoring.arrived();
        assert!(!triggered(&mut monitoring, 1 + 5) && triggered(&mut monitoring, 1));
        monitoring.arrived();
        assert!(!triggered(&mut monitoring, 1));
        assert!(monitoring.has_ever_arrived());
    }

    // GW-TIMING-09, GW-HB-04
    #[test]
    fn without_a_time_it_never_triggers() {
        let mut monitoring = Monitoring::default();
        (0..u32::from(u16::MAX) + 9).for_each(|_| monitoring.main_cycle(None));
        assert!(!monitoring.is_triggered() && !monitoring.has_ever_arrived());
    }
}
