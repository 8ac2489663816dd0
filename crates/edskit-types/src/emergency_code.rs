//! What an emergency message says.

use core::fmt;

/// Emergency error code: the first two bytes of an EMCY message (CiA 301 v4.2, 7.2.7.1).
///
/// Every `u16` is a code: device profiles and manufacturers define their own within the classes of CiA 301.
///
/// ```
/// use edskit_types::EmergencyCode;
///
/// assert_eq!(EmergencyCode(0x8130).meaning(), Some("life guard error or heartbeat error"));
/// assert_eq!(EmergencyCode(0x4217).meaning(), Some("device temperature"));
/// assert_eq!(EmergencyCode(0x8130).to_string(), "8130h: life guard error or heartbeat error");
/// assert!(EmergencyCode(0x0000).is_reset());
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EmergencyCode(pub u16);

macro_rules! codes {
    ($($(#[$doc:meta])* $name:ident $code:literal)*) => {
        $($(#[$doc])* pub const $name: Self = Self($code);)*
    };
}

impl EmergencyCode {
    codes! {
        /// 1000h: generic error.
        GENERIC 0x1000
        /// 2000h: current.
        CURRENT 0x2000
        /// 2100h: current, input side of the device.
        INPUT_CURRENT 0x2100
        /// 2200h: current inside the device.
        DEVICE_CURRENT 0x2200
        /// 2300h: current, output side of the device.
        OUTPUT_CURRENT 0x2300
        /// 3000h: voltage.
        VOLTAGE 0x3000
        /// 3100h: mains voltage.
        MAINS_VOLTAGE 0x3100
        /// 3200h: voltage inside the device.
        DEVICE_VOLTAGE 0x3200
        /// 3300h: output voltage.
        OUTPUT_VOLTAGE 0x3300
        /// 4000h: temperature.
        TEMPERATURE 0x4000
        /// 4100h: ambient temperature.
        AMBIENT_TEMPERATURE 0x4100
        /// 4200h: device temperature.
        DEVICE_TEMPERATURE 0x4200
        /// 5000h: device hardware.
        HARDWARE 0x5000
        /// 6000h: device software.
        SOFTWARE 0x6000
        /// 6100h: internal software.
        INTERNAL_SOFTWARE 0x6100
        /// 6200h: user software.
        USER_SOFTWARE 0x6200
        /// 6300h: data set.
        DATA_SET 0x6300
        /// 7000h: additional modules.
        ADDITIONAL_MODULES 0x7000
        /// 8000h: monitoring.
        MONITORING 0x8000
        /// 8100h: communication.
        COMMUNICATION 0x8100
        /// 8110h: CAN overrun, objects lost.
        CAN_OVERRUN 0x8110
        /// 8120h: CAN in error passive mode.
        ERROR_PASSIVE 0x8120
        /// 8130h: life guard error or heartbeat error.
        HEARTBEAT 0x8130
        /// 8140h: recovered from bus-off.
        BUS_OFF_RECOVERED 0x8140
        /// 8150h: CAN-ID collision.
        CAN_ID_COLLISION 0x8150
        /// 8200h: protocol error.
        PROTOCOL 0x8200
        /// 8210h: PDO not processed because of its length.
        PDO_LENGTH 0x8210
        /// 8220h: PDO length exceeded.
        PDO_LENGTH_EXCEEDED 0x8220
        /// 8230h: destination object of a DAM-MPDO not available.
        MPDO_DESTINATION 0x8230
        /// 8240h: unexpected SYNC data length.
        SYNC_LENGTH 0x8240
        /// 8250h: RPDO time-out.
        RPDO_TIME_OUT 0x8250
        /// 9000h: external error.
        EXTERNAL 0x9000
        /// F000h: additional functions.
        ADDITIONAL_FUNCTIONS 0xF000
        /// FF00h: device specific.
        DEVICE_SPECIFIC 0xFF00
    }

    /// The code of this class with another low byte, which device profiles and manufacturers define.
    ///
    /// ```
    /// use edskit_types::EmergencyCode;
    ///
    /// assert_eq!(EmergencyCode::DEVICE_TEMPERATURE.with(0x10), EmergencyCode(0x4210));
    /// ```
    #[must_use]
    pub const fn with(self, low: u8) -> Self {
        Self(self.0 & 0xFF00 | low as u16)
    }

    /// Whether an error has gone: the high byte is 00h.
    #[must_use]
    pub const fn is_reset(self) -> bool {
        self.0 >> 8 == 0
    }

    /// What the standard says about the code: about exactly this one, else about its class (the high byte), else about its
    /// group (the highest digit). `None` for what it reserves.
    #[must_use]
    pub const fn meaning(self) -> Option<&'static str> {
        let exact = match self.0 {
            0x8110 => "CAN overrun, objects lost",
            0x8120 => "CAN in error passive mode",
            0x8130 => "life guard error or heartbeat error",
            0x8140 => "recovered from bus-off",
            0x8150 => "CAN-ID collision",
            0x8210 => "PDO not processed because of its length",
            0x8220 => "PDO length exceeded",
            0x8230 => "destination object of a DAM-MPDO not available",
            0x8240 => "unexpected SYNC data length",
            0x8250 => "RPDO time-out",
            _ => "",
        };
        if !exact.is_empty() {
            return Some(exact);
        }
        Some(match self.0 >> 8 {
            0x00 => "error reset or no error",
            0x10 => "generic error",
            0x20 => "current",
            0x21 => "current, input side of the device",
            0x22 => "current inside the device",
            0x23 => "current, output side of the device",
            0x30 => "voltage",
            0x31 => "mains voltage",
            0x32 => "voltage inside the device",
            0x33 => "output voltage",
            0x40 => "temperature",
            0x41 => "ambient temperature",
            0x42 => "device temperature",
            0x50 => "device hardware",
            0x60 => "device software",
            0x61 => "internal software",
            0x62 => "user software",
            0x63 => "data set",
            0x70 => "additional modules",
            0x80 => "monitoring",
            0x81 => "communication",
            0x82 => "protocol error",
            0x90 => "external error",
            0xF0 => "additional functions",
            0xFF => "device specific",
            _ => {
                return match self.0 >> 12 {
                    0x2 => Some("current"),
                    0x3 => Some("voltage"),
                    0x4 => Some("temperature"),
                    0x5 => Some("device hardware"),
                    0x6 => Some("device software"),
                    0x7 => Some("additional modules"),
                    0x8 => Some("monitoring"),
                    0x9 => Some("external error"),
                    _ => None,
                };
            }
        })
    }
}

/// Four digits and `h`, with the meaning behind a colon where the standard knows it.
impl fmt::Display for EmergencyCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04X}h", self.0)?;
        match self.meaning() {
            Some(meaning) => write!(f, ": {meaning}"),
            None => Ok(()),
        }
    }
}

