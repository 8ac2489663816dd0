//! EMCY: errors, the error register 1001h, the history 1003h, and the message (CiA 301 v4.2, 7.2.7).

use crate::context::Context;
use crate::ring::Ring;
use crate::time::Timer;
use crate::{Instant, Microseconds, Pattern};
use edskit_types::{AbortCode, CobId, Index};

/// How many errors can be present at once; further ones are in the register, but cannot be told from each other.
const MOST_ERRORS: usize = 8;
/// How many messages can wait for the inhibit time.
const MOST_WAITING: usize = 8;

/// A kind of error: its code and its bits of the error register (CiA 301 v4.2, 7.2.7.1 and 7.5.2.2).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Error {
    /// The emergency error code.
    pub code: u16,
    /// The bits of the error register 1001h; bit 0, generic error, is added to all.
    pub register: u8,
}

impl Error {
    /// 6300h: stored parameters could not be loaded, the defaults are used.
    pub const LOST_PARAMETERS: Self = Self { code: 0x6300, register: 0 };
    /// 8110h: frames were lost because they could not be sent or taken in time.
    pub const CAN_OVERRUN: Self = Self { code: 0x8110, register: Self::COMMUNICATION };
    /// 8120h: the CAN controller is error passive.
    pub const ERROR_PASSIVE: Self = Self { code: 0x8120, register: Self::COMMUNICATION };
    /// 8130h: a heartbeat or the guarding by the master is missing.
    pub const HEARTBEAT: Self = Self { code: 0x8130, register: Self::COMMUNICATION };
    /// 8140h: the CAN controller has recovered from bus-off.
    pub const BUS_OFF_RECOVERED: Self = Self { code: 0x8140, register: Self::COMMUNICATION };
    /// 8210h: an RPDO was shorter than its mapping.
    pub const PDO_LENGTH: Self = Self { code: 0x8210, register: Self::COMMUNICATION };
    /// 8240h: a SYNC message had an unexpected length.
    pub const SYNC_LENGTH: Self = Self { code: 0x8240, register: Self::COMMUNICATION };
    /// 8250h: an RPDO has not come within its event time.
    pub const RPDO_TIME_OUT: Self = Self { code: 0x8250, register: Self::COMMUNICATION };

    /// The bit of the error register for errors of communication.
    pub const COMMUNICATION: u8 = 1 << 4;
    const GENERIC: u8 = 1;
}

/// What an EMCY message says.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Emergency {
    /// The emergency error code; 0000h where an error has gone.
    pub code: u16,
    /// The error register 1001h.
    pub register: u8,
    /// Five bytes of the manufacturer.
    pub info: [u8; 5],
}

/// An error that is present. `source` tells errors of one kind apart: the number of a PDO or a node-ID, say.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Present {
    error: Error,
    source: u16,
}

#[derive(Debug)]
pub(crate) struct Emcy {
    present: [Option<Present>; MOST_ERRORS],
    /// The messages that wait. The oldest stay: they tell what came first.
    waiting: Ring<Emergency, MOST_WAITING>,
    /// Until when no message may be sent.
    inhibit: Timer,
}

impl Emcy {
    pub(crate) const fn new() -> Self {
        Self {
            present: [None; MOST_ERRORS],
            waiting: Ring::new(Emergency { code: 0, register: 0, info: [0; 5] }),
            inhibit: Timer::OFF,
        }
    }

    /// The error register that follows from what is present.
    fn register(&self) -> u8 {
        let bits = |present: &Present| present.error.register | Error::GENERIC;
        self.present.iter().flatten().fold(0, |all, present| all | bits(present))
    }

    fn is_present(&self, code: u16, source: u16) -> bool {
        self.present.iter().flatten().any(|present| present.error.code == code && present.source == source)
    }

    /// What the red indicator shows: of several errors the one that stands first here.
    pub(crate) fn pattern(&self) -> Pattern {
        let has = |error: Error| self.present.iter().flatten().any(|present| present.error == error);
        if has(Error::HEARTBEAT) {
            Pattern::DoubleFlash
        } else if has(Error::ERROR_PASSIVE) || has(Error::CAN_OVERRUN) {
            Pattern::SingleFlash
        } else {
            Pattern::Off
        }
    }

