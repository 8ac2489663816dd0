//! What a word of a TPDO can carry: the parameters of the governor.

use super::measured::measured_value;
use super::name::Name;
use super::parameter::{Owner, Parameter};

/// Type of a governor parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SignalType {
    /// 8 bits without sign.
    U8,
    /// 8 bits with sign.
    I8,
    /// 16 bits without sign.
    U16,
    /// 16 bits with sign.
    I16,
    /// A single bit, which no TPDO can carry (4.1.2; GW-PDO-05).
    Bit,
}

impl SignalType {
    /// Whether a TPDO can carry it: 8 bits are widened to 16, single bits are left out (GW-PDO-05).
    #[must_use]
    pub const fn is_analogue(self) -> bool {
        !matches!(self, Self::Bit)
    }

    /// Whether it has a sign, so that it is an entry of 2002h and not of 2001h (GW-PDO-06).
    #[must_use]
    pub const fn is_signed(self) -> bool {
        matches!(self, Self::I8 | Self::I16)
    }
}

/// Which parameters the governor has.
pub trait Signals {
    /// The type of a parameter; `None` if there is no such parameter. 0 is never asked for.
    fn signal_type(&self, number: u16) -> Option<SignalType>;
}

/// A parameter of the governor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signal {
    /// The number.
    pub number: u16,
    /// The name.
    pub name: &'static str,
    /// The type.
    pub signal_type: SignalType,
}

/// The parameters that the manual names as examples (7.1.2.2; GW-PDO-10, GW-PDO-11).
///
/// It gives no types. All are taken as 16 bits without sign, but for the temperature, which has one.
pub const NAMED_SIGNALS: &[Signal] = &[
    Signal { number: 2000, name: "Speed", signal_type: SignalType::U16 },
    Signal { number: 2031, name: "SpeedSetp", signal_type: SignalType::U16 },
    Signal { number: 2300, name: "ActPos", signal_type: SignalType::U16 },
    Signal { number: 2330, name: "ActPosSetpoint", signal_type: SignalType::U16 },
    Signal { number: 2905, name: "OilPressure", signal_type: SignalType::U16 },
    Signal { number: 2908, name: "ChargeAirTemp", signal_type: SignalType::I16 },
    Signal { number: 2917, name: "CurrentLoad", signal_type: SignalType::U16 },
];

/// The errors and states of the governor that the manual names (ch. 3, 9.5, 9.6; GW-PDO-19).
const NAMED_ERRORS: [(u16, &str); 4] =
    [(3005, "ErrSetpointExtern"), (3070, "ErrCanBus"), (3071, "ErrCanComm"), (3074, "ErrCanOpen")];

/// Whether a number is one of the governor's errors. That all from 3000 on are, as in the gateway, and where they end is
/// our choice (9.1; GW-NOTE-05).
const fn is_error(number: u16) -> bool {
    matches!(number, 3000..=3094)
}

/// Whether a number is a state or an error of CANopen, which both units show (ch. 3, 9.5).
pub(super) const fn is_of_canopen(number: u16) -> bool {
    matches!(number, 12401..=12404 | 12411..=12415 | 12419..=12424)
}

/// The name that the manual gives to a parameter or a measured value of the governor (7.1, 9.5, 9.6).
///
/// ```
/// use edskit_devices::gateway::signal_name;
/// let name = |number| signal_name(number).map(|name| name.to_string());
/// assert_eq!(name(2000).as_deref(), Some("Speed"));
/// assert_eq!(name(12401).as_deref(), Some("CanOpStopped"));
/// assert_eq!(name(16404).as_deref(), Some("CanOpTPDO5Assign(0)"));
/// assert!(name(2950).is_none());
/// ```
#[must_use]
pub fn signal_name(number: u16) -> Option<Name> {
    let named = NAMED_SIGNALS.iter().map(|signal| (signal.number, signal.name)).chain(NAMED_ERRORS);
    if let Some((_, name)) = named.into_iter().find(|(own, _)| *own == number) {
        return Some(Name::plain(name));
    }
    match Parameter::find(Owner::Governor, number) {
        Some(parameter) => parameter.name(),
        None if is_of_canopen(number) => measured_value(number).map(Name::plain),
        None => None,
    }
}

/// A governor that has what the manual names, and nothing else: [`NAMED_SIGNALS`], its own parameters, and its states and
/// errors, which are single bits (GW-PDO-19).
#[derive(Clone, Copy, Debug, Default)]
pub struct NamedSignals;

impl Signals for NamedSignals {
    fn signal_type(&self, number: u16) -> Option<SignalType> {
        if let Some(signal) = NAMED_SIGNALS.iter().find(|signal| signal.number == number) {
            return Some(signal.signal_type);
        }
        if is_error(number) || is_of_canopen(number) {
            return Some(SignalType::Bit);
        }
        // Of the lists that go on to the next hundred, those members that the manual names.
        let is_named = |parameter: &Parameter| parameter.name().is_some() || [810, 4810].contains(&number);
        Parameter::find(Owner::Governor, number).filter(is_named).map(Parameter::signal_type)
    }
}
