//! What the governor tells the gateway at an initialisation, and how the gateway makes its PDOs of it.
//!
//! The manual names the initialisation telegrams without their layout (3, 7.3). These carry what they must: which PDOs
//! there are and what they hold. The identifiers are parameters of the gateway, so that it adds them itself.

use super::configuration::Configuration;
use super::pdo::{Pdo, Source};
use super::table::{PdoTable, identifier};
use core::fmt;
use edskit_types::PdoDirection;

/// How many PDOs the gateway has (2; GW-EDS-03).
const PDOS: u8 = 20;

/// A telegram of the initialisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Telegram<'a> {
    /// So many PDOs follow.
    Begin(u8),
    /// A PDO, its identifier left to the gateway: RPDO 1 to 4, then TPDO 1 to 16.
    Pdo(&'a Pdo),
    /// That is all.
    End,
}

/// What is wrong with the structure of the telegrams (7.3; GW-CFG-17).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StructureError {
    /// A telegram is missing, or comes at the wrong place.
    OutOfOrder,
    /// A PDO holds more words than it can.
    TooLong,
    /// A word names an entry that this PDO cannot carry.
    WrongObject,
}

impl fmt::Display for StructureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::OutOfOrder => "an initialisation telegram is missing or out of order",
            Self::TooLong => "an initialisation telegram describes a PDO with too many words",
            Self::WrongObject => "an initialisation telegram names an entry that its PDO cannot carry",
        })
    }
}

impl PdoTable {
    /// The telegrams that describe these PDOs.
    pub(super) fn telegrams(&self) -> impl Iterator<Item = Telegram<'_>> {
        let pdos = self.iter().map(Telegram::Pdo);
        [Telegram::Begin(PDOS)].into_iter().chain(pdos).chain([Telegram::End])
    }
}

/// Makes the PDOs of the gateway out of the governor's telegrams.
///
/// # Errors
/// What is wrong with the telegrams, at the first one that is not as it must be.
pub(super) fn assemble<'a>(
    mut telegrams: impl Iterator<Item = Telegram<'a>>,
    configuration: &Configuration,
) -> Result<PdoTable, StructureError> {
    if telegrams.next() != Some(Telegram::Begin(PDOS)) {
        return Err(StructureError::OutOfOrder);
    }
    let mut table = PdoTable::inactive(configuration);
    for place in table.iter_mut() {
        let Some(Telegram::Pdo(told)) = telegrams.next() else { return Err(StructureError::OutOfOrder) };
        if (told.direction, told.number) != (place.direction, place.number) {
            return Err(StructureError::OutOfOrder);
        }
        check(told)?;
        let can_id = identifier(configuration, told.direction, told.number);
        *place = Pdo { node_id: configuration.node_id(), can_id, ..*told };
    }
    let is_complete = telegrams.next() == Some(Telegram::End) && telegrams.next().is_none();
    if is_complete { Ok(table) } else { Err(StructureError::OutOfOrder) }
}

/// The words that a PDO may hold: as many as its mapping has places, and of the kind that it carries (4; GW-OD-09,
/// GW-OD-12).
fn check(pdo: &Pdo) -> Result<(), StructureError> {
    let most = match (pdo.direction, pdo.number) {
        (PdoDirection::Receive, 1) => 3,
        (PdoDirection::Transmit, 2) => 2,
        (PdoDirection::Transmit, 3) => 1,
        _ => 4,
    };
    if pdo.words().len() > most {
        return Err(StructureError::TooLong);
    }
    let is_right = pdo.words().iter().all(|word| {
        let of_the_kind = match (pdo.direction, pdo.number) {
            (PdoDirection::Receive, 1) => {
                matches!(word.source, Source::SwitchFunctions | Source::SensorFlags | Source::Dummy)
            }
            (PdoDirection::Receive, _) => matches!(word.source, Source::Sensor { .. } | Source::Dummy),
            (PdoDirection::Transmit, 1 | 2) => matches!(word.source, Source::Errors { .. }),
            (PdoDirection::Transmit, 3) => word.source == Source::EngineStatus,
            (PdoDirection::Transmit, _) => matches!(word.source, Source::Signal { .. }),
        };
        of_the_kind && word.object.bits() == 16
    });
    if is_right { Ok(()) } else { Err(StructureError::WrongObject) }
}

#[cfg(test)]
mod tests {
    use super::super::{NamedSignals, Parameter};
    use super::*;
    use std::vec::Vec;

    fn configuration() -> Configuration {
        let mut configuration = Configuration::new();
        for (parameter, value) in [
            (Parameter::MY_NODE_ID, 7),
            (Parameter::SEND_ERRORS, 1),
            (Parameter::SEND_STATUS, 1),
            (Parameter::tpdo_assignment(5, 0).unwrap(), 2000),
            (Parameter::tpdo_cycle(5).unwrap(), 100),
            (Parameter::tpdo_identifier(5).unwrap(), 0x190),
        ] {
            configuration.set(parameter, value).unwrap();
        }
        configuration
    }

    // GW-APP-03, GW-APP-04
    #[test]
    fn the_gateway_finds_the_governors_pdos() {
        let configuration = configuration();
        let table = PdoTable::new(&configuration, &NamedSignals);
        assert_eq!(assemble(table.telegrams(), &configuration).as_ref(), Ok(&table));
        // The identifiers are the gateway's own, whatever node-ID the governor's side was made with.
        let mut other = configuration.clone();
        other.set(Parameter::MY_NODE_ID, 9).unwrap();
        let assembled = assemble(table.telegrams(), &other).unwrap();
        assert_eq!(assembled, PdoTable::new(&other, &NamedSignals));
    }

    // GW-CFG-17
    #[test]
    fn telegrams_in_disorder_are_refused() {
        let configuration = configuration();
        let table = PdoTable::new(&configuration, &NamedSignals);
        let all: Vec<_> = table.telegrams().collect();
        let refused = |telegrams: &[Telegram<'_>]| assemble(telegrams.iter().copied(), &configuration);
        for place in 0..all.len() {
            let mut without = all.clone();
            without.remove(place);
            assert_eq!(refused(&without), Err(StructureError::OutOfOrder), "without telegram {place}");
            let mut twice = all.clone();
            twice.insert(place, all[place]);
            assert_eq!(refused(&twice), Err(StructureError::OutOfOrder), "telegram {place} twice");
        }
        assert_eq!(refused(&[]), Err(StructureError::OutOfOrder));
        let mut fewer = all;
        fewer[0] = Telegram::Begin(19);
        assert_eq!(refused(&fewer), Err(StructureError::OutOfOrder));
    }

    // GW-CFG-17, GW-OD-09, GW-OD-12
    #[test]
    fn telegrams_with_wrong_content_are_refused() {
        let configuration = configuration();
        let table = PdoTable::new(&configuration, &NamedSignals);
        let with = |from: usize, to: usize| {
            let mut wrong = table.clone();
            let words = *wrong.tpdos[from].words.first_chunk::<4>().unwrap();
            (wrong.tpdos[to].words, wrong.tpdos[to].length) = (words, table.tpdos[from].length);
            assemble(wrong.telegrams(), &configuration)
        };
        assert_eq!(with(0, 2), Err(StructureError::TooLong), "four words in TPDO 3");
        assert_eq!(with(0, 4), Err(StructureError::WrongObject), "error words in TPDO 5");
        assert_eq!(with(2, 4), Err(StructureError::WrongObject), "the engine status in TPDO 5");
    }
}