    /// When a waiting message may be sent.
    pub(crate) fn deadline(&self) -> Instant {
        if self.waiting.is_empty() {
            Instant::NEVER
        } else if self.inhibit.is_running() {
            self.inhibit.deadline()
        } else {
            Instant::default()
        }
    }
}

impl Context<'_> {
    /// An error has occurred. One that is present already is not told again.
    pub(crate) fn raise(&mut self, error: Error, source: u16, info: [u8; 5]) {
        if self.core.emcy.is_present(error.code, source) {
            return;
        }
        let free = self.core.emcy.present.iter_mut().find(|present| present.is_none());
        if let Some(free) = free {
            *free = Some(Present { error, source });
        }
        let register = self.core.emcy.register() | error.register | Error::GENERIC;
        self.tell(Emergency { code: error.code, register, info });
        self.remember(error.code, info);
    }

    /// An error has gone.
    pub(crate) fn clear(&mut self, error: Error, source: u16) {
        let wanted = Some(Present { error, source });
        if let Some(present) = self.core.emcy.present.iter_mut().find(|present| **present == wanted) {
            *present = None;
            let register = self.core.emcy.register();
            self.tell(Emergency { code: 0, register, info: [0; 5] });
        }
    }

    fn tell(&mut self, emergency: Emergency) {
        self.objects.set_value(Index::ERROR_REGISTER, 0, emergency.register);
        self.app.emergency(&mut self.objects, &emergency);
        self.core.emcy.waiting.push(emergency);
        self.send_emergencies();
    }

    /// Puts an error at the head of the history 1003h.
    fn remember(&mut self, code: u16, info: [u8; 5]) {
        let field = Index::PREDEFINED_ERROR_FIELD;
        let entries = self.objects.table.entries_of(field);
        let capacity = entries.last().map_or(0, |(_, entry)| entry.sub_index.0);
        let Some(count) = self.objects.value::<u8>(field, 0).filter(|_| capacity > 0) else { return };
        for sub_index in (1..count.saturating_add(1).min(capacity)).rev() {
            let older = self.objects.value::<u32>(field, sub_index).unwrap_or_default();
            self.objects.set_value(field, sub_index + 1, older);
        }
        let [low, high, ..] = info;
        self.objects.set_value(field, 1, u32::from(code) | u32::from(u16::from_le_bytes([low, high])) << 16);
        self.objects.set_value(field, 0, count.saturating_add(1).min(capacity));
    }

    /// 1003h sub-index 00h is written: only 0, which clears the history.
    pub(crate) fn check_history(&self, data: &[u8]) -> Result<(), AbortCode> {
        if data == [0] { Ok(()) } else { Err(AbortCode::INVALID_VALUE) }
    }

    /// 1014h is written.
    pub(crate) fn check_emcy_cob_id(&self, old: CobId, new: CobId) -> Result<(), AbortCode> {
        self.check_cob_id(new)?;
        if old.is_valid() && new.is_valid() && old.can_id() != new.can_id() {
            return Err(AbortCode::INVALID_VALUE);
        }
        Ok(())
    }

    /// Sends what waits, as far as the state, the inhibit time and the queue allow.
    pub(crate) fn send_emergencies(&mut self) {
        // Almost always nothing waits, and this is asked with every call of the node.
        if self.core.emcy.waiting.is_empty() || !self.is_communicating() {
            return;
        }
        let Some(cob_id) = self.objects.value(Index::EMCY_COB_ID, 0).map(CobId) else {
            self.core.emcy.waiting.clear();
            return;
        };
        let inhibit = Microseconds::from_inhibit_time(self.objects.value(Index(0x1015), 0).unwrap_or(0));
        loop {
            let is_inhibited =
                self.core.emcy.inhibit.is_running() && !self.core.emcy.inhibit.is_due(self.now);
            if is_inhibited || self.core.queue.room() == 0 {
                return;
            }
            let Some(emergency) = self.core.emcy.waiting.pop() else { return };
            if cob_id.is_valid() {
                let [low, high] = emergency.code.to_le_bytes();
                let [a, b, c, d, e] = emergency.info;
                let data = [low, high, emergency.register, a, b, c, d, e];
                self.core.queue.send(cob_id.can_id(), &data);
                self.core.emcy.inhibit = Timer::after(self.now, inhibit);
            }
        }
    }
}
