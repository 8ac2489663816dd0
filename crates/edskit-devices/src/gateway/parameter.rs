//! Parameters: whose they are, what they are called, what they may be.

use super::name::Name;
use super::series::{self, Naming, SERIES, Series};
use super::signal::SignalType;
use core::fmt;

/// Whose parameter it is.
///
/// The two units number their parameters by themselves: 16404 is an identifier in the gateway and an assignment in the
/// governor (GW-NOTE-20).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Owner {
    /// The CANopen gateway, GW.
    Gateway,
    /// The digital governor behind it, DC.
    Governor,
}

/// What a value is a number of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// A plain number.
    Number,
    /// A time that the manual gives in s, with a decimal point. The value is in ms.
    Seconds,
    /// A time in ms.
    Milliseconds,
    /// A bit rate in kbit/s.
    KbitPerSecond,
    /// A CAN-ID, which the manual writes in hexadecimal digits.
    Identifier,
    /// Bits, which the manual writes as four hexadecimal digits.
    Bits,
    /// A voltage that the manual gives in V. The value is in mV.
    Volts,
    /// A time that the manual gives in ms, with decimals. The value is in µs.
    FineMilliseconds,
}

impl Quantity {
    /// How many of the value make one of the unit that the manual uses.
    #[must_use]
    pub const fn per_unit(self) -> i32 {
        match self {
            Self::Seconds | Self::Volts | Self::FineMilliseconds => 1000,
            Self::Number | Self::Milliseconds | Self::KbitPerSecond | Self::Identifier | Self::Bits => 1,
        }
    }
}

/// What a value may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Values {
    /// From the first number to the second one.
    Between(i32, i32),
    /// One of these.
    OneOf(&'static [i32]),
}

impl Values {
    /// Whether `value` is allowed.
    #[must_use]
    pub fn contain(self, value: i32) -> bool {
        match self {
            Self::Between(low, high) => (low..=high).contains(&value),
            Self::OneOf(values) => values.contains(&value),
        }
    }
}

/// One parameter of the gateway or the governor (11.2, 11.4, 11.5; of the governor those that chapter 7.1 names).
///
/// ```
/// use edskit_devices::gateway::{Owner, Parameter};
///
/// let parameter = Parameter::find(Owner::Gateway, 16404).unwrap();
/// assert_eq!(parameter.to_string(), "P16404 CanOpTPDO5-16ID(0)");
/// let parameter = Parameter::find(Owner::Governor, 16404).unwrap();
/// assert_eq!(parameter.to_string(), "P16404 CanOpTPDO5Assign(0)");
/// assert_eq!(Parameter::by_name(Owner::Gateway, "canopenmynodeid"), Some(Parameter::MY_NODE_ID));
/// ```
#[derive(Clone, Copy)]
pub struct Parameter {
    pub(super) series: &'static Series,
    /// Less than the length of the series.
    pub(super) offset: u16,
}

impl Parameter {
    /// P427 CanOpenMyNodeID of the gateway (7.2.2; GW-CFG-41).
    pub const MY_NODE_ID: Parameter = known(Owner::Gateway, 427);
    /// P428 CanOpenPartnerNodeID of the gateway: whose heartbeat it monitors (7.2.3; GW-CFG-41).
    pub const PARTNER_NODE_ID: Parameter = known(Owner::Gateway, 428);
    /// P429 CanOpHeartBeatTxTime of the gateway (7.2.3; GW-HB-03).
    pub const HEARTBEAT_TX_TIME: Parameter = known(Owner::Gateway, 429);
    /// P430 CanOpHeartBeatRxTime of the gateway (7.2.3; GW-HB-04).
    pub const HEARTBEAT_RX_TIME: Parameter = known(Owner::Gateway, 430);
    /// P426 CanOpenBaudrate of the gateway (7.2.2; GW-CFG-37).
    pub const BIT_RATE: Parameter = known(Owner::Gateway, 426);
    /// P4426 CanOpSegmOrBaudrate of the gateway: manual bit timing instead of P426 (7.2.2; GW-CFG-37, GW-CFG-38).
    pub const MANUAL_BIT_TIMING: Parameter = known(Owner::Gateway, 4426);
    /// P14401 CanOpenSendErrors of the governor (7.1.2.1; GW-CFG-01).
    pub const SEND_ERRORS: Parameter = known(Owner::Governor, 14401);
    /// P14402 CanOpenSendStatus of the governor (7.1.2.1; GW-CFG-01).
    pub const SEND_STATUS: Parameter = known(Owner::Governor, 14402);
    /// P4810 of the governor: where the engine stop switch function comes from (7.1.4.1; GW-CFG-05).
    pub const ENGINE_STOP_TYPE: Parameter = known(Owner::Governor, 4810);

    /// P16404 to P16415 of the gateway: the CAN-ID of TPDO 5 to 16 (7.2.4; GW-CFG-13).
    #[must_use]
    pub const fn tpdo_identifier(tpdo: u8) -> Option<Parameter> {
        member(const { known(Owner::Gateway, 16404) }, tpdo, 5)
    }

    /// P16400 to P16451 of the governor: what word 0 to 3 of TPDO 4 to 16 carries (7.1.2.2; GW-PDO-12).
    #[must_use]
    pub const fn tpdo_assignment(tpdo: u8, word: u8) -> Option<Parameter> {
        match member(const { known(Owner::Governor, 16400) }, tpdo, 4) {
            Some(Parameter { series, offset: nth }) if nth < 13 && word < 4 => {
                Some(Parameter { series, offset: 4 * nth + word as u16 })
            }
            _ => None,
        }
    }

