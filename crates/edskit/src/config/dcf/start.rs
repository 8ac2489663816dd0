//! The gateway after a start, and what its SDO server answers.

use crate::config::words;
use crate::printable;
use crate::run::gateway::LiveGateway;
use edskit_devices::gateway::{Event, Pdo, PdoTable, Refusal, State, Word};
use edskit_host::sdo::{SdoChannel, SdoError, SdoOptions, Transfer};
use edskit_runtime::{Device, Instant};
use edskit_types::{AbortCode, Bitrate, Index, NodeId, PdoDirection, SubIndex};
use std::fmt;

/// A gateway that has booted up, in virtual time and with no other node on its bus.
pub(super) struct Started {
    device: LiveGateway,
    now: Instant,
}

/// Why a gateway does not boot up.
pub(super) enum NotStarted {
    /// It refuses the parameters.
    Refused(Refusal),
    /// Its two units do not hear each other, for this reason.
    Apart(String),
}

impl fmt::Display for NotStarted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(reason) => write!(f, "the gateway refuses these parameters: {reason}"),
            Self::Apart(reason) => write!(f, "gateway and governor do not hear each other: {reason}"),
        }
    }
}

/// No start takes so long: both units are there after 200 ms, and the initialisation takes a few main cycles.
const LONGEST_START: Instant = Instant(10_000_000);

impl Started {
    /// Switches both units on.
    ///
    /// # Errors
    /// Why the first attempt of the initialisation fails, the others having the same parameters, or that there is none.
    pub(super) fn of(device: LiveGateway) -> Result<Self, NotStarted> {
        if let Some(reason) = words::apart(device.parameters()) {
            return Err(NotStarted::Apart(reason));
        }
        let mut started = Self { device, now: Instant(0) };
        while started.now < LONGEST_START {
            started.device.poll(started.now);
            // The boot-up message has no listener here.
            while started.device.transmit().is_some() {}
            if started.device.state() == State::PreOperational {
                return Ok(started);
            }
            while let Some(event) = started.device.take_event() {
                if let Event::InitialisationFailed { reason, .. } = event {
                    return Err(NotStarted::Refused(reason));
                }
            }
            started.now = started.device.next_deadline(started.now);
        }
        Err(NotStarted::Apart(format!("nothing has happened for {} s", LONGEST_START.0 / 1_000_000)))
    }

    pub(super) fn node_id(&self) -> NodeId {
        self.device.effective_parameters().node_id()
    }

    /// `None` with manual bit timing.
    pub(super) fn bit_rate(&self) -> Option<Bitrate> {
        self.device.bit_rate()
    }

    /// Whether an RPDO is active.
    pub(super) fn has_rpdos(&self) -> bool {
        self.pdos().any(|pdo| pdo.direction == PdoDirection::Receive && pdo.activity.is_active())
    }

    /// What an entry carries that is mapped; `None` where it is not.
    pub(super) fn content(&self, index: Index, sub_index: SubIndex) -> Option<String> {
        let is_it = |word: &&Word| (word.object.index(), word.object.sub_index()) == (index, sub_index);
        let source = self.pdos().find_map(|pdo| pdo.words().iter().find(is_it))?.source;
        let text =
            words::content(self.device.effective_parameters(), &self.device.governor().signals, source);
        Some(printable::line(&text))
    }

    fn pdos(&self) -> impl Iterator<Item = &Pdo> {
        self.device.pdos().into_iter().flat_map(PdoTable::iter)
    }

    /// What an entry holds; `None` where there is no such entry.
    ///
    /// # Errors
    /// Any other answer than these two.
    pub(super) fn read(&mut self, index: Index, sub_index: SubIndex) -> Result<Option<u32>, SdoError> {
        let channel = SdoChannel::of_node(self.node_id());
        let mut transfer = Transfer::read(channel, index, sub_index, SdoOptions::default(), self.now);
        loop {
            while let Some(request) = transfer.transmit(self.now) {
                self.device.receive(self.now, &request);
            }
            self.device.poll(self.now);
            while let Some(frame) = self.device.transmit() {
                transfer.receive(self.now, &frame);
            }
            match transfer.result() {
                None => {}
                Some(Ok(value)) => {
                    let number = value.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte));
                    return Ok(Some(number));
                }
                Some(Err(SdoError::Aborted(
                    AbortCode::OBJECT_DOES_NOT_EXIST | AbortCode::SUB_INDEX_DOES_NOT_EXIST,
                ))) => return Ok(None),
                Some(Err(error)) => return Err(error),
            }
            self.now = self.device.next_deadline(self.now).min(transfer.next_deadline());
            transfer.poll(self.now);
        }
    }
}
