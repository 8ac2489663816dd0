//! Switch functions and sensors that the governor takes from CANopen.

use super::configuration::Configuration;
use super::parameter::{Owner, Parameter, known};

/// The type of a switch function or sensor that comes from CANopen (7.1.4.1, 7.1.4.2; GW-CFG-04, GW-CFG-07).
pub(super) const FROM_CANOPEN: i32 = 3;

/// The first of P811 to P899 and of P4811 to P4899 (7.1.4.1).
const FUNCTIONS: Parameter = known(Owner::Governor, 811);
const FUNCTION_TYPES: Parameter = known(Owner::Governor, 4811);
/// The first of P900 to P999 and of P4900 to P4999 (7.1.4.2).
const SENSORS: Parameter = known(Owner::Governor, 900);
const SENSOR_TYPES: Parameter = known(Owner::Governor, 4900);

/// Bits of the word for switch functions, and the CANopen channels (GW-CFG-04, GW-PDO-16).
const BITS: u32 = 16;
pub(super) const CHANNELS: i32 = 12;

/// A switch function or a sensor whose type says that it comes from CANopen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Input {
    /// The parameter that says where in the RPDOs it is.
    pub assignment: Parameter,
    /// The parameter that says that it comes from CANopen.
    pub kind: Parameter,
    /// Where it is.
    pub target: Target,
}

/// Where in the RPDOs an input is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Assigned is 0: nowhere. A switch function then always has the value 0 (7.1.4.1; GW-CFG-04).
    Unassigned,
    /// A switch function in word 1 of RPDO 1 (GW-CFG-04).
    Bit {
        /// The bit number, 1 to 16; 1 is the least significant bit (GW-NOTE-12).
        number: u8,
        /// Whether the function is active while the bit is 0: the number is assigned with a minus.
        low_active: bool,
    },
    /// A sensor in RPDO 2 to 4.
    Channel(
        /// 1 for word 1 of RPDO 2 to 12 for word 4 of RPDO 4 (7.1.4.2; GW-PDO-16).
        u8,
    ),
    /// A number that is neither.
    Nowhere(i32),
}

impl Target {
    /// The channel of a sensor.
    #[must_use]
    pub const fn channel(self) -> Option<u8> {
        match self {
            Self::Channel(channel) => Some(channel),
            _ => None,
        }
    }

    /// Whether it is a place in an RPDO.
    #[must_use]
    pub const fn is_assigned(self) -> bool {
        matches!(self, Self::Bit { .. } | Self::Channel(_))
    }
}

pub(super) fn switch_functions(configuration: &Configuration) -> impl Iterator<Item = Input> {
    inputs(configuration, FUNCTIONS, FUNCTION_TYPES, |value| match value {
        0 => Target::Unassigned,
        _ if value.unsigned_abs() <= BITS => {
            Target::Bit { number: value.unsigned_abs() as u8, low_active: value < 0 }
        }
        _ => Target::Nowhere(value),
    })
}

pub(super) fn sensors(configuration: &Configuration) -> impl Iterator<Item = Input> {
    inputs(configuration, SENSORS, SENSOR_TYPES, |value| match value {
        0 => Target::Unassigned,
        1..=CHANNELS => Target::Channel(value as u8),
        _ => Target::Nowhere(value),
    })
}

/// The inputs that come from CANopen, of two lists of parameters in step with each other.
fn inputs(
    configuration: &Configuration,
    assignments: Parameter,
    kinds: Parameter,
    target: impl Fn(i32) -> Target,
) -> impl Iterator<Item = Input> {
    let pairs = assignments.series().zip(kinds.series());
    pairs.filter(|(_, kind)| configuration.get(*kind) == FROM_CANOPEN).map(move |(assignment, kind)| Input {
        assignment,
        kind,
        target: target(configuration.get(assignment)),
    })
}
