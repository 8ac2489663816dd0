//! What the indicators of a device show, as data (CiA 303-3 v1.4).

use crate::{Instant, Microseconds};

/// The patterns of the two indicators.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Leds {
    /// The green one: the NMT state.
    pub run: Pattern,
    /// The red one: errors.
    pub error: Pattern,
}

/// How an indicator blinks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Pattern {
    /// Dark.
    Off,
    /// Lit.
    On,
    /// 50 ms lit, 50 ms dark: LSS is configuring.
    Flickering,
    /// 200 ms lit, 200 ms dark: pre-operational.
    Blinking,
    /// One flash of 200 ms, then 1000 ms dark: stopped, or the error counters have reached a warning limit.
    SingleFlash,
    /// Two flashes: an error control event, guarding or heartbeat.
    DoubleFlash,
    /// Three flashes: the SYNC message is missing.
    TripleFlash,
    /// A pattern of the manual: lit for `lit` of every `period` milliseconds, and `offset` milliseconds later than the
    /// patterns of CiA 303-3 begin. So two indicators can be lit in turn.
    Cycle {
        /// The length of the whole, in ms; 0 stands for 1.
        period: u16,
        /// How long it is lit, in ms.
        lit: u16,
        /// How much later it begins, in ms.
        offset: u16,
    },
}

impl Pattern {
    /// Whether the indicator is lit at a time. All indicators of a device blink in step.
    ///
    /// ```
    /// use edskit_runtime::{Instant, Pattern};
    ///
    /// assert!(Pattern::Blinking.is_lit(Instant(100_000)));
    /// assert!(!Pattern::Blinking.is_lit(Instant(300_000)));
    /// ```
    #[must_use]
    pub fn is_lit(self, at: Instant) -> bool {
        match self {
            Self::Off => false,
            Self::On => true,
            Self::Flickering => at.0 % 100_000 < 50_000,
            Self::Blinking => at.0 % 400_000 < 200_000,
            Self::SingleFlash => flashes(at, 1),
            Self::DoubleFlash => flashes(at, 2),
            Self::TripleFlash => flashes(at, 3),
            Self::Cycle { period, lit, offset } => {
                let period = u64::from(period.max(1));
                // The offset goes forward by what is left of a period, so that no time is negative.
                let place = (at.0 / 1000 + period - u64::from(offset) % period) % period;
                place < u64::from(lit)
            }
        }
    }
}

/// So many flashes of 200 ms with 200 ms between them, then 1000 ms dark.
fn flashes(at: Instant, count: u64) -> bool {
    const FLASH: Microseconds = Microseconds(200_000);
    const PAUSE: Microseconds = Microseconds(1_000_000);
    let lit_part = (2 * count - 1) * FLASH.0;
    let place = at.0 % (lit_part + PAUSE.0);
    place < lit_part && (place / FLASH.0).is_multiple_of(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::String;

    fn picture(pattern: Pattern, step: u64, steps: u64) -> String {
        (0..steps).map(|place| if pattern.is_lit(Instant(place * step)) { '#' } else { '.' }).collect()
    }

    #[test]
    fn patterns() {
        assert_eq!(picture(Pattern::Flickering, 50_000, 4), "#.#.");
        assert_eq!(picture(Pattern::Blinking, 200_000, 4), "#.#.");
        assert_eq!(picture(Pattern::SingleFlash, 200_000, 8), "#.....#.");
        assert_eq!(picture(Pattern::DoubleFlash, 200_000, 9), "#.#.....#");
        assert_eq!(picture(Pattern::TripleFlash, 200_000, 11), "#.#.#.....#");
        let cycle = |offset| picture(Pattern::Cycle { period: 500, lit: 200, offset }, 100_000, 12);
        assert_eq!(cycle(0), "##...##...##");
        assert_eq!(cycle(300), "...##...##..");
        assert_eq!(cycle(1300), cycle(300));
        assert_eq!(picture(Pattern::Cycle { period: 0, lit: 0, offset: 7 }, 1000, 3), "...");
    }
}
