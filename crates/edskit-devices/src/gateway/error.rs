//! The errors of the gateway: 3070 to 3094, and the word of CANopen errors in 2005h.

use core::fmt;

/// An error that the gateway shows (9.4, 11.3; GW-APP-30).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u16)]
pub enum GatewayError {
    /// A fault of the HEINZMANN bus: bus-off, error status, data overrun, a frame that cannot be sent.
    CanBus1 = 3070,
    /// A fault of the communication with the governor: overflow, silence, a second device of the same number.
    CanComm1 = 3071,
    /// A fault of the CANopen bus.
    CanBus2 = 3072,
    /// An overflow of a buffer of the CANopen side.
    CanComm2 = 3073,
    /// An error of CANopen: any bit of 2005h.
    CanOpen = 3074,
    /// Parameters cannot be stored (GW-NOTE-31).
    ParamStore = 3076,
    /// The program memory is faulty.
    ProgramTest = 3077,
    /// The RAM is faulty.
    RamTest = 3078,
    /// The supply is below 7.5 V.
    Voltage = 3085,
    /// The data of the gateway are inconsistent.
    Data = 3090,
    /// A stack has overflown.
    Stack = 3093,
    /// An exception of the program.
    Intern = 3094,
}

impl GatewayError {
    /// Every error, in the order of the numbers.
    pub const ALL: [GatewayError; 12] = [
        Self::CanBus1,
        Self::CanComm1,
        Self::CanBus2,
        Self::CanComm2,
        Self::CanOpen,
        Self::ParamStore,
        Self::ProgramTest,
        Self::RamTest,
        Self::Voltage,
        Self::Data,
        Self::Stack,
        Self::Intern,
    ];

    /// The number of the measured value that is 1 while the error is present.
    #[must_use]
    pub const fn number(self) -> u16 {
        self as u16
    }

    /// The number of the counter in the error memory (9.1; GW-APP-36).
    #[must_use]
    pub const fn permanent_number(self) -> u16 {
        self.number() + 100
    }

    /// The error with this number.
    #[must_use]
    pub fn from_number(number: u16) -> Option<Self> {
        Self::ALL.into_iter().find(|error| error.number() == number)
    }

    /// The name in the manual.
    #[must_use]
    pub fn name(self) -> &'static str {
        super::measured_value(self.number()).unwrap_or_default()
    }

    /// What it means.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::CanBus1 => "fault of the HEINZMANN bus",
            Self::CanComm1 => "no proper communication with the governor",
            Self::CanBus2 => "fault of the CANopen bus",
            Self::CanComm2 => "overflow of a CANopen buffer",
            Self::CanOpen => "error of CANopen, see 2005h",
            Self::ParamStore => "parameters cannot be stored",
            Self::ProgramTest => "program memory faulty",
            Self::RamTest => "RAM faulty",
            Self::Voltage => "supply below 7.5 V",
            Self::Data => "data inconsistent",
            Self::Stack => "stack overflow",
            Self::Intern => "exception of the program",
        }
    }

    /// Whether it ends all communication on CANopen and leads to the state undefined (9.4; GW-APP-31).
    #[must_use]
    pub const fn leads_to_undefined(self) -> bool {
        matches!(
            self,
            Self::CanBus1
                | Self::CanComm1
                | Self::ParamStore
                | Self::ProgramTest
                | Self::RamTest
                | Self::Data
                | Self::Stack
                | Self::Intern
        )
    }

    /// The place among [`GatewayError::ALL`].
    pub(super) fn position(self) -> usize {
        Self::ALL.into_iter().position(|error| error == self).unwrap_or_default()
    }
}

/// `3070 ErrCanBus1`.
impl fmt::Display for GatewayError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.number(), self.name())
    }
}

/// An error of CANopen: a bit of 2005h (5.1.6, table 2; GW-APP-15).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum CanOpenError {
    /// The governor was reset, the gateway was not.
    GovernorReset = 0,
    /// The configuration cannot be carried out.
    Init = 1,
    /// An RPDO has not come in time.
    TimeControl = 2,
    /// Error 3070 of the governor.
    GovernorCanBus = 3,
    /// Error 3071 of the governor.
    GovernorCanComm = 4,
    /// The gateway was reset, the governor was not.
    GatewayReset = 8,
    /// The partner's heartbeat has not come in time.
    Heartbeat = 9,
    /// Error 3070 of the gateway.
    GatewayCanBus1 = 10,
    /// Error 3071 of the gateway.
    GatewayCanComm1 = 11,
    /// Error 3072 of the gateway.
    GatewayCanBus2 = 12,
    /// Error 3073 of the gateway.
    GatewayCanComm2 = 13,
}

impl CanOpenError {
    /// Every error, in the order of the bits.
    pub const ALL: [CanOpenError; 11] = [
        Self::GovernorReset,
        Self::Init,
        Self::TimeControl,
        Self::GovernorCanBus,
        Self::GovernorCanComm,
        Self::GatewayReset,
        Self::Heartbeat,
        Self::GatewayCanBus1,
        Self::GatewayCanComm1,
        Self::GatewayCanBus2,
        Self::GatewayCanComm2,
    ];

