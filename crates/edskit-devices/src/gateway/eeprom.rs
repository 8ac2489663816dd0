//! What a start of the gateway finds in its EEPROM: 3099 EEPROMErrorCode.

use core::fmt;

/// The bits of 3099, each a page of the EEPROM that is bad (9.4; GW-APP-35).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct EepromErrors(pub u16);

/// What each bit means, and what follows from it.
const MEANINGS: [(u16, &str); 5] = [
    (0, "bootloader page bad, the gateway stays in its bootloader"),
    (3, "serial number page bad, the serial number cannot be shown"),
    (4, "error memory pages bad, the error memory was cleared"),
    (5, "parameter pages bad, the defaults are used"),
    (6, "exception page bad, an exception cannot be shown"),
];

impl EepromErrors {
    /// The number of the measured value.
    pub const NUMBER: u16 = 3099;

    /// Whether every page is good.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    const fn has(self, bit: u16) -> bool {
        self.0 >> bit & 1 == 1
    }

    /// Bit 0: the program is not started, so that there is no communication on either bus (GW-APP-48).
    #[must_use]
    pub const fn holds_in_bootloader(self) -> bool {
        self.has(0)
    }

    /// What the program finds when it starts: the bootloader's own page has been good then.
    pub(super) const fn of_program(self) -> Self {
        Self(self.0 & !1)
    }

    /// Bit 3.
    pub(super) const fn hides_serial_number(self) -> bool {
        self.has(3)
    }

    /// Bit 4.
    pub(super) const fn clears_error_memory(self) -> bool {
        self.has(4)
    }

    /// Bit 5.
    pub(super) const fn loses_parameters(self) -> bool {
        self.has(5)
    }
}

/// What every bit means: `serial number page bad, the serial number cannot be shown`.
impl fmt::Display for EepromErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        for bit in (0..16).filter(|bit| self.has(*bit)) {
            f.write_str(separator)?;
            separator = "; ";
            match MEANINGS.iter().find(|(own, _)| *own == bit) {
                Some((_, meaning)) => f.write_str(meaning)?,
                None => write!(f, "bit {bit}, which the manual does not describe")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    // GW-APP-35, GW-APP-47
    #[test]
    fn every_bit_is_said() {
        assert_eq!(EepromErrors(0).to_string(), "");
        for bit in 0..16 {
            let text = EepromErrors(1 << bit).to_string();
            let is_described = [0, 3, 4, 5, 6].contains(&bit);
            assert_eq!(text.contains("page"), is_described, "{text}");
            assert!(is_described || text.contains(&bit.to_string()), "{text}");
        }
        let both = EepromErrors(1 << 3 | 1 << 5).to_string();
        assert_eq!(both.matches(';').count(), 1);
    }
}
