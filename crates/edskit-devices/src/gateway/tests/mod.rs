//! The worked examples of the manual and the statements of the ledger, by chapter.

mod device;
mod identifiers;
mod parameters;
mod rpdos;
mod times;
mod tpdos;

use super::testing::configuration;
use super::*;
use std::string::{String, ToString};
use std::vec::Vec;

fn governor(settings: &[(u16, i32)]) -> Vec<(Owner, u16, i32)> {
    settings.iter().map(|&(number, value)| (Owner::Governor, number, value)).collect()
}

fn gateway(settings: &[(u16, i32)]) -> Vec<(Owner, u16, i32)> {
    settings.iter().map(|&(number, value)| (Owner::Gateway, number, value)).collect()
}

fn table(settings: &[(Owner, u16, i32)]) -> PdoTable {
    PdoTable::new(&configuration(settings), &NamedSignals)
}

/// The names of the active PDOs.
fn active(table: &PdoTable) -> Vec<String> {
    table.iter().filter(|pdo| pdo.activity.is_active()).map(|pdo| pdo.party().to_string()).collect()
}

/// What the gateway finds at its initialisation.
fn conflicts(table: &PdoTable) -> Vec<String> {
    let mut claims = table.claims();
    edskit_types::conflicts(claims.as_mut_slice(), &RULES).map(|conflict| conflict.to_string()).collect()
}

/// The mapping of a PDO.
fn mapping(pdo: &Pdo) -> Vec<String> {
    pdo.words().iter().map(|word| word.object.to_string()).collect()
}

/// The numbers of the governor parameters in a PDO.
fn signals(pdo: &Pdo) -> Vec<u16> {
    let number = |word: &Word| match word.source {
        Source::Signal { number, .. } => Some(number),
        _ => None,
    };
    pdo.words().iter().filter_map(number).collect()
}
