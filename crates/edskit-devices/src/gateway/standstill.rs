//! Why there is no communication on CANopen.

use super::error::{CanOpenError, GatewayError};
use super::event::Refusal;
use super::fault::Fault;

/// Why the gateway does not communicate on CANopen, in the states undefined and init.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standstill {
    /// The gateway has no supply.
    GatewayOff,
    /// The gateway stays in its bootloader (GW-APP-48).
    InBootloader,
    /// The program of the gateway has not started yet.
    GatewayStarting,
    /// An error of the gateway has not been cleared, or its cause lasts (9.4; GW-APP-31).
    Error(GatewayError),
    /// An error of the governor lasts (9.5; GW-APP-21, GW-APP-22).
    GovernorError(CanOpenError),
    /// The governor has no supply.
    GovernorOff,
    /// The program of the governor has not started yet.
    GovernorStarting,
    /// The parameters of the units do not agree: [`hindrances`](super::Configuration::hindrances) says in what (GW-CFG-48).
    Apart,
    /// The link between the units is broken.
    Fault(Fault),
    /// The gateway has refused its initialisation for the last time (9.5; GW-APP-14).
    Refused(Refusal),
    /// The governor has commanded the state undefined (3; GW-NMT-12).
    Commanded,
    /// The governor initialises the gateway.
    Initialising,
}
