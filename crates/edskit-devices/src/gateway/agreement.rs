//! What gateway and governor must agree on to hear each other on the HEINZMANN bus (7.1.1, 7.2.1).
//!
//! The check of a parameter file, the DCF and the live device all ask the same functions.

use super::bit_timing::BitTiming;
use super::configuration::Configuration;
use super::parameter::{Owner, Parameter, known};

/// Whether each unit communicates with the other one (GW-CFG-34).
pub(super) const GATEWAY_LINK: Parameter = known(Owner::Gateway, 4400);
pub(super) const GOVERNOR_LINK: Parameter = known(Owner::Governor, 4406);
/// What each unit takes itself for.
const GATEWAY_NUMBER: Parameter = known(Owner::Gateway, 401);
pub(super) const GOVERNOR_NUMBER: Parameter = known(Owner::Governor, 401);
/// The bit rates of the HEINZMANN bus (GW-CFG-35, GW-NOTE-37).
const GATEWAY_RATE: Parameter = known(Owner::Gateway, 416);
const GOVERNOR_RATE: Parameter = known(Owner::Governor, 416);

/// What has to be equal: a parameter of the gateway, and one of the governor (GW-CFG-32, GW-CFG-33).
const NUMBERS: [(Parameter, Parameter); 2] =
    [(GATEWAY_NUMBER, known(Owner::Governor, 403)), (known(Owner::Gateway, 402), GOVERNOR_NUMBER)];

/// Something in the parameters that keeps the units from hearing each other, so that there is no initialisation
/// (GW-CFG-48).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hindrance {
    /// P4400 of the gateway or P4406 of the governor is 0 (GW-CFG-34).
    SwitchedOff(Parameter),
    /// The node numbers of one of the units disagree (GW-CFG-32, GW-CFG-33).
    NodeNumbers {
        /// P401 or P402 of the gateway.
        gateway: Parameter,
        /// P403 or P401 of the governor.
        governor: Parameter,
    },
    /// The bit rates disagree (GW-CFG-46).
    BitRates {
        /// P416 of the gateway.
        gateway: Parameter,
        /// P416 of the governor, which is its P409 as well.
        governor: Parameter,
    },
}

impl Configuration {
    /// What keeps gateway and governor from hearing each other; nothing where the governor initialises the gateway.
    ///
    /// ```
    /// use edskit_devices::gateway::{Configuration, Hindrance, Owner, Parameter};
    /// let mut configuration = Configuration::new();
    /// assert_eq!(configuration.hindrances().count(), 0);
    /// let governor = Parameter::find(Owner::Governor, 409).unwrap();
    /// configuration.set(governor, 500)?;
    /// assert!(matches!(configuration.hindrances().next(), Some(Hindrance::BitRates { .. })));
    /// # Ok::<(), edskit_devices::gateway::OutOfRange>(())
    /// ```
    pub fn hindrances(&self) -> impl Iterator<Item = Hindrance> {
        let links = [GATEWAY_LINK, GOVERNOR_LINK].into_iter();
        let off = links.filter(|link| self.get(*link) == 0).map(Hindrance::SwitchedOff);
        let numbers =
            NUMBERS.into_iter().filter(|(gateway, governor)| self.get(*gateway) != self.get(*governor));
        let numbers = numbers.map(|(gateway, governor)| Hindrance::NodeNumbers { gateway, governor });
        let rates = Hindrance::BitRates { gateway: GATEWAY_RATE, governor: GOVERNOR_RATE };
        off.chain(numbers).chain(self.bit_rates_differ().then_some(rates))
    }

    /// Whether the two units have different bit rates on the HEINZMANN bus (GW-CFG-46). What a manual bit timing comes
    /// to cannot be computed, and is taken to fit (GW-NOTE-48).
    #[must_use]
    pub fn bit_rates_differ(&self) -> bool {
        let is_manual =
            [BitTiming::OF_GATEWAY, BitTiming::OF_GOVERNOR].iter().any(|timing| timing.is_manual(self));
        !is_manual && self.get(GATEWAY_RATE) != self.get(GOVERNOR_RATE)
    }
}
