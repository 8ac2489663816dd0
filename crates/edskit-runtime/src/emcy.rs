//! EMCY: errors, the error register 1001h, the history 1003h, and the message (CiA 301 v4.2, 7.2.7).
//!
//! What the services of the node find they know themselves: a heartbeat consumer whether its node is missing, an RPDO
//! whether it is late. Here they are only counted, so there is room for all of them. What the device raises is listed.

use crate::Application;
use crate::context::Context;
use crate::ring::Ring;
use crate::services::Services;
use crate::{Instant, Microseconds, Pattern};
use edskit_types::{AbortCode, CanId, CobId, EmergencyCode, ErrorRegister, Index};

/// How many errors of the device, and groups of parameters that were lost, can be present at once.
const MOST_ERRORS: usize = 32;
/// How many messages can wait for the inhibit time.
const MOST_WAITING: usize = 8;
const INHIBIT_TIME: Index = Index(0x1015);

/// A kind of error: its code and its bits of the error register (CiA 301 v4.2, 7.2.7.1 and 7.5.2.2).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct EmcyError {
    /// The emergency error code, which is not 0000h: an [`EmergencyCode`].
    pub code: u16,
    /// The bits of the error register 1001h, as in [`ErrorRegister`]; bit 0, generic error, is added to all.
    pub register: u8,
}

impl EmcyError {
    /// 6300h: stored parameters could not be loaded, the defaults are used.
    pub const LOST_PARAMETERS: Self = Self::new(EmergencyCode::DATA_SET, ErrorRegister(0));
    /// 8110h: frames were lost because they could not be sent or taken in time.
    pub const CAN_OVERRUN: Self = Self::of_communication(EmergencyCode::CAN_OVERRUN);
    /// 8120h: the CAN controller is error passive.
    pub const ERROR_PASSIVE: Self = Self::of_communication(EmergencyCode::ERROR_PASSIVE);
    /// 8130h: a heartbeat or the guarding by the master is missing.
    pub const HEARTBEAT: Self = Self::of_communication(EmergencyCode::HEARTBEAT);
    /// 8100h: the bus is off. It cannot be told by a message, and so is none of those that are listed; devices are told of it
    /// ([`Application::reaction`](crate::Application::reaction)).
    pub const BUS_OFF: Self = Self::of_communication(EmergencyCode::COMMUNICATION);
    /// 8140h: the CAN controller has recovered from bus-off.
    pub const BUS_OFF_RECOVERED: Self = Self::of_communication(EmergencyCode::BUS_OFF_RECOVERED);
    /// 8210h: an RPDO was shorter than its mapping.
    pub const PDO_LENGTH: Self = Self::of_communication(EmergencyCode::PDO_LENGTH);
    /// 8240h: a SYNC message had an unexpected length.
    pub const SYNC_LENGTH: Self = Self::of_communication(EmergencyCode::SYNC_LENGTH);
    /// 8250h: an RPDO has not come within its event time.
    pub const RPDO_TIME_OUT: Self = Self::of_communication(EmergencyCode::RPDO_TIME_OUT);

    /// What stands where there is no error.
    const NONE: Self = Self { code: 0, register: 0 };

    /// An error of the device.
    ///
    /// ```
    /// use edskit_runtime::EmcyError;
    /// use edskit_runtime::types::{EmergencyCode, ErrorRegister};
    ///
    /// const TOO_HOT: EmcyError = EmcyError::new(EmergencyCode::DEVICE_TEMPERATURE.with(0x10), ErrorRegister::TEMPERATURE);
    /// assert_eq!((TOO_HOT.code, TOO_HOT.register), (0x4210, 0x08));
    /// ```
    #[must_use]
    pub const fn new(code: EmergencyCode, register: ErrorRegister) -> Self {
        Self { code: code.0, register: register.0 }
    }

    const fn of_communication(code: EmergencyCode) -> Self {
        Self::new(code, ErrorRegister::COMMUNICATION)
    }
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

/// An error that is present. `source` tells errors of one kind apart: the number of a group or a sensor, say.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Present {
    error: EmcyError,
    source: u16,
}

impl Present {
    const NONE: Self = Self { error: EmcyError::NONE, source: 0 };
}

#[derive(Debug)]
pub(crate) struct Emcy {
    /// What the device has raised and not cleared.
    present: [Present; MOST_ERRORS],
    /// How many heartbeats and guardings are missing.
    missing: u16,
    /// Whether frames are being lost, as a number.
    overruns: u16,
    /// How many other errors of services are present.
    others: u16,
    /// The messages that wait: the oldest, which tell what came first, and the newest, which tells what is.
    waiting: Ring<Emergency, MOST_WAITING>,
    /// When the last message was sent.
    sent: Option<Instant>,
}

