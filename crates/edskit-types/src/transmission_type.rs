//! When PDOs are sent and applied.

use core::fmt;

/// Transmission type of a PDO: sub-index 02h of its communication parameter (CiA 301, objects 1400h and
/// 1800h).
///
/// The number means something else in each direction, so every question names the [`PdoDirection`].
///
/// | value | RPDO | TPDO |
/// |---|---|---|
/// | 0 | applied at the next SYNC | sent after an event, at the next SYNC |
/// | 1 to 240 | applied at the next SYNC | sent at every n-th SYNC |
/// | 241 to 251 | reserved | reserved |
/// | 252 | reserved | sampled at SYNC, sent on RTR |
/// | 253 | reserved | sampled and sent on RTR |
/// | 254 | event-driven, manufacturer-specific | event-driven, manufacturer-specific |
/// | 255 | event-driven, profile-specific | event-driven, profile-specific |
///
/// ```
/// use edskit_types::{PdoDirection, Transmission, TransmissionType};
///
/// let every_tenth = TransmissionType(10);
/// assert_eq!(every_tenth.meaning(PdoDirection::Transmit), Transmission::SynchronousCyclic(10));
/// assert_eq!(every_tenth.meaning(PdoDirection::Receive), Transmission::Synchronous);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TransmissionType(pub u8);

impl TransmissionType {
    /// What the number says for a PDO of this direction.
    #[must_use]
    pub const fn meaning(self, direction: PdoDirection) -> Transmission {
        match (self.0, direction) {
            (0..=240, PdoDirection::Receive) => Transmission::Synchronous,
            (0, PdoDirection::Transmit) => Transmission::SynchronousAcyclic,
            (n @ 1..=240, PdoDirection::Transmit) => Transmission::SynchronousCyclic(n),
            (252, PdoDirection::Transmit) => Transmission::RtrSynchronous,
            (253, PdoDirection::Transmit) => Transmission::RtrEvent,
            (254, _) => Transmission::EventManufacturer,
            (255, _) => Transmission::EventProfile,
            (241..=251, _) | (252..=253, PdoDirection::Receive) => Transmission::Reserved,
        }
    }

    /// Whether the number is reserved for a PDO of this direction.
    #[must_use]
    pub const fn is_reserved(self, direction: PdoDirection) -> bool {
        matches!(self.meaning(direction), Transmission::Reserved)
    }

    /// Whether a PDO of this direction needs the SYNC message: to be applied, sent, or (252) sampled.
    #[must_use]
    pub const fn is_synchronous(self, direction: PdoDirection) -> bool {
        matches!(
            self.meaning(direction),
            Transmission::Synchronous
                | Transmission::SynchronousAcyclic
                | Transmission::SynchronousCyclic(_)
                | Transmission::RtrSynchronous
        )
    }
}

impl From<u8> for TransmissionType {
    fn from(value: u8) -> Self {
        TransmissionType(value)
    }
}

/// Decimal, as in the standard.
impl fmt::Display for TransmissionType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.0, f)
    }
}

/// Direction of a PDO, seen from the device that the EDS describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PdoDirection {
    /// RPDO: the device receives it.
    Receive,
    /// TPDO: the device transmits it.
    Transmit,
}

/// Meaning of a [`TransmissionType`] in one direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Transmission {
    /// RPDO, 0 to 240: applied at the next SYNC; the number has no further meaning.
    Synchronous,
    /// TPDO, 0: sent at the next SYNC after an event.
    SynchronousAcyclic,
    /// TPDO, 1 to 240: sent at every n-th SYNC.
    SynchronousCyclic(u8),
    /// TPDO, 252: sampled at SYNC and sent on remote request only. Needs RTR allowed (COB-ID bit 30 is 0).
    RtrSynchronous,
    /// TPDO, 253: sampled and sent on remote request only. Needs RTR allowed (COB-ID bit 30 is 0).
    RtrEvent,
    /// 254: event-driven, the manufacturer defines the event.
    EventManufacturer,
    /// 255: event-driven, the device or application profile defines the event.
    EventProfile,
    /// 241 to 251, and 252 and 253 for RPDOs.
    Reserved,
}

#[cfg(test)]
mod tests {
    use super::PdoDirection::{Receive, Transmit};
    use super::*;

    #[test]
    fn meanings() {
        for value in 0..=u8::MAX {
            let (receive, transmit) = match value {
                0 => (Transmission::Synchronous, Transmission::SynchronousAcyclic),
                1..=240 => (Transmission::Synchronous, Transmission::SynchronousCyclic(value)),
                241..=251 => (Transmission::Reserved, Transmission::Reserved),
                252 => (Transmission::Reserved, Transmission::RtrSynchronous),
                253 => (Transmission::Reserved, Transmission::RtrEvent),
                254 => (Transmission::EventManufacturer, Transmission::EventManufacturer),
                255 => (Transmission::EventProfile, Transmission::EventProfile),
            };
            let transmission_type = TransmissionType::from(value);
            assert_eq!(transmission_type.meaning(Receive), receive, "RPDO {value}");
            assert_eq!(transmission_type.meaning(Transmit), transmit, "TPDO {value}");
        }
    }

    #[test]
    fn reserved_and_synchronous_values() {
        let count = |holds: fn(TransmissionType) -> bool| {
            (0..=u8::MAX).filter(|&value| holds(TransmissionType(value))).count()
        };
        assert_eq!(count(|t| t.is_reserved(Receive)), 13);
        assert_eq!(count(|t| t.is_reserved(Transmit)), 11);
        assert_eq!(count(|t| t.is_synchronous(Receive)), 241);
        assert_eq!(count(|t| t.is_synchronous(Transmit)), 242);
        assert_eq!(count(|t| t.is_synchronous(Transmit) && t.is_reserved(Transmit)), 0);
    }

    #[test]
    fn notation() {
        assert_eq!(std::format!("{}", TransmissionType(254)), "254");
    }
}
