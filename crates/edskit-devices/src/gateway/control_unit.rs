//! A control unit: its supply, its start and its main cycles.

use edskit_runtime::{Instant, Microseconds};

/// How long the tests of the bootloader and the start of the program take: no communication until then (9.3;
/// GW-TIMING-15).
const START: Microseconds = Microseconds::from_milliseconds(200);
/// So many main cycles are made up for when the device was not called in time; more are left out.
const MOST_LATE: u64 = 16;

/// One of the two control units, in time.
#[derive(Clone, Debug)]
pub(super) struct ControlUnit {
    main_cycle: Microseconds,
    power: Power,
    /// Since when it has worked.
    started: Instant,
    /// Whether it has not taken part in an initialisation since its start.
    pub(super) is_fresh: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Power {
    Off,
    /// The bootloader does not start the program.
    Held,
    /// Works from then on.
    Starting(Instant),
    /// The next main cycle.
    On(Instant),
}

/// What a unit does next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// It begins to work.
    Start,
    /// One main cycle.
    MainCycle,
}

impl ControlUnit {
    /// A unit without supply.
    pub(super) fn new(micros: u32) -> Self {
        let main_cycle = Microseconds(micros.into());
        Self { main_cycle, power: Power::Off, started: Instant(0), is_fresh: false }
    }

    pub(super) fn switch_on(&mut self, now: Instant) {
        self.power = Power::Starting(now + START);
    }

    pub(super) fn switch_off(&mut self) {
        self.power = Power::Off;
    }

    /// The bootloader keeps the program from starting.
    pub(super) fn hold(&mut self) {
        self.power = Power::Held;
    }

    /// Whether its program runs.
    pub(super) fn is_on(&self) -> bool {
        matches!(self.power, Power::On(_))
    }

    /// Whether its program is kept from starting.
    pub(super) fn is_held(&self) -> bool {
        self.power == Power::Held
    }

    /// Whether it has its supply.
    pub(super) fn is_powered(&self) -> bool {
        self.power != Power::Off
    }

    /// How long its program has run.
    pub(super) fn age(&self, now: Instant) -> Microseconds {
        now.since(self.started)
    }

    /// When it has something to do.
    pub(super) fn next(&self) -> Instant {
        match self.power {
            Power::Off | Power::Held => Instant::NEVER,
            Power::Starting(next) | Power::On(next) => next,
        }
    }

    /// What is due at `now`, and when it was due.
    pub(super) fn step(&mut self, now: Instant) -> Option<Step> {
        let due = self.next();
        if due > now {
            return None;
        }
        let missed = now.since(due).0 / self.main_cycle.0.max(1);
        let late =
            if missed > MOST_LATE { Microseconds(missed * self.main_cycle.0) } else { Microseconds(0) };
        let is_start = !self.is_on();
        self.power = Power::On(due + late + self.main_cycle);
        if is_start {
            self.started = due;
            self.is_fresh = true;
            return Some(Step::Start);
        }
        Some(Step::MainCycle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // GW-TIMING-15, GW-TIMING-03
    #[test]
    fn a_start_takes_200_ms_and_main_cycles_follow() {
        let mut unit = ControlUnit::new(15_625);
        assert_eq!((unit.next(), unit.is_powered()), (Instant::NEVER, false));
        unit.switch_on(Instant(1_000));
        assert_eq!(unit.step(Instant(200_999)), None);
        assert_eq!((unit.step(Instant(201_000)), unit.is_on()), (Some(Step::Start), true));
        assert_eq!(unit.next(), Instant(216_625));
        assert_eq!(unit.step(Instant(216_625)), Some(Step::MainCycle));
        assert_eq!(unit.next(), Instant(232_250));
        assert_eq!(unit.age(Instant(301_000)), Microseconds(100_000));
        unit.switch_off();
        assert_eq!(unit.step(Instant(900_000)), None);
    }

    #[test]
    fn a_late_call_makes_up_for_some_cycles_only() {
        let mut unit = ControlUnit::new(16_000);
        unit.switch_on(Instant(0));
        unit.step(Instant(200_000));
        let cycles = |unit: &mut ControlUnit, now| std::iter::from_fn(|| unit.step(now)).count();
        assert_eq!(cycles(&mut unit, Instant(216_000 + 9 * 16_000)), 10);
        let after_a_day = Instant(86_400_000_000);
        assert_eq!(cycles(&mut unit, after_a_day), 1);
        assert!(unit.next() > after_a_day);
        assert_eq!((unit.next().0 - 200_000) % 16_000, 0, "the cycles stay where they were");
    }
}
