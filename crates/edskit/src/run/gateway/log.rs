//! What is told of a running gateway.

use super::scenario::Action;
use super::scenario::words::{UNITS, word_for};
use edskit_devices::gateway::{
    Amount, CanOpenError, EepromErrors, Event, GatewayError, INITIALISATION_ATTEMPTS, Owner, Parameter,
    Period, measured_value,
};
use edskit_runtime::Microseconds;
use serde::Serialize;

/// One line.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(super) struct Line {
    #[serde(flatten)]
    what: What,
    /// Since the start.
    #[serde(serialize_with = "in_seconds")]
    time: Microseconds,
}

/// What a line tells.
#[derive(Clone, PartialEq, Debug, Serialize)]
#[serde(tag = "event", rename_all = "kebab-case")]
pub(super) enum What {
    /// Something happened to the bus.
    Bus { message: String },
    /// The gateway is in another state.
    State { state: String },
    /// The program of the gateway has started; the bit rate is in kbit/s, and unknown with manual bit timing.
    GatewayStarted { node_id: u8, bit_rate: Option<u16> },
    /// The program of the governor has started.
    GovernorStarted,
    /// A unit has lost its supply.
    Off { unit: &'static str },
    /// An attempt to initialise the gateway has failed.
    InitialisationFailed { attempt: u8, most: u8, reason: String },
    /// A time is longer than the longest (GW-NOTE-08).
    TimeCapped { parameter: u16, name: String, set_ms: u16, effective_ms: f64 },
    /// The two units do not hear each other, because of their parameters.
    UnitsApart { reason: String },
    /// An error has come; 3099 has a value.
    Error {
        number: u16,
        name: Option<&'static str>,
        meaning: String,
        #[serde(skip_serializing_if = "Option::is_none")]
        value: Option<u16>,
    },
    /// An error has gone.
    ErrorGone { number: u16, name: Option<&'static str> },
    /// The error memory cannot be written.
    NotStored,
    /// So many events came too fast to be told.
    EventsLost { count: u32 },
    /// The scenario has read a parameter or a measured value.
    Value {
        unit: &'static str,
        number: u16,
        name: Option<String>,
        value: Number,
        /// With its unit.
        #[serde(skip)]
        amount: String,
    },
    /// An action of the scenario was carried out, or had no effect.
    Step { key: &'static str, value: String, without_effect: Option<String> },
}

/// A number in the unit of the manual.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
#[serde(untagged)]
pub(super) enum Number {
    Whole(i32),
    Decimal(f64),
}

impl From<Amount> for Number {
    fn from(amount: Amount) -> Self {
        match amount.quantity().per_unit() {
            1 => Self::Whole(amount.value()),
            parts => Self::Decimal(f64::from(amount.value()) / f64::from(parts)),
        }
    }
}

impl Line {
    pub(super) fn new(time: Microseconds, what: What) -> Self {
        Self { what, time }
    }

    /// Its time, where it tells of another state.
    pub(super) fn begin_of_state(&self) -> Option<Microseconds> {
        matches!(self.what, What::State { .. }).then_some(self.time)
    }

    /// `    0.231250  pre-operational`
    pub(super) fn text(&self) -> String {
        format!("{:>12}  {}", seconds(self.time), self.what.text())
    }
}

/// Seconds with all microseconds.
fn seconds(time: Microseconds) -> String {
    format!("{}.{:06}", time.0 / 1_000_000, time.0 % 1_000_000)
}

fn in_seconds<S: serde::Serializer>(time: &Microseconds, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(time.0 as f64 / 1e6)
}

impl What {
    /// What an event of the device tells, but for the start of the gateway, whose parameters it does not know.
    pub(super) fn of(event: Event) -> Self {
        match event {
            Event::Off(unit) => Self::Off { unit: word_for(&UNITS, unit) },
            Event::Started(_) => Self::GovernorStarted,
            Event::State(state) => Self::State { state: state.to_string() },
            Event::InitialisationFailed { attempt, reason } => Self::InitialisationFailed {
                attempt,
                most: INITIALISATION_ATTEMPTS,
                reason: reason.to_string(),
            },
            Event::Error(error, is_present) => Self::gateway_error(error, is_present),
            Event::CanOpenError(error, is_present) => Self::can_open_error(error, is_present),
            Event::EepromErrors(errors) => Self::Error {
                number: EepromErrors::NUMBER,
                name: measured_value(EepromErrors::NUMBER),
                meaning: errors.to_string(),
                value: Some(errors.0),
            },
            Event::NotStored => Self::NotStored,
            Event::Lost(count) => Self::EventsLost { count },
        }
    }

    fn gateway_error(error: GatewayError, is_present: bool) -> Self {
        Self::error(error.number(), Some(error.name()), error.meaning(), is_present)
    }

    fn can_open_error(error: CanOpenError, is_present: bool) -> Self {
        Self::error(error.number(), Some(error.name()), error.meaning(), is_present)
    }

    /// An error of the governor, which the manual of the gateway does not name.
    pub(super) fn governor_error(number: u16, is_present: bool) -> Self {
        Self::error(number, None, "error of the engine or a sensor", is_present)
    }

    fn error(number: u16, name: Option<&'static str>, meaning: &'static str, is_present: bool) -> Self {
        match is_present {
            true => Self::Error { number, name, meaning: meaning.to_owned(), value: None },
            false => Self::ErrorGone { number, name },
        }
    }

    pub(super) fn capped(parameter: Parameter, period: Period) -> Self {
        Self::TimeCapped {
            parameter: parameter.number(),
            name: parameter.name().map(|name| name.to_string()).unwrap_or_default(),
            set_ms: period.setting_ms,
            effective_ms: f64::from(period.micros()) / 1000.0,
        }
    }

    /// What a unit shows under a number.
    pub(super) fn value(unit: Owner, number: u16, name: Option<String>, amount: Amount) -> Self {
        let (unit, value) = (word_for(&UNITS, unit), Number::from(amount));
        Self::Value { unit, number, name, value, amount: amount.to_string() }
    }

    pub(super) fn step(action: Action, without_effect: Option<String>) -> Self {
        Self::Step { key: action.key(), value: action.value(), without_effect }
    }

    fn text(&self) -> String {
        match self {
            Self::Bus { message } => message.clone(),
            Self::State { state } => state.clone(),
            Self::GatewayStarted { node_id, bit_rate: Some(bit_rate) } => {
                format!("gateway started, node-ID {node_id}, {bit_rate} kbit/s")
            }
            Self::GatewayStarted { node_id, bit_rate: None } => {
                format!("gateway started, node-ID {node_id}, manual bit timing")
            }
            Self::GovernorStarted => "governor started".to_owned(),
            Self::Off { unit } => format!("{unit} off"),
            Self::InitialisationFailed { attempt, most, reason } => {
                let outcome =
                    if attempt == most { "; it stays undefined until errors are cleared" } else { "" };
                format!("initialisation failed, attempt {attempt} of {most}: {reason}{outcome}")
            }
            Self::TimeCapped { parameter, name, set_ms, effective_ms } => {
                format!("P{parameter} {name} = {set_ms} ms is too long and counts as {effective_ms} ms")
            }
            Self::UnitsApart { reason } => format!("gateway and governor do not hear each other: {reason}"),
            Self::Error { number, name, meaning, value } => {
                let value = value.map(|value| format!(" = {value:04X}h")).unwrap_or_default();
                format!("error {}{value}: {meaning}", titled(*number, *name))
            }
            Self::ErrorGone { number, name } => format!("error {} has gone", titled(*number, *name)),
            Self::Value { unit, number, name, amount, .. } => {
                format!("{unit} {} = {amount}", titled(*number, name.as_deref()))
            }
            Self::NotStored => "the error memory cannot be written".to_owned(),
            Self::EventsLost { count: 1 } => "1 event came too fast to be told".to_owned(),
            Self::EventsLost { count } => format!("{count} events came too fast to be told"),
            Self::Step { key, value, without_effect } => {
                let action = if value.is_empty() { String::new() } else { format!(" {value}") };
                let reason = without_effect.as_ref().map(|reason| format!(" (without effect: {reason})"));
                format!("scenario: {key}{action}{}", reason.unwrap_or_default())
            }
        }
    }
}

/// `3074 ErrCanOpen`
fn titled(number: u16, name: Option<&str>) -> String {
    name.map_or_else(|| number.to_string(), |name| format!("{number} {name}"))
}