    /// Its bit in 2005h.
    #[must_use]
    pub const fn bit(self) -> u16 {
        1 << self as u8
    }

    /// The measured value that shows it, 12411 to 12424.
    #[must_use]
    pub const fn number(self) -> u16 {
        12411 + self as u16
    }

    /// The name in the manual.
    #[must_use]
    pub fn name(self) -> &'static str {
        super::measured_value(self.number()).unwrap_or_default()
    }

    /// What it means.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::GovernorReset => "the governor was reset",
            Self::Init => "the configuration cannot be carried out",
            Self::TimeControl => "an RPDO has not come in time",
            Self::GovernorCanBus => "the governor reports a fault of its CAN bus",
            Self::GovernorCanComm => "the governor reports a fault of communication",
            Self::GatewayReset => "the gateway was reset",
            Self::Heartbeat => "the partner's heartbeat has not come in time",
            Self::GatewayCanBus1 => "fault of the HEINZMANN bus",
            Self::GatewayCanComm1 => "no proper communication with the governor",
            Self::GatewayCanBus2 => "fault of the CANopen bus",
            Self::GatewayCanComm2 => "overflow of a CANopen buffer",
        }
    }

    /// Whether it goes when its cause goes. The others stay until they are cleared or operational is entered
    /// (9.5; GW-APP-17, GW-APP-20, GW-APP-24).
    #[must_use]
    pub const fn clears_itself(self) -> bool {
        matches!(self, Self::TimeControl | Self::Heartbeat)
    }

    /// Whether it is one of communication, which 1001h shows by bit 4 (GW-NOTE-36).
    #[must_use]
    pub const fn is_of_communication(self) -> bool {
        !matches!(self, Self::GovernorReset | Self::Init | Self::TimeControl | Self::GatewayReset)
    }
}

/// `12412 CanOpInitErr`.
impl fmt::Display for CanOpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.number(), self.name())
    }
}

/// The errors of CANopen that are present: the value of 2005h (5.1.6; GW-OD-19).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CanOpenErrors(pub u16);

impl CanOpenErrors {
    /// Whether there is none.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Whether it is present.
    #[must_use]
    pub const fn contains(self, error: CanOpenError) -> bool {
        self.0 & error.bit() != 0
    }

    /// Those that are present, in the order of the bits.
    pub fn iter(self) -> impl Iterator<Item = CanOpenError> {
        CanOpenError::ALL.into_iter().filter(move |error| self.contains(*error))
    }

    /// Makes an error present or not; whether that is new.
    pub(super) fn set(&mut self, error: CanOpenError, is_present: bool) -> bool {
        let before = self.0;
        self.0 = if is_present { before | error.bit() } else { before & !error.bit() };
        self.0 != before
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;
    use std::vec::Vec;

    // GW-APP-15, GW-NOTE-32
    #[test]
    fn bits_numbers_and_names() {
        let shown: Vec<_> =
            CanOpenError::ALL.iter().map(|error| (error.bit().trailing_zeros(), error.to_string())).collect();
        let expected = [
            (0, "12411 CanOpDCResetErr"),
            (1, "12412 CanOpInitErr"),
            (2, "12413 CanOpTimeCtrlErr"),
            (3, "12414 CanOpDCErrCanBus"),
            (4, "12415 CanOpDCErrCanComm"),
            (8, "12419 CanOpGWResetErr"),
            (9, "12420 CanOpHeartbeatErr"),
            (10, "12421 CanOpGWErrCanBus1"),
            (11, "12422 CanOpGWErrCanComm1"),
            (12, "12423 CanOpGWErrCanBus2"),
            (13, "12424 CanOpGWErrCanComm2"),
        ];
        assert_eq!(shown, expected.map(|(bit, name)| (bit, name.to_string())));
        let of_communication: u16 = CanOpenError::ALL
            .iter()
            .filter(|error| error.is_of_communication())
            .map(|error| error.bit())
            .sum();
        assert_eq!(of_communication, 0b0011_1110_0001_1000, "GW-NOTE-36: bits 3, 4, 9 and 10 to 13");
    }

    // GW-APP-30, GW-APP-36
    #[test]
    fn current_and_permanent_numbers() {
        for error in GatewayError::ALL {
            assert_eq!(GatewayError::from_number(error.number()), Some(error));
            let name = super::super::measured_value(error.permanent_number());
            assert_eq!(name, Some(std::format!("S{}", error.name()).as_str()));
        }
        assert_eq!(GatewayError::from_number(3075), None);
    }

    // GW-APP-31
    #[test]
    fn what_ends_communication() {
        let numbers: Vec<u16> = GatewayError::ALL
            .iter()
            .filter(|error| error.leads_to_undefined())
            .map(|error| error.number())
            .collect();
        assert_eq!(numbers, [3070, 3071, 3076, 3077, 3078, 3090, 3093, 3094]);
    }
}