impl Emcy {
    pub(crate) const fn new() -> Self {
        Self {
            present: [Present::NONE; MOST_ERRORS],
            missing: 0,
            overruns: 0,
            others: 0,
            waiting: Ring::new(Emergency { code: 0, register: 0, info: [0; 5] }),
            sent: None,
        }
    }

    /// The error register that follows from what is present.
    fn register(&self) -> u8 {
        let present = self.present.iter().filter(|present| present.error != EmcyError::NONE);
        let own = (self.missing > 0 || self.overruns > 0 || self.others > 0)
            .then_some(ErrorRegister::COMMUNICATION.and(ErrorRegister::GENERIC).0);
        present.fold(own.unwrap_or(0), |all, present| all | present.error.register | ErrorRegister::GENERIC.0)
    }

    /// How many errors of this kind the services have found.
    fn count(&mut self, error: EmcyError) -> &mut u16 {
        match error {
            EmcyError::HEARTBEAT => &mut self.missing,
            EmcyError::CAN_OVERRUN => &mut self.overruns,
            _ => &mut self.others,
        }
    }

    /// What the red indicator shows: of several errors the one that stands first here.
    pub(crate) fn pattern(&self, bus_has_errors: bool) -> Pattern {
        let has = |error: EmcyError| self.present.iter().any(|present| present.error == error);
        if self.missing > 0 || has(EmcyError::HEARTBEAT) {
            Pattern::DoubleFlash
        } else if bus_has_errors
            || self.overruns > 0
            || has(EmcyError::ERROR_PASSIVE)
            || has(EmcyError::CAN_OVERRUN)
        {
            Pattern::SingleFlash
        } else {
            Pattern::Off
        }
    }
}

