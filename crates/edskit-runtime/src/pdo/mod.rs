//! PDOs: their configuration, and the messages (CiA 301 v4.2, 7.2.2).

mod configure;
mod mapping;
mod receive;
mod transmit;

pub use mapping::Mapped;
pub use receive::Rpdo;
pub use transmit::{NotSent, Tpdo};

use edskit_types::{CobId, Index, PdoDirection};

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
    /// The PDO whose communication parameter is at an index.
    pub(crate) fn of_communication(index: Index) -> Option<Self> {
        Self::at(index, Index::RPDO_COMMUNICATION, Index::TPDO_COMMUNICATION)
    }

    /// The PDO whose mapping parameter is at an index.
    pub(crate) fn of_mapping(index: Index) -> Option<Self> {
        Self::at(index, Index::RPDO_MAPPING, Index::TPDO_MAPPING)
    }

    fn at(index: Index, receive: Index, transmit: Index) -> Option<Self> {
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

/// A COB-ID that means: there is no such PDO.
const INVALID: CobId = CobId(CobId::BIT_31);

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
