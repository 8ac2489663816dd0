//! Faults from outside: what a driver reports on a device, and what a scenario brings about on a computer.

use super::error::GatewayError;

/// Something that is not as it should be around the two control units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Fault {
    /// Nothing passes between governor and gateway: a broken wire.
    LinkBroken,
    /// The gateway's controller of the HEINZMANN bus: bus-off, error status, data overrun (9.4 on 3070).
    GatewayCanBus1,
    /// The gateway cannot send on the HEINZMANN bus as fast as it should: its transmit buffer overflows (7.2.1; 2401).
    GatewayTransmitBuffer1,
    /// The gateway's receive buffer of the HEINZMANN bus overflows (7.2.1; 2402).
    GatewayReceiveBuffer1,
    /// The gateway's special buffer for the CANopen telegrams of the governor overflows. It happens, and is over (7.2.1, 9.5
    /// on 12422; GW-APP-49).
    CanOpenBuffer1,
    /// A second participant on the HEINZMANN bus has the type and number of the gateway (7.2.1; 2404).
    DuplicateGateway,
    /// The gateway's controller of the CANopen bus (9.4 on 3072).
    GatewayCanBus2,
    /// The receive buffer of the CANopen side overflows. It happens, and is over (9.5 on 12424).
    ReceiveBuffer2,
    /// The transmit buffer for SDO overflows. It happens, and is over (9.5 on 12424).
    TransmitBuffer2,
    /// The governor's CAN controller (9.5 on 12414).
    GovernorCanBus,
    /// The governor's communication: overflow, or a second participant of its type and number (9.5 on 12415).
    GovernorCanComm,
    /// The governor's initialisation telegrams lack one (7.3).
    InitTelegrams,
    /// Parameters cannot be stored.
    ParamStore,
    /// The program memory is faulty.
    ProgramTest,
    /// The RAM is faulty.
    RamTest,
    /// The data are inconsistent.
    Data,
    /// A stack has overflown.
    Stack,
    /// An exception of the program.
    Intern,
}

impl Fault {
    /// Every fault.
    pub const ALL: [Fault; 18] = [
        Self::LinkBroken,
        Self::GatewayCanBus1,
        Self::GatewayTransmitBuffer1,
        Self::GatewayReceiveBuffer1,
        Self::CanOpenBuffer1,
        Self::DuplicateGateway,
        Self::GatewayCanBus2,
        Self::ReceiveBuffer2,
        Self::TransmitBuffer2,
        Self::GovernorCanBus,
        Self::GovernorCanComm,
        Self::InitTelegrams,
        Self::ParamStore,
        Self::ProgramTest,
        Self::RamTest,
        Self::Data,
        Self::Stack,
        Self::Intern,
    ];

    /// Whether it happens and is over, instead of lasting until it is removed.
    #[must_use]
    pub const fn is_momentary(self) -> bool {
        matches!(self, Self::CanOpenBuffer1 | Self::ReceiveBuffer2 | Self::TransmitBuffer2)
    }

    /// The error of the gateway that it causes at once; that of a broken link takes the time that a silent partner is
    /// waited for.
    #[must_use]
    pub const fn gateway_error(self) -> Option<GatewayError> {
        match self {
            Self::GatewayCanBus1 => Some(GatewayError::CanBus1),
            Self::GatewayTransmitBuffer1
            | Self::GatewayReceiveBuffer1
            | Self::CanOpenBuffer1
            | Self::DuplicateGateway => Some(GatewayError::CanComm1),
            Self::GatewayCanBus2 => Some(GatewayError::CanBus2),
            // There are two buffers for CANopen: that of the HEINZMANN side, and that of the CANopen side (GW-NOTE-29).
            Self::ReceiveBuffer2 | Self::TransmitBuffer2 => Some(GatewayError::CanComm2),
            Self::ParamStore => Some(GatewayError::ParamStore),
            Self::ProgramTest => Some(GatewayError::ProgramTest),
            Self::RamTest => Some(GatewayError::RamTest),
            Self::Data => Some(GatewayError::Data),
            Self::Stack => Some(GatewayError::Stack),
            Self::Intern => Some(GatewayError::Intern),
            Self::LinkBroken | Self::GovernorCanBus | Self::GovernorCanComm | Self::InitTelegrams => None,
        }
    }

    /// Whether nothing passes between governor and gateway while it lasts.
    pub(super) const fn breaks_link(self) -> bool {
        matches!(self, Self::LinkBroken | Self::GatewayCanBus1 | Self::GovernorCanBus)
    }
}

/// The faults that last.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Faults(u32);

impl Faults {
    pub(super) fn set(&mut self, fault: Fault, is_present: bool) {
        let bit = 1 << fault as u8;
        self.0 = if is_present { self.0 | bit } else { self.0 & !bit };
    }

    pub(super) fn has(self, fault: Fault) -> bool {
        self.0 & 1 << fault as u8 != 0
    }

    pub(super) fn iter(self) -> impl Iterator<Item = Fault> {
        Fault::ALL.into_iter().filter(move |fault| self.has(*fault))
    }
}