/// `EmergencyCode(8130h)`: the digits are unreadable in decimal.
impl fmt::Debug for EmergencyCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "EmergencyCode({:04X}h)", self.0)
    }
}

/// Error register, 1001h and the third byte of an EMCY message (CiA 301 v4.2, 7.5.2.2).
///
/// ```
/// use edskit_types::ErrorRegister;
///
/// assert!(ErrorRegister(0x11).names().eq(["generic error", "communication error"]));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct ErrorRegister(
    /// One bit for each class of errors.
    pub u8,
);

impl ErrorRegister {
    /// Bit 0: generic error, which is set with every other one.
    pub const GENERIC: Self = Self(1);
    /// Bit 1: current.
    pub const CURRENT: Self = Self(1 << 1);
    /// Bit 2: voltage.
    pub const VOLTAGE: Self = Self(1 << 2);
    /// Bit 3: temperature.
    pub const TEMPERATURE: Self = Self(1 << 3);
    /// Bit 4: communication error.
    pub const COMMUNICATION: Self = Self(1 << 4);
    /// Bit 5: device profile specific.
    pub const DEVICE_PROFILE: Self = Self(1 << 5);
    /// Bit 7: manufacturer specific.
    pub const MANUFACTURER: Self = Self(1 << 7);

    /// The bits of both.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// What each bit means, bit 0 first.
    pub const BITS: [&'static str; 8] = [
        "generic error",
        "current",
        "voltage",
        "temperature",
        "communication error",
        "device profile specific",
        "reserved",
        "manufacturer specific",
    ];

    /// The meanings of the bits that are set.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        Self::BITS
            .into_iter()
            .enumerate()
            .filter(move |(bit, _)| self.0 >> bit & 1 == 1)
            .map(|(_, name)| name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    #[test]
    fn the_nearest_meaning_counts() {
        let meaning = |code| EmergencyCode(code).meaning();
        assert_eq!(meaning(0x8110), Some("CAN overrun, objects lost"));
        assert_eq!(meaning(0x8111), Some("communication"));
        assert_eq!(meaning(0x8F00), Some("monitoring"));
        assert_eq!(meaning(0x5530), Some("device hardware"));
        assert_eq!(meaning(0xFF12), Some("device specific"));
        assert_eq!(meaning(0xA000), None);
        assert_eq!(meaning(0x1100), None);
    }

    #[test]
    fn constants_mean_what_they_are_called() {
        for (code, meaning) in [
            (EmergencyCode::GENERIC, "generic error"),
            (EmergencyCode::INPUT_CURRENT, "current, input side of the device"),
            (EmergencyCode::OUTPUT_VOLTAGE, "output voltage"),
            (EmergencyCode::DEVICE_TEMPERATURE, "device temperature"),
            (EmergencyCode::DATA_SET, "data set"),
            (EmergencyCode::CAN_ID_COLLISION, "CAN-ID collision"),
            (EmergencyCode::PROTOCOL, "protocol error"),
            (EmergencyCode::DEVICE_SPECIFIC, "device specific"),
        ] {
            assert_eq!(code.meaning(), Some(meaning));
        }
        let all = [
            ErrorRegister::GENERIC,
            ErrorRegister::CURRENT,
            ErrorRegister::VOLTAGE,
            ErrorRegister::TEMPERATURE,
            ErrorRegister::COMMUNICATION,
            ErrorRegister::DEVICE_PROFILE,
            ErrorRegister::MANUFACTURER,
        ];
        let all = all.into_iter().fold(ErrorRegister(0), ErrorRegister::and);
        assert_eq!(all.names().count(), 7);
        assert!(ErrorRegister::MANUFACTURER.names().eq(["manufacturer specific"]));
    }

    #[test]
    fn notation() {
        assert_eq!(format!("{} {:?}", EmergencyCode(0xA000), EmergencyCode(0)), "A000h EmergencyCode(0000h)");
    }
}
