//! What the governor gets from CANopen, with the error conditions of 9.6 and 9.7.

use super::configuration::Configuration;
use super::input::{CHANNELS, Input, Target};
use super::monitoring::Monitoring;
use super::parameter::Parameter;

/// The error of the first sensor, P3005 ErrSetpointExtern (9.6; GW-APP-11). That the following sensors have the
/// following numbers is our choice.
const FIRST_SENSOR_ERROR: u16 = 3005;
/// The errors below the gateway's own, 3070, are the sensors'.
const SENSOR_ERRORS: u16 = 3070 - FIRST_SENSOR_ERROR;

/// What CANopen delivers to the governor at one main cycle.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    pub(super) configuration: &'a Configuration,
    pub(super) reception: Reception,
}

/// The words of the RPDOs, and whether they can be believed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reception {
    /// Word 1 of RPDO 1.
    pub(super) switches: u16,
    /// Word 3 of RPDO 1, the error flags (GW-APP-07).
    pub(super) flags: u16,
    /// The words of RPDO 2 to 4.
    pub(super) channels: [u16; CHANNELS as usize],
    pub(super) is_operational: bool,
    /// Those of RPDO 1 to 4.
    pub(super) monitoring: [Monitoring; 4],
    /// Whether a monitoring time is set.
    pub(super) is_monitored: [bool; 4],
    /// Whether the heartbeat's monitoring has triggered.
    pub(super) heartbeat_is_missing: bool,
}

/// A sensor whose value comes from CANopen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sensor {
    /// Its value, in the governor's internal range.
    Valid(u16),
    /// It is monitored and none of its RPDOs has come since operational began, so that it has no value. It is no error until
    /// the monitoring triggers: the governor goes on with what it used before (9.6; GW-NOTE-47).
    Awaited,
    /// One of the conditions of 9.6 holds, so that the governor treats it as broken.
    Faulty,
}

impl Inputs<'_> {
    /// The sensor of this assignment, P900 and following; `None` where it does not come from CANopen.
    #[must_use]
    pub fn sensor(&self, assignment: Parameter) -> Option<Sensor> {
        let input = self.configuration.sensors().find(|input| input.assignment == assignment)?;
        self.reception.sensor(input.target.channel()?)
    }

    /// The switch function of this assignment, P811 and following; `None` where it does not come from CANopen.
    ///
    /// It is inactive where it is not assigned, where one of the conditions of 9.7 holds, and before the first RPDO 1 since
    /// operational began, low-active or not: the bit has not been received (7.1.4.1, 9.7; GW-APP-12, GW-APP-13, GW-NOTE-15).
    #[must_use]
    pub fn switch_function(&self, assignment: Parameter) -> Option<bool> {
        let input = self.configuration.switch_functions().find(|input| input.assignment == assignment)?;
        Some(match input.target {
            Target::Bit { number, low_active } if self.reception.has_switches() => {
                // Bit number 1 is the least significant one (GW-NOTE-12).
                let bit = self.reception.switches >> (number - 1) & 1 == 1;
                bit != low_active
            }
            _ => false,
        })
    }

    /// The errors of the sensors that come from CANopen, bit k for error 3000 + k (9.6; GW-APP-11).
    #[must_use]
    pub fn errors(&self) -> u128 {
        let faulty = self.configuration.sensors().filter(|input| self.is_faulty(input));
        let bits =
            faulty.filter_map(|input| sensor_error(input.assignment)).map(|number| 1 << (number - 3000));
        bits.fold(0, |errors: u128, bit: u128| errors | bit)
    }

    fn is_faulty(&self, input: &Input) -> bool {
        let sensor = input.target.channel().and_then(|channel| self.reception.sensor(channel));
        sensor == Some(Sensor::Faulty)
    }
}

/// The error of the sensor with this assignment, for as many as have numbers below the gateway's errors.
fn sensor_error(assignment: Parameter) -> Option<u16> {
    let nth = assignment.offset;
    (nth < SENSOR_ERRORS).then_some(FIRST_SENSOR_ERROR + nth)
}

impl Reception {
    /// The monitoring of RPDO 1 to 4.
    fn monitoring_of(&self, rpdo: u8) -> (Monitoring, bool) {
        let place = usize::from(rpdo).wrapping_sub(1);
        let monitoring = self.monitoring.get(place).copied().unwrap_or_default();
        (monitoring, self.is_monitored.get(place).copied().unwrap_or_default())
    }

    /// What a channel delivers; `None` for a channel that does not exist (9.6; GW-APP-10, GW-NOTE-16).
    fn sensor(&self, channel: u8) -> Option<Sensor> {
        let place = usize::from(channel).checked_sub(1)?;
        let value = *self.channels.get(place)?;
        let (carrier, is_monitored) = self.monitoring_of(2 + (channel - 1) / 4);
        let is_faulty = !self.is_operational
            || carrier.is_triggered()
            || (!is_monitored && !carrier.has_ever_arrived())
            || self.flags >> place & 1 == 1
            || self.monitoring_of(1).0.is_triggered()
            || self.heartbeat_is_missing;
        Some(match carrier.has_ever_arrived() {
            _ if is_faulty => Sensor::Faulty,
            true => Sensor::Valid(value),
            false => Sensor::Awaited,
        })
    }

    /// Whether the switch functions have come and can be believed (9.7; GW-APP-12). Without monitoring it is an error that
    /// they have never come; with it they have no value until then.
    fn has_switches(&self) -> bool {
        let (carrier, _) = self.monitoring_of(1);
        self.is_operational
            && carrier.has_ever_arrived()
            && !carrier.is_triggered()
            && !self.heartbeat_is_missing
    }
}
