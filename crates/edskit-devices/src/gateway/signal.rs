//! What a word of a TPDO can carry: the parameters of the governor.

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

/// A governor that has [`NAMED_SIGNALS`] and nothing else.
#[derive(Clone, Copy, Debug, Default)]
pub struct NamedSignals;

impl Signals for NamedSignals {
    fn signal_type(&self, number: u16) -> Option<SignalType> {
        NAMED_SIGNALS.iter().find(|signal| signal.number == number).map(|signal| signal.signal_type)
    }
}
