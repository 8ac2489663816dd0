//! The governor behind the gateway.

use crate::config::KnownSignals;
use edskit_devices::gateway::{Engine, Governor, Inputs, SignalType, Signals};

/// A governor with an engine and the signals that a parameter file describes, so that the PDOs are those that `edskit
/// config check` shows. Where the engine has no value for a signal, it is 0.
#[derive(Debug, Default)]
pub(crate) struct DescribedEngine {
    pub(super) engine: Engine,
    pub(crate) signals: KnownSignals,
}

impl Signals for DescribedEngine {
    fn signal_type(&self, number: u16) -> Option<SignalType> {
        self.signals.signal_type(number)
    }
}

impl Governor for DescribedEngine {
    fn start(&mut self) {
        self.engine.start();
    }

    fn main_cycle(&mut self, inputs: &Inputs<'_>) {
        self.engine.main_cycle(inputs);
    }

    /// A signal that is described with 8 bits carries no more of the engine's value.
    fn value(&self, number: u16) -> u16 {
        let value = self.engine.value(number);
        match self.signals.signal_type(number) {
            Some(SignalType::U8) => u16::from(value as u8),
            Some(SignalType::I8) => i16::from(value as i8) as u16,
            _ => value,
        }
    }

    fn engine_status(&self) -> u8 {
        self.engine.engine_status()
    }

    fn errors(&self) -> u128 {
        self.engine.errors()
    }
}
