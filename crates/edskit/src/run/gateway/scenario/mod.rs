//! A scenario: what happens to the gateway, and when (docs/gateway.md).

mod reading;
mod shown;
mod value;
pub(super) mod words;

use edskit_devices::gateway::{Fault, Owner, Parameter, State};
use edskit_model::Span;
use edskit_runtime::Microseconds;
use edskit_types::NmtCommand;
pub(super) use reading::read;
use words::{COMMANDS, NMT, UNITS, fault_name, word_for};

/// What happens at one time.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Step {
    /// Since the start.
    pub(super) at: Microseconds,
    /// Where the time stands in the file.
    span: Span,
    /// In the order in which they are carried out.
    pub(super) actions: Vec<Action>,
}

/// Something that is done to the gateway, its governor, or the bus.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Action {
    /// A unit loses its supply.
    Off(Owner),
    /// A unit gets its supply.
    On(Owner),
    /// A unit is reset.
    Reset(Owner),
    /// The PC tool changes a parameter.
    Set(Parameter, i32),
    /// The PC tool has a unit store its parameters.
    Store(Owner),
    /// A PC program with this identification number is connected.
    Tool(u16),
    /// The supply voltage, in mV.
    Supply(u16),
    /// What the next start finds in the EEPROM: the bits of 3099.
    Eeprom(u8),
    /// The governor's own speed setpoint, in 1/min.
    Setpoint(u16),
    /// The engine's load, in 0.1 %.
    Load(u16),
    /// Whether the engine is to run.
    Running(bool),
    /// An error of the engine or its sensors comes, by its number.
    EngineError(u16),
    /// Such an error goes.
    EngineErrorGone(u16),
    /// A fault comes.
    Inject(Fault),
    /// A fault goes.
    Remove(Fault),
    /// The PC tool clears the errors.
    ClearErrors,
    /// The governor commands a state.
    Command(State),
    /// The NMT master commands all nodes.
    Nmt(NmtCommand),
    /// The PC tool reads a parameter or a measured value, by its number.
    Read(Owner, u16),
}

impl Action {
    /// The key of the scenario.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::Off(_) => "off",
            Self::On(_) => "on",
            Self::Reset(_) => "reset",
            Self::Set(parameter, _) => word_for(&UNITS, parameter.owner()),
            Self::Store(_) => "store",
            Self::Tool(_) => "pc-tool",
            Self::Supply(_) => "supply",
            Self::Eeprom(_) => "eeprom",
            Self::Setpoint(_) | Self::Load(_) | Self::Running(_) => "engine",
            Self::EngineError(_) => "engine-error",
            Self::EngineErrorGone(_) => "engine-error-gone",
            Self::Inject(_) => "inject",
            Self::Remove(_) => "remove",
            Self::ClearErrors => "clear-errors",
            Self::Command(_) => "command",
            Self::Nmt(_) => "nmt",
            Self::Read(..) => "read",
        }
    }

    /// The value behind the key, with its unit.
    pub(super) fn value(self) -> String {
        match self {
            Self::Off(unit) | Self::On(unit) | Self::Reset(unit) | Self::Store(unit) => {
                word_for(&UNITS, unit).to_owned()
            }
            Self::Set(parameter, value) => format!("{parameter} = {}", parameter.amount(value)),
            Self::Tool(identifier) => identifier.to_string(),
            Self::Supply(millivolts) => format!("{} V", f64::from(millivolts) / 1000.0),
            Self::Eeprom(code) => format!("{code:02X}h"),
            Self::Setpoint(speed) => format!("setpoint = {speed}/min"),
            Self::Load(load) => format!("load = {} %", f64::from(load) / 10.0),
            Self::Running(is_running) => format!("running = {is_running}"),
            Self::EngineError(number) | Self::EngineErrorGone(number) => number.to_string(),
            Self::Inject(fault) | Self::Remove(fault) => fault_name(fault).to_owned(),
            Self::ClearErrors => String::new(),
            Self::Command(state) => word_for(&COMMANDS, state).to_owned(),
            Self::Nmt(command) => word_for(&NMT, command).to_owned(),
            Self::Read(unit, number) => format!("{} {number}", word_for(&UNITS, unit)),
        }
    }
}

#[cfg(test)]
mod tests;
