//! The state machine of CANopen in the gateway (chapter 3).

use core::fmt;
use edskit_types::NmtState;

/// A state of the gateway on CANopen (3; GW-NMT-01).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum State {
    /// No communication: after a reset, and after certain faults (GW-NMT-02).
    Undefined,
    /// The initialisation by the governor runs, there is no communication on CANopen yet.
    Init,
    /// NMT, SDO and heartbeat.
    PreOperational,
    /// NMT, SDO, heartbeat and PDOs.
    Operational,
    /// NMT and heartbeat.
    Stopped,
}

/// Who commands a change of state (3; GW-NMT-03).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Commander {
    /// The digital governor, over the HEINZMANN bus.
    Governor,
    /// The NMT master on CANopen.
    Master,
    /// The gateway itself, as the reaction to an error (9.4, 9.5).
    Gateway,
}

impl State {
    /// The states in the order of P12400, whose values the manual does not give.
    pub const ALL: [State; 5] =
        [Self::Undefined, Self::Init, Self::PreOperational, Self::Operational, Self::Stopped];

    /// Whether a command to go to `to` is followed in this state (3, 9.4, 9.5; GW-NMT-04, GW-NMT-06 to GW-NMT-12).
    ///
    /// A direct way from undefined to pre-operational is not described, so there is none (GW-NOTE-02).
    #[must_use]
    pub const fn follows(self, commander: Commander, to: State) -> bool {
        let communicates = self.communicates();
        match (commander, to) {
            (_, Self::Undefined) => matches!(commander, Commander::Governor | Commander::Gateway),
            (Commander::Governor, Self::Init) => true,
            (Commander::Governor, Self::PreOperational) => !matches!(self, Self::Undefined),
            (Commander::Governor, Self::Operational | Self::Stopped) => false,
            (Commander::Master, _) => communicates,
            // Faults of the CANopen bus lead to pre-operational, an overflow of the SDO transmit buffer stops.
            (Commander::Gateway, Self::PreOperational | Self::Stopped) => communicates,
            (Commander::Gateway, Self::Init | Self::Operational) => false,
        }
    }

    /// Whether there is communication on CANopen.
    #[must_use]
    pub const fn communicates(self) -> bool {
        self.nmt().is_some()
    }

    /// The NMT state of CiA 301 that it is, where there is communication.
    #[must_use]
    pub const fn nmt(self) -> Option<NmtState> {
        match self {
            Self::Undefined | Self::Init => None,
            Self::PreOperational => Some(NmtState::PreOperational),
            Self::Operational => Some(NmtState::Operational),
            Self::Stopped => Some(NmtState::Stopped),
        }
    }

    /// The measured value that is 1 in this state, 12401 to 12404; none shows that the state is undefined
    /// (3, 11.3; GW-APP-05).
    #[must_use]
    pub const fn measured_value(self) -> Option<u16> {
        match self {
            Self::Undefined => None,
            Self::Stopped => Some(12401),
            Self::Init => Some(12402),
            Self::PreOperational => Some(12403),
            Self::Operational => Some(12404),
        }
    }
}

/// `pre-operational`.
impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Undefined => "undefined",
            Self::Init => "init",
            Self::PreOperational => "pre-operational",
            Self::Operational => "operational",
            Self::Stopped => "stopped",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Commander::{Gateway, Governor, Master};
    use super::State::{Init, Operational, PreOperational, Stopped, Undefined};
    use super::*;

    /// Who can lead from each state to each, in the order of [`State::ALL`].
    fn ways(commander: Commander) -> [[bool; 5]; 5] {
        State::ALL.map(|from| State::ALL.map(|to| from.follows(commander, to)))
    }

    // GW-NMT-01, GW-NMT-03, GW-NMT-06, GW-NMT-07, GW-NMT-08, GW-NMT-09, GW-NMT-10, GW-NMT-11, GW-NMT-12, GW-NOTE-02
    #[test]
    fn the_whole_graph() {
        let (no, yes) = (false, true);
        assert_eq!(
            ways(Governor),
            [
                [yes, yes, no, no, no], // undefined
                [yes, yes, yes, no, no],
                [yes, yes, yes, no, no],
                [yes, yes, yes, no, no],
                [yes, yes, yes, no, no],
            ]
        );
        assert_eq!(ways(Master)[..2], [[no; 5]; 2], "GW-NMT-04: commands are ignored there");
        assert_eq!(ways(Master)[2..], [[no, yes, yes, yes, yes]; 3]);
        assert_eq!(ways(Gateway)[..2], [[yes, no, no, no, no]; 2]);
        assert_eq!(ways(Gateway)[2..], [[yes, no, yes, no, yes]; 3]);
    }

    // GW-APP-05
    #[test]
    fn states_are_shown_by_measured_values() {
        let shown = [Undefined, Init, PreOperational, Operational, Stopped].map(State::measured_value);
        assert_eq!(shown, [None, Some(12402), Some(12403), Some(12404), Some(12401)]);
    }
}
