//! Bit timings that are set segment by segment, instead of a bit rate (7.1.1, 7.2.1, 7.2.2).

use super::configuration::Configuration;
use super::parameter::{Owner, Parameter, known};

/// The parameters of one manual bit timing.
#[derive(Clone, Copy, Debug)]
pub struct BitTiming {
    /// 1 where the segments count and the bit rate does not: P4416 or P4426.
    pub switch: Parameter,
    /// The first and the last number of the segments, from the prescaler on.
    numbers: (u16, u16),
}

impl BitTiming {
    /// That of the gateway on the HEINZMANN bus: P410 to P415 with P4416 (GW-CFG-36).
    pub const OF_GATEWAY: BitTiming = BitTiming { switch: known(Owner::Gateway, 4416), numbers: (410, 415) };
    /// That of the gateway on CANopen: P420 to P425 with P4426 (GW-CFG-38).
    pub const OF_CANOPEN: BitTiming = BitTiming { switch: known(Owner::Gateway, 4426), numbers: (420, 425) };
    /// That of the governor: P410 to P414 with P4416, which is its P4409 as well (GW-NOTE-37, GW-NOTE-38).
    pub const OF_GOVERNOR: BitTiming =
        BitTiming { switch: known(Owner::Governor, 4416), numbers: (410, 414) };
    /// Every one.
    pub const ALL: [BitTiming; 3] = [Self::OF_GATEWAY, Self::OF_CANOPEN, Self::OF_GOVERNOR];

    /// Whether the segments count.
    #[must_use]
    pub const fn is_manual(&self, configuration: &Configuration) -> bool {
        configuration.get(self.switch) != 0
    }

    /// Prescaler, jump width, sampling mode and segments, in the order of their numbers.
    pub fn segments(&self) -> impl Iterator<Item = Parameter> {
        let owner = self.switch.owner();
        (self.numbers.0..=self.numbers.1).filter_map(move |number| Parameter::find(owner, number))
    }
}
