//! The Heinzmann CANopen gateway for digital governors: its configuration, and the live device.
//!
//! Source is the manual DG 04 005-d / 07-04; "7.3" and the like are its sections, "GW-CFG-17" and the like the
//! statements of the project's ledger on it; `docs/conformance/gateway.md` says which test shows which.
//!
//! # Configuration
//!
//! A [`Configuration`] holds the parameters of the gateway and those of the governor that decide on CANopen. Both units
//! number their parameters by themselves, so that each [`Parameter`] says whose it is ([`Owner`], GW-NOTE-20). From the
//! configuration follow the PDOs ([`PdoTable`]), and whether the gateway accepts them at its initialisation
//! ([`PdoTable::claims`] with [`RULES`], 7.3).
//!
//! ```
//! use edskit_devices::gateway::{Configuration, NamedSignals, Parameter, PdoTable, RULES};
//! use edskit_types::conflicts;
//!
//! let mut configuration = Configuration::new();
//! configuration.set(Parameter::MY_NODE_ID, 2)?;
//! configuration.set(Parameter::SEND_ERRORS, 1)?;
//! configuration.set(Parameter::tpdo_assignment(5, 0).unwrap(), 2000)?;
//! configuration.set(Parameter::tpdo_cycle(5).unwrap(), 100)?;
//! configuration.set(Parameter::tpdo_identifier(5).unwrap(), 0x282)?;
//!
//! let pdos = PdoTable::new(&configuration, &NamedSignals);
//! let mut claims = pdos.claims();
//! let conflict = conflicts(claims.as_mut_slice(), &RULES).next().unwrap();
//! assert_eq!(conflict.to_string(), "TPDO5 and TPDO2 on 282h");
//! # Ok::<(), edskit_devices::gateway::OutOfRange>(())
//! ```
//!
//! # The device
//!
//! [`Gateway`] is both control units with the link between them and the node on CANopen. A [`Governor`] is what the
//! digital governor measures and does; [`Engine`] is a simple one. [`State`] is the state machine on CANopen, [`Fault`]
//! what can go wrong around the units, [`GatewayError`] and [`CanOpenError`] what they show of it, [`Event`] what happens.
//!
//! # Choices where the manual is silent
//!
//! * Defaults: the manual prints none. The ones here are those of its examples: node-ID 1, 125 kbit/s (GW-GAP-13), node
//!   numbers 1, 250 kbit/s and 1.0 s on the HEINZMANN bus (GW-CFG-44), and 0 for everything else.
//! * Which governor parameters exist and are analogue is a matter of the governor. [`Signals`] answers it;
//!   [`NamedSignals`] knows those that the manual names. Of its own parameters it sends the value that is in effect, P400
//!   in steps of 10 ms.
//! * Where the lists of switch functions and sensors end ("from 811 on", "from 900 on"): with their hundreds, at 899 and
//!   999, and in step with these at 4899 and 4999. The manual names a few members only.
//! * The initialisation: the governor sends all its telegrams in one of its main cycles and the command to go to
//!   pre-operational in the next; a failed attempt is followed by the next one a main cycle later.
//! * When a silent unit is missed (7.2.1): after 32 main cycles of the unit that waits, about half a second.
//! * When monitoring looks: once in a main cycle. Its time runs from the last frame, or from the begin of operational.
//! * The phase of a cyclic TPDO: all count the governor's main cycles from its start.
//! * A monitored sensor and a switch function have no value before their first RPDO since operational began: the governor
//!   goes on with what it used before (GW-NOTE-47), and a switch function stays inactive.
//! * The bit rate and the bit timing of the governor are one parameter each under two numbers, 416 and 409, 4416 and 4409
//!   (GW-NOTE-37). Bit rates are not compared where a unit has a manual timing (GW-NOTE-48).
//! * What errors of the memories and the program do (3076 to 3094) lasts until they are cleared; what faults of the link
//!   do (3070, 3071) ends with the fault, and the governor initialises the gateway anew (GW-NOTE-30).

mod agreement;
mod amount;
mod bit_timing;
mod check;
mod configuration;
mod control_unit;
mod device;
mod dictionary;
mod eeprom;
mod engine;
mod error;
mod error_memory;
mod event;
mod fault;
mod governor;
mod identification;
mod input;
mod inputs;
mod measured;
mod monitoring;
mod name;
mod object;
mod parameter;
mod parameter_memory;
mod pdo;
mod period;
mod series;
mod signal;
mod standstill;
mod state;
mod table;
mod telegram;
mod traffic;

pub use agreement::Hindrance;
pub use amount::{Allowed, Amount};
pub use bit_timing::BitTiming;
pub use check::{Claims, INITIALISATION_ATTEMPTS, RULES};
pub use configuration::{Configuration, OutOfRange};
pub use device::Gateway;
pub use eeprom::EepromErrors;
pub use engine::Engine;
pub use error::{CanOpenError, CanOpenErrors, GatewayError};
pub use event::{Event, Refusal};
pub use fault::Fault;
pub use governor::Governor;
pub use identification::Identification;
pub use input::{Input, Target};
pub use inputs::{Inputs, Sensor};
pub use measured::{MEASURED_VALUES, measured_value, measured_value_by_name};
pub use name::Name;
pub use object::ObjectSizes;
pub use parameter::{Owner, Parameter, Quantity, Values, parameters};
pub use pdo::{Activity, Pdo, Source, Word};
pub use period::{MainCycle, Period};
pub use signal::{NAMED_SIGNALS, NamedSignals, Signal, SignalType, Signals, signal_name};
pub use standstill::Standstill;
pub use state::{Commander, State};
pub use table::PdoTable;
pub use telegram::StructureError;
pub use traffic::Traffic;

#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
