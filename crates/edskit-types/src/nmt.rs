//! States of a device and the commands that change them.

use core::fmt;

/// State of the NMT slave state machine (CiA 301 v4.2, 7.3.2.2).
///
/// ```
/// use edskit_types::NmtState;
///
/// assert_eq!(NmtState::from_code(0x7F), Some(NmtState::PreOperational));
/// assert_eq!(NmtState::Operational.code(), 5);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum NmtState {
    /// 0: after power-on or a reset, until the boot-up message; no service is available.
    Initialising,
    /// 4: only NMT commands and error control.
    Stopped,
    /// 5: every service, PDOs too.
    Operational,
    /// 127: every service but PDOs.
    PreOperational,
}

impl NmtState {
    /// The state that a heartbeat or guarding message names; its toggle bit has to be taken off first.
    #[must_use]
    pub const fn from_code(code: u8) -> Option<Self> {
        match code {
            0 => Some(Self::Initialising),
            4 => Some(Self::Stopped),
            5 => Some(Self::Operational),
            127 => Some(Self::PreOperational),
            _ => None,
        }
    }

    /// The number in heartbeat and guarding messages.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::Initialising => 0,
            Self::Stopped => 4,
            Self::Operational => 5,
            Self::PreOperational => 127,
        }
    }
}

impl fmt::Display for NmtState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Initialising => "initialising",
            Self::Stopped => "stopped",
            Self::Operational => "operational",
            Self::PreOperational => "pre-operational",
        })
    }
}

/// Command of the NMT master (CiA 301 v4.2, 7.2.8.2.1).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum NmtCommand {
    /// 1: go to operational.
    Start,
    /// 2: go to stopped.
    Stop,
    /// 128: go to pre-operational.
    EnterPreOperational,
    /// 129: reset the application, then the communication.
    ResetNode,
    /// 130: reset the communication.
    ResetCommunication,
}

impl NmtCommand {
    /// Every command.
    pub const ALL: [Self; 5] =
        [Self::Start, Self::Stop, Self::EnterPreOperational, Self::ResetNode, Self::ResetCommunication];

    /// The command with this command specifier; `None` for one that CiA 301 does not define.
    #[must_use]
    pub const fn from_code(code: u8) -> Option<Self> {
        match code {
            1 => Some(Self::Start),
            2 => Some(Self::Stop),
            128 => Some(Self::EnterPreOperational),
            129 => Some(Self::ResetNode),
            130 => Some(Self::ResetCommunication),
            _ => None,
        }
    }

    /// The command specifier.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::Start => 1,
            Self::Stop => 2,
            Self::EnterPreOperational => 128,
            Self::ResetNode => 129,
            Self::ResetCommunication => 130,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_and_back() {
        let states =
            [NmtState::Initialising, NmtState::Stopped, NmtState::Operational, NmtState::PreOperational];
        for state in states {
            assert_eq!(NmtState::from_code(state.code()), Some(state));
        }
        for command in NmtCommand::ALL {
            assert_eq!(NmtCommand::from_code(command.code()), Some(command));
        }
        let known = |code: &u8| NmtCommand::from_code(*code).is_some();
        assert_eq!((0..=u8::MAX).filter(known).count(), NmtCommand::ALL.len());
        assert_eq!(NmtState::from_code(0x85), None);
    }
}