    /// P16460 to P16472 of the governor: the cycle time of TPDO 4 to 16 (7.1.3; GW-TIMING-04).
    #[must_use]
    pub const fn tpdo_cycle(tpdo: u8) -> Option<Parameter> {
        member(const { known(Owner::Governor, 16460) }, tpdo, 4)
    }

    /// P16480 to P16483 of the governor: the monitoring time of RPDO 1 to 4 (7.1.5; GW-TIMING-09).
    #[must_use]
    pub const fn rpdo_monitoring(rpdo: u8) -> Option<Parameter> {
        member(const { known(Owner::Governor, 16480) }, rpdo, 1)
    }

    /// The parameter with this number.
    #[must_use]
    pub const fn find(owner: Owner, number: u16) -> Option<Parameter> {
        series::find(owner, number)
    }

    /// The parameter of this name, in any case, as the lists or an example of the manual spell it (GW-NOTE-43).
    #[must_use]
    pub fn by_name(owner: Owner, name: &str) -> Option<Parameter> {
        parameters().filter(|parameter| parameter.owner() == owner).find(|parameter| parameter.has_name(name))
    }

    /// Whether the manual calls this parameter so, anywhere: as its lists spell it, as an example prints it, or a member of
    /// a series by the name of the series (11.1; GW-NOTE-43).
    #[must_use]
    pub fn is_called(self, name: &str) -> bool {
        let is_series = || match self.series.naming {
            Naming::Indexed(stem) => Name::plain(stem).is(name),
            _ => false,
        };
        self.has_name(name) || is_series()
    }

    fn has_name(self, name: &str) -> bool {
        let mut also = self.series.also.iter();
        self.name().is_some_and(|own| own.is(name)) || also.any(|other| Name::plain(other).is(name))
    }

    /// Whose parameter it is.
    #[must_use]
    pub const fn owner(self) -> Owner {
        self.series.owner
    }

    /// The number that the manual writes before the name.
    #[must_use]
    pub const fn number(self) -> u16 {
        self.series.first + self.offset
    }

    /// The name, where the manual gives one.
    #[must_use]
    pub fn name(self) -> Option<Name> {
        Name::of(self)
    }

    /// The user level that may change it, where the manual gives one (of gateway parameters only).
    #[must_use]
    pub const fn level(self) -> Option<u8> {
        self.series.level
    }

    /// What it may be.
    #[must_use]
    pub const fn values(self) -> Values {
        self.series.values
    }

    /// What its value is a number of.
    #[must_use]
    pub const fn quantity(self) -> Quantity {
        self.series.quantity
    }

    /// Its value where nobody has set it (see [the module](super) on defaults).
    #[must_use]
    pub const fn default_value(self) -> i32 {
        self.series.default
    }

    /// What it means, in a few words.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        self.series.meaning
    }

    /// Its type as a value of the governor, which a TPDO can carry (4.1.2; GW-PDO-05, GW-PDO-19). Our choice from the values
    /// that it can have: only the functions that are switched on and off are bits.
    pub(super) const fn signal_type(self) -> SignalType {
        match (self.series.values, self.number()) {
            (Values::Between(0, 1), 4000..) => SignalType::Bit,
            // Channels have no sign, whatever else a governor may have there.
            (_, 900..=999) => SignalType::U16,
            (Values::Between(..0, _), _) => SignalType::I16,
            (Values::Between(_, ..=0xFF), _) => SignalType::U8,
            _ => SignalType::U16,
        }
    }

    /// The number under which its value is kept: the governor's bit rate and the switch of its bit timing have two numbers
    /// each (GW-NOTE-37).
    #[must_use]
    pub const fn main(self) -> Parameter {
        match (self.series.owner, self.number()) {
            (Owner::Governor, 409) => const { known(Owner::Governor, 416) },
            (Owner::Governor, 4409) => const { known(Owner::Governor, 4416) },
            _ => self,
        }
    }

    /// The place among all parameters.
    pub(super) const fn position(self) -> usize {
        (self.series.base + self.offset) as usize
    }
}

/// Every parameter, those of the gateway first, in the order of their numbers.
pub fn parameters() -> impl Iterator<Item = Parameter> {
    SERIES.iter().flat_map(|series| Parameter { series, offset: 0 }.series())
}

/// The parameter of a number that is in the table; anything else does not compile.
pub(super) const fn known(owner: Owner, number: u16) -> Parameter {
    match series::find(owner, number) {
        Some(parameter) => parameter,
        None => panic!("the table has no parameter of this number"),
    }
}

impl Parameter {
    /// The parameters of a series from its first one on.
    pub(super) fn series(self) -> impl Iterator<Item = Parameter> {
        (0..self.series.count).map(move |offset| Parameter { offset, ..self })
    }
}

/// The member for PDO `pdo` of a series that begins with PDO `first`.
const fn member(of: Parameter, pdo: u8, first: u8) -> Option<Parameter> {
    if pdo < first || (pdo - first) as u16 >= of.series.count {
        return None;
    }
    Some(Parameter { series: of.series, offset: (pdo - first) as u16 })
}

impl PartialEq for Parameter {
    fn eq(&self, other: &Self) -> bool {
        self.position() == other.position()
    }
}

impl Eq for Parameter {}

/// `P427 CanOpenMyNodeID`, or `P812` where there is no name.
impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "P{}", self.number())?;
        match self.name() {
            Some(name) => write!(f, " {name}"),
            None => Ok(()),
        }
    }
}

impl fmt::Debug for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} {self}", self.owner())
    }
}