impl Services<'_> {
    /// An error of the device has occurred: it is told by an EMCY message, unless it is present already. `source` tells
    /// errors of one kind apart; `info` are the five bytes of the manufacturer.
    ///
    /// There is room for 32 errors of the device at once, whatever the services of the node find besides. A further one is
    /// told each time that it is raised, and is not in the error register afterwards.
    pub fn raise(&mut self, error: EmcyError, source: u16, info: [u8; 5]) {
        if self.list(error, source) {
            let emergency = self.compose(error.code, error.register | ErrorRegister::GENERIC.0, info);
            self.remember(error.code, info);
            self.send_emergency(emergency);
        }
    }

    /// An error of the device has gone.
    pub fn clear(&mut self, error: EmcyError, source: u16) {
        if self.unlist(error, source) {
            let emergency = self.compose(0, 0, [0; 5]);
            self.send_emergency(emergency);
        }
    }

    /// Sends an EMCY message as it is, as soon as the NMT state, 1014h, 1015h and the queue allow. Nothing else is touched:
    /// the place for a manual whose messages have a layout of their own, or tell what is no error. Up to 8 messages wait;
    /// a further one takes the place of the newest, so that what came first and what is now are told.
    pub fn send_emergency(&mut self, emergency: Emergency) {
        self.core.emcy.waiting.push_over(emergency);
        self.send_emergencies();
    }

    /// Puts an error at the head of the history 1003h: the error code in the low word, the first two bytes of `info` in the
    /// high one. [`raise`](Self::raise) does so itself.
    #[inline(never)]
    pub fn remember(&mut self, code: u16, info: [u8; 5]) {
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

    /// Puts an error among those that are present; false where it is there already.
    fn list(&mut self, error: EmcyError, source: u16) -> bool {
        let is_it = |present: &Present| present.error.code == error.code && present.source == source;
        let present = &mut self.core.emcy.present;
        if present.iter().any(is_it) {
            return false;
        }
        if let Some(free) = present.iter_mut().find(|present| **present == Present::NONE) {
            *free = Present { error, source };
        }
        true
    }

    /// Takes an error from those that are present; false where it is not there.
    fn unlist(&mut self, error: EmcyError, source: u16) -> bool {
        let wanted = Present { error, source };
        let present = self.core.emcy.present.iter_mut().find(|present| **present == wanted);
        present.map(|present| *present = Present::NONE).is_some()
    }

    /// What an EMCY message says now that an error has occurred or gone (0000h); 1001h says it too.
    fn compose(&mut self, code: u16, register: u8, info: [u8; 5]) -> Emergency {
        let register = register | self.core.emcy.register();
        self.objects.set_value(Index::ERROR_REGISTER, 0, register);
        Emergency { code, register, info }
    }

    /// The identifier of the message; `None` where 1014h is not valid or names one that cannot be used.
    fn emcy_can_id(&self) -> Option<CanId> {
        let has_object = self.objects.value::<u32>(Index::EMCY_COB_ID, 0).is_some();
        if has_object || !self.core.settings.sends_emergencies {
            return self.valid_can_id(Index::EMCY_COB_ID, 0);
        }
        self.core.node_id.and_then(|node_id| CanId::standard(0x80 + u16::from(node_id.get())))
    }

    /// Until when no message may be sent: 1015h, as it is now, after the last one.
    fn inhibited_until(&self) -> Instant {
        let time = Microseconds::from_inhibit_time(self.objects.value(INHIBIT_TIME, 0).unwrap_or(0));
        self.core.emcy.sent.map_or(Instant::default(), |sent| sent + time)
    }

    /// When a waiting message can be sent.
    pub(crate) fn emcy_deadline(&self) -> Instant {
        let waits = !self.core.emcy.waiting.is_empty() && self.is_communicating();
        if waits && self.core.queue.room() > 0 && self.emcy_can_id().is_some() {
            self.inhibited_until()
        } else {
            Instant::NEVER
        }
    }

    /// Sends what waits, as far as the state, the inhibit time and the queue allow.
    pub(crate) fn send_emergencies(&mut self) {
        // Almost always nothing waits, and this is asked with every call of the node.
        if self.core.emcy.waiting.is_empty() || !self.is_communicating() {
            return;
        }
        let Some(can_id) = self.emcy_can_id() else {
            // What was is of no use any more when the service exists again; what is then is.
            self.core.emcy.waiting.keep_newest();
            return;
        };
        while self.core.queue.room() > 0 && self.inhibited_until() <= self.now {
            let Some(emergency) = self.core.emcy.waiting.pop() else { return };
            let [low, high] = emergency.code.to_le_bytes();
            let [a, b, c, d, e] = emergency.info;
            self.core.queue.send(can_id, &[low, high, emergency.register, a, b, c, d, e]);
            self.core.emcy.sent = Some(self.now);
        }
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// The node itself has found an error that is in its list, as it is not one of a service.
    pub(crate) fn raise(&mut self, error: EmcyError, source: u16, info: [u8; 5]) {
        if self.app.counts(error) && self.node.list(error, source) {
            self.occurred(error, info);
        }
    }

    /// Such an error has gone.
    pub(crate) fn clear(&mut self, error: EmcyError, source: u16) {
        if self.node.unlist(error, source) {
            self.tell(0, 0, [0; 5]);
        }
    }

    /// A service finds an error present or not, which it has found so or not before.
    #[inline(never)]
    pub(crate) fn found(&mut self, error: EmcyError, was_present: bool, is_present: bool, info: [u8; 5]) {
        if was_present == is_present || !self.app.counts(error) {
            return;
        }
        let count = self.node.core.emcy.count(error);
        if is_present {
            *count = count.saturating_add(1);
            self.occurred(error, info);
        } else {
            *count = count.saturating_sub(1);
            self.tell(0, 0, [0; 5]);
        }
    }

    #[inline(never)]
    fn occurred(&mut self, error: EmcyError, info: [u8; 5]) {
        self.node.remember(error.code, info);
        self.tell(error.code, error.register | ErrorRegister::GENERIC.0, info);
    }

    /// Tells by a message that an error has occurred, or with the code 0000h that one has gone.
    fn tell(&mut self, code: u16, register: u8, info: [u8; 5]) {
        let mut emergency = self.node.compose(code, register, info);
        self.app.emergency(&mut self.node, &mut emergency);
        self.node.send_emergency(emergency);
    }

    /// What 1003h sub-index 00h can be set to: only 0, which clears the history.
    pub(crate) fn check_history(&self, data: &[u8]) -> Result<(), AbortCode> {
        if data == [0] { Ok(()) } else { Err(AbortCode::INVALID_VALUE) }
    }

    /// 1014h is about to be written: a valid identifier has to be made invalid before it can change.
    pub(crate) fn check_emcy_change(&self, new: CobId) -> Result<(), AbortCode> {
        match self.node.emcy_can_id() {
            Some(old) if new.is_valid() && old != new.can_id() => Err(AbortCode::INVALID_VALUE),
            _ => Ok(()),
        }
    }
}
