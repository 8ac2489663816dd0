//! The parameters of the governor that TPDOs can carry.

use edskit_devices::gateway::{NAMED_SIGNALS, NamedSignals, SignalType, Signals};
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
}

/// What the file describes, besides what the manual names.
#[derive(Default, Debug)]
pub(crate) struct KnownSignals {
    pub(super) declared: BTreeMap<u16, Declared>,
}

impl KnownSignals {
    /// Whether anything is known of a parameter.
    pub(super) fn knows(&self, number: u16) -> bool {
        self.declared.contains_key(&number) || NamedSignals.signal_type(number).is_some()
    }

    /// The name, if one is known.
    pub(crate) fn name(&self, number: u16) -> Option<&str> {
        let named = || NAMED_SIGNALS.iter().find(|signal| signal.number == number).map(|signal| signal.name);
        let declared = self.declared.get(&number).and_then(|declared| declared.name.as_deref());
        declared.or_else(named)
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
        Some(declared.or_else(|| NamedSignals.signal_type(number)).unwrap_or(SignalType::U16))
    }
}
