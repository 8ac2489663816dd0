//! The values of all parameters.

use super::input::{self, Input};
use super::parameter::Parameter;
use super::period::{MainCycle, Period};
use super::series::{PARAMETERS, SERIES};
use core::fmt;
use edskit_types::{Bitrate, NodeId};

/// The parameters of the gateway and of the governor behind it. Each value is in the range of its parameter.
///
/// A change takes effect when the unit has stored it and starts again (chapter 7; GW-CFG-30), so that a configuration
/// is read once, at the initialisation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Configuration {
    values: [i32; PARAMETERS],
}

impl Configuration {
    /// Every parameter at its default.
    #[must_use]
    pub const fn new() -> Self {
        let mut values = [0; PARAMETERS];
        let mut nth = 0;
        while nth < SERIES.len() {
            let series = &SERIES[nth];
            let mut offset = 0;
            while offset < series.count {
                values[(series.base + offset) as usize] = series.default;
                offset += 1;
            }
            nth += 1;
        }
        Self { values }
    }

    /// The value of a parameter.
    #[must_use]
    pub const fn get(&self, parameter: Parameter) -> i32 {
        self.values[parameter.main().position()]
    }

    /// Gives a parameter a value.
    ///
    /// # Errors
    ///
    /// [`OutOfRange`] if the parameter cannot have it (11.2, 11.4, 11.5; GW-CFG-31 to GW-CFG-42); the configuration
    /// stays as it was.
    pub fn set(&mut self, parameter: Parameter, value: i32) -> Result<(), OutOfRange> {
        if !parameter.values().contain(value) {
            return Err(OutOfRange { parameter, value });
        }
        self.values[parameter.main().position()] = value;
        Ok(())
    }

    /// Gives a parameter the value that it has in another configuration.
    pub(super) fn copy(&mut self, parameter: Parameter, from: &Self) {
        if let Some(place) = self.values.get_mut(parameter.main().position()) {
            *place = from.get(parameter);
        }
    }

    /// The value of a parameter whose range is within 0 to 65535.
    fn word(&self, parameter: Parameter) -> u16 {
        self.get(parameter) as u16
    }

    /// The node-ID of the gateway, P427 (GW-CFG-41).
    #[must_use]
    pub fn node_id(&self) -> NodeId {
        // The range of P427 is that of node-IDs.
        NodeId::new(self.get(Parameter::MY_NODE_ID) as u8).unwrap_or(NodeId::MIN)
    }

    /// The node-ID of the partner whose heartbeat can be monitored, P428; 0 where there is none (GW-CFG-41).
    #[must_use]
    pub fn partner_node_id(&self) -> u8 {
        self.get(Parameter::PARTNER_NODE_ID) as u8
    }

    /// The bit rate on CANopen, P426; `None` with manual bit timing, P4426 = 1, whose bit rate the manual gives no
    /// formula for (GW-CFG-37, GW-CFG-38, GW-NOTE-41).
    #[must_use]
    pub fn bit_rate(&self) -> Option<Bitrate> {
        let manual = self.get(Parameter::MANUAL_BIT_TIMING) != 0;
        let kbit_per_s = u64::from(self.word(Parameter::BIT_RATE));
        if manual { None } else { Bitrate::from_kbit_per_s(kbit_per_s) }
    }

    /// P428, P430 and P429 as they are set: partner, its monitoring time in ms and the own cycle time in ms.
    pub(super) fn heartbeat_parameters(&self) -> [u16; 3] {
        [Parameter::PARTNER_NODE_ID, Parameter::HEARTBEAT_RX_TIME, Parameter::HEARTBEAT_TX_TIME]
            .map(|parameter| self.word(parameter))
    }

    /// How often the gateway sends its heartbeat, P429; `None` if it sends none (GW-HB-03).
    #[must_use]
    pub fn heartbeat(&self) -> Option<Period> {
        MainCycle::GATEWAY.period(self.word(Parameter::HEARTBEAT_TX_TIME))
    }

    /// Within which time the partner's heartbeat must come, P430; `None` if it is not monitored (GW-HB-04).
    #[must_use]
    pub fn heartbeat_monitoring(&self) -> Option<Period> {
        MainCycle::GATEWAY.period(self.word(Parameter::HEARTBEAT_RX_TIME))
    }

    /// How often TPDO 4 to 16 is sent; `None` if it is not, and for other numbers (GW-TIMING-04).
    #[must_use]
    pub fn tpdo_cycle(&self, tpdo: u8) -> Option<Period> {
        MainCycle::GOVERNOR.period(self.word(Parameter::tpdo_cycle(tpdo)?))
    }

    /// Within which time RPDO 1 to 4 must come; `None` if it is not monitored, and for other numbers (GW-TIMING-09).
    #[must_use]
    pub fn rpdo_monitoring(&self, rpdo: u8) -> Option<Period> {
        MainCycle::GOVERNOR.period(self.word(Parameter::rpdo_monitoring(rpdo)?))
    }

    /// The switch functions that come from CANopen, that is from RPDO 1 (7.1.4.1; GW-CFG-04). The engine stop is none
    /// of them ([`Configuration::engine_stop_from_canopen`]).
    pub fn switch_functions(&self) -> impl Iterator<Item = Input> {
        input::switch_functions(self)
    }

    /// The sensors that come from CANopen, that is from RPDO 2 to 4 (7.1.4.2; GW-CFG-07).
    pub fn sensors(&self) -> impl Iterator<Item = Input> {
        input::sensors(self)
    }

    /// Whether the engine stop is taken from CANopen, which the manual forbids: it must be hard wired (7.1.4.1;
    /// GW-CFG-05).
    #[must_use]
    pub const fn engine_stop_from_canopen(&self) -> bool {
        self.get(Parameter::ENGINE_STOP_TYPE) == input::FROM_CANOPEN
    }
}

impl Default for Configuration {
    fn default() -> Self {
        Self::new()
    }
}

/// A value that a parameter cannot have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutOfRange {
    /// The parameter.
    pub parameter: Parameter,
    /// The value.
    pub value: i32,
}

/// `P427 CanOpenMyNodeID cannot be 128, only 1 to 127`.
impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parameter = self.parameter;
        write!(f, "{parameter} cannot be {}, only {}", parameter.amount(self.value), parameter.allowed())
    }
}

impl core::error::Error for OutOfRange {}
