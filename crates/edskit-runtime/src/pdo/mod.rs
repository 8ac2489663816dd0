//! PDOs: their configuration, and the messages (CiA 301 v4.2, 7.2.2).

mod configure;
mod mapping;
mod policy;
mod receive;
#[cfg_attr(not(feature = "rtr"), path = "../off/pdo_remote.rs")]
mod remote;
#[cfg_attr(not(feature = "sync"), path = "../off/pdo_synchronous.rs")]
mod synchronous;
mod transmit;

pub use mapping::Mapped;
pub use policy::{PdoPolicy, Remapping};
pub use receive::Rpdo;
pub use transmit::{NotSent, Tpdo};

use crate::Microseconds;
use edskit_types::{CanId, Index, PdoDirection, Transmission};
use mapping::Slots;

/// How many PDOs of each direction there can be.
const MOST_PDOS: u16 = 512;
/// How many entries a mapping can have.
const MOST_ENTRIES: u8 = 64;

/// Sub-indices of a communication parameter.
mod sub {
    pub(super) const COB_ID: u8 = 1;
    pub(super) const TRANSMISSION_TYPE: u8 = 2;
    pub(super) const INHIBIT_TIME: u8 = 3;
    pub(super) const EVENT_TIMER: u8 = 5;
    pub(super) const SYNC_START: u8 = 6;
}

/// The place of a PDO in the dictionary: its direction, and its number from 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Place {
    pub(crate) direction: PdoDirection,
    pub(crate) number: u16,
}

impl Place {
    /// The PDO whose parameter is at an index, and whether that is the mapping.
    pub(crate) fn at(index: Index) -> Option<(Self, bool)> {
        let communication = Self::of_communication(index).map(|place| (place, false));
        communication.or_else(|| Self::of_mapping(index).map(|place| (place, true)))
    }

    /// The PDO whose communication parameter is at an index.
    fn of_communication(index: Index) -> Option<Self> {
        Self::among(index, Index::RPDO_COMMUNICATION, Index::TPDO_COMMUNICATION)
    }

    /// The PDO whose mapping parameter is at an index.
    fn of_mapping(index: Index) -> Option<Self> {
        Self::among(index, Index::RPDO_MAPPING, Index::TPDO_MAPPING)
    }

    fn among(index: Index, receive: Index, transmit: Index) -> Option<Self> {
        let within = |first: Index| index.0.checked_sub(first.0).filter(|number| *number < MOST_PDOS);
        let direction = |direction| move |number| Self { direction, number };
        within(receive)
            .map(direction(PdoDirection::Receive))
            .or_else(|| within(transmit).map(direction(PdoDirection::Transmit)))
    }

    pub(crate) fn communication(self) -> Index {
        self.index(Index::RPDO_COMMUNICATION, Index::TPDO_COMMUNICATION)
    }

    pub(crate) fn mapping(self) -> Index {
        self.index(Index::RPDO_MAPPING, Index::TPDO_MAPPING)
    }

    fn index(self, receive: Index, transmit: Index) -> Index {
        let first = match self.direction {
            PdoDirection::Receive => receive,
            PdoDirection::Transmit => transmit,
        };
        Index(first.0 + self.number)
    }
}

/// What the dictionary says about a PDO of either direction.
#[derive(Clone, Copy, Debug)]
struct Parameters {
    /// Its number from 1; 0 for a place that no PDO takes.
    number: u16,
    /// The identifier; `None` while the PDO does not exist: bit 31 of its COB-ID says so, or its COB-ID or transmission
    /// type is one that a client could not write.
    can_id: Option<CanId>,
    /// Whether remote frames may ask for it.
    allows_rtr: bool,
    /// What its transmission type means.
    meaning: Transmission,
    /// Milliseconds after which a TPDO is sent again, or the longest time between two frames of an RPDO; 0 for none.
    event_time: u16,
    slots: Slots,
    /// Whether the mapping in the dictionary cannot be carried.
    is_mapping_invalid: bool,
}

impl Parameters {
    const NONE: Self = Self {
        number: 0,
        can_id: None,
        allows_rtr: false,
        meaning: Transmission::EventProfile,
        event_time: 0,
        slots: Slots::NONE,
        is_mapping_invalid: false,
    };
}

impl Parameters {
    fn event_time(&self) -> Microseconds {
        Microseconds::from_milliseconds(self.event_time.into())
    }

    /// Whether other parameters are those of the same PDO: it goes on to exist with the same identifier and mapping.
    fn is_same_pdo(&self, old: &Self, is_remapped: bool) -> bool {
        self.can_id.is_some() && self.can_id == old.can_id && !is_remapped
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_indices() {
        let place = Place { direction: PdoDirection::Transmit, number: 3 };
        assert_eq!((place.communication(), place.mapping()), (Index(0x1803), Index(0x1A03)));
        assert_eq!(Place::of_mapping(Index(0x1A03)), Some(place));
        assert_eq!(Place::of_communication(Index(0x15FF)).map(|place| place.number), Some(511));
        for index in [0x13FF, 0x1600, 0x1A00, 0x1C00] {
            assert_eq!(Place::of_communication(Index(index)), None, "{index:X}");
        }
    }
}
