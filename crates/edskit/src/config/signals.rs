//! The parameters of the governor that TPDOs can carry.

use edskit_devices::gateway::{NamedSignals, SignalType, Signals, signal_name};
use edskit_model::Span;
use std::collections::BTreeMap;

/// Words for the types.
pub(super) const TYPES: [(&str, SignalType); 5] = [
    ("u8", SignalType::U8),
    ("i8", SignalType::I8),
    ("u16", SignalType::U16),
    ("i16", SignalType::I16),
    ("bit", SignalType::Bit),
];

/// A parameter that the file describes.
#[derive(Debug)]
pub(super) struct Declared {
    pub(super) name: Option<String>,
    pub(super) signal_type: SignalType,
    /// Where.
    pub(super) span: Span,
    /// Where its type stands.
    pub(super) type_span: Span,
}

/// What the file describes, besides what the manual names.
#[derive(Default, Debug)]
pub(crate) struct KnownSignals {
    pub(super) declared: BTreeMap<u16, Declared>,
}

impl KnownSignals {
    /// Whether anything is known of a parameter.
    pub(crate) fn knows(&self, number: u16) -> bool {
        self.declared.contains_key(&number) || NamedSignals.signal_type(number).is_some()
    }

    /// The name, if one is known.
    pub(crate) fn name(&self, number: u16) -> Option<String> {
        let declared = self.declared.get(&number).and_then(|declared| declared.name.clone());
        declared.or_else(|| signal_name(number).map(|name| name.to_string()))
    }

    /// Number and name, as far as known.
    pub(super) fn title(&self, number: u16) -> String {
        match self.name(number) {
            Some(name) => format!("{number} {name}"),
            None => number.to_string(),
        }
    }
}

impl Signals for KnownSignals {
    /// A parameter of which nothing is known is taken to exist and to have 16 bits without sign: the file need not
    /// list the parameters of the governor, and a TPDO too many in the check is better than one too few.
    fn signal_type(&self, number: u16) -> Option<SignalType> {
        let declared = self.declared.get(&number).map(|declared| declared.signal_type);
        let named = NamedSignals.signal_type(number);
        // A bit that the manual names stays one (GW-PDO-19); the types of the others are a choice.
        let is_bit = named == Some(SignalType::Bit) && signal_name(number).is_some();
        Some(declared.filter(|_| !is_bit).or(named).unwrap_or(SignalType::U16))
    }
}
