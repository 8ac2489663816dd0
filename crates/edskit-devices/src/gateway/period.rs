//! Times in units of main cycles.

/// The main cycle of a unit, which all its times are multiples of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MainCycle {
    /// How long it is, in µs.
    pub micros: u32,
    /// The most cycles that a time can have.
    pub most: u16,
}

impl MainCycle {
    /// The governor's: 15.625 ms, times up to 255 cycles (4.1.2, 7.1.3; GW-TIMING-02, GW-TIMING-03).
    pub const GOVERNOR: MainCycle = MainCycle { micros: 15_625, most: 255 };
    /// The gateway's: 16 ms, times up to 4095 cycles (7.2.3; GW-TIMING-12).
    pub const GATEWAY: MainCycle = MainCycle { micros: 16_000, most: 4095 };

    /// The time that a setting in ms gives: the whole cycles in it, at least one. `None` for 0, which switches off
    /// (7.1.3, 7.1.5, 7.2.3; GW-TIMING-05, GW-TIMING-10, GW-TIMING-12).
    ///
    /// One cycle is also what a setting of 15 ms gives, which the manual's formula leaves out (GW-NOTE-06). A setting
    /// beyond the longest time gives the longest time (GW-NOTE-08).
    ///
    /// ```
    /// use edskit_devices::gateway::MainCycle;
    /// let period = MainCycle::GOVERNOR.period(200).unwrap();
    /// assert_eq!((period.cycles, period.micros()), (12, 187_500));
    /// ```
    #[must_use]
    pub const fn period(self, setting_ms: u16) -> Option<Period> {
        if setting_ms == 0 {
            return None;
        }
        let whole = setting_ms as u32 * 1000 / self.micros;
        let cycles = match whole {
            0 => 1,
            n if n > self.most as u32 => self.most,
            n => n as u16,
        };
        Some(Period { setting_ms, cycles, cycle: self, is_capped: whole > self.most as u32 })
    }
}

/// A time as it is set and as it takes effect.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Period {
    /// The setting, in ms.
    pub setting_ms: u16,
    /// How many main cycles it lasts.
    pub cycles: u16,
    /// The main cycle.
    pub cycle: MainCycle,
    /// Whether the setting is longer than the longest time.
    pub is_capped: bool,
}

impl Period {
    /// How long it lasts, in µs.
    #[must_use]
    pub const fn micros(self) -> u32 {
        self.cycles as u32 * self.cycle.micros
    }
}
