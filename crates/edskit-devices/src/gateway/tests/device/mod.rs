//! The live device in virtual time, to the microsecond.

mod attempts;
mod bus;
mod dictionary;
mod eeprom;
mod errors;
mod heartbeats;
mod initialisation;
mod link;
mod reading;
mod rpdos;
mod sdo;
mod standstill;
mod states;
mod tpdos;

use super::super::testing::{Bench, frame};
use super::{gateway, governor};
use crate::gateway::{
    CanOpenError, Event, Fault, GatewayError, Governor as _, Owner, Parameter, Refusal, State, StructureError,
};
use std::vec::Vec;

/// A main cycle of the governor and of the gateway, in µs.
const DC: u64 = 15_625;
const GW: u64 = 16_000;

/// Settings of both units.
fn both(of_gateway: &[(u16, i32)], of_governor: &[(u16, i32)]) -> Vec<(Owner, u16, i32)> {
    [gateway(of_gateway), governor(of_governor)].concat()
}

/// The example of 7.1.2.2: four values in TPDO 4, three in TPDO 16, nothing between, with these cycle times.
fn example(cycle_4: i32, cycle_16: i32) -> Vec<(Owner, u16, i32)> {
    both(
        &[(16415, 0x57F)],
        &[
            (16400, 2000),
            (16401, 2031),
            (16402, 2300),
            (16403, 2330),
            (16448, 2905),
            (16449, 2908),
            (16450, 2917),
            (16460, cycle_4),
            (16472, cycle_16),
        ],
    )
}
