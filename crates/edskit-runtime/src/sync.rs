//! SYNC: consumer with counter, producer, and the synchronous window (CiA 301 v4.2, 7.2.5).

use crate::Application;
use crate::context::Context;
use crate::time::Timer;
use crate::{EmcyError, Frame, Instant, Microseconds};
use edskit_types::{AbortCode, CanId, CobId, Index};

const PERIOD: Index = Index(0x1006);
const WINDOW: Index = Index(0x1007);
const OVERFLOW: Index = Index(0x1019);

#[derive(Debug)]
pub(crate) struct Sync {
    /// The identifier; `None` for a device without 1005h.
    can_id: Option<CanId>,
    /// When the present period began; `None` before the first message.
    began: Option<Instant>,
    /// Runs while the device produces the message.
    producer: Timer,
    /// The counter of the next message that is produced.
    next_counter: u8,
    /// Whether the last message had a wrong length, which is an error.
    has_wrong_length: bool,
}

impl Sync {
    pub(crate) const fn new() -> Self {
        Self { can_id: None, began: None, producer: Timer::OFF, next_counter: 1, has_wrong_length: false }
    }

    pub(crate) fn is(&self, can_id: CanId) -> bool {
        self.can_id == Some(can_id)
    }

    pub(crate) fn deadline(&self) -> Instant {
        self.producer.deadline()
    }

    /// The state stopped was left: the counter begins at 1.
    pub(crate) fn restart(&mut self, now: Instant) {
        self.next_counter = 1;
        if self.producer.is_due(now) {
            self.producer = Timer::after(now, Microseconds(1));
        }
    }
}

/// What 1019h can be set to.
pub(crate) fn check_sync_overflow(value: u8) -> Result<(), AbortCode> {
    if matches!(value, 0 | 2..=240) { Ok(()) } else { Err(AbortCode::INVALID_VALUE) }
}

impl<A: Application + ?Sized> Context<'_, A> {
    pub(crate) fn configure_sync(&mut self) {
        self.node.core.sync = Sync::new();
        self.sync_changed();
    }

    /// What 1005h says, where that can be used.
    fn sync_cob_id(&self) -> Option<CobId> {
        self.node
            .objects
            .value(Index::SYNC_COB_ID, 0)
            .map(CobId)
            .filter(|cob_id| self.check_sync(*cob_id).is_ok())
    }

    fn sync_period(&self) -> Microseconds {
        Microseconds(self.node.objects.value::<u32>(PERIOD, 0).unwrap_or_default().into())
    }

    /// The overflow value of the counter, where 1019h has one that can be used; 0 for no counter.
    fn sync_overflow(&self) -> u8 {
        let overflow: Option<u8> = self.node.objects.value(OVERFLOW, 0);
        overflow.filter(|value| check_sync_overflow(*value).is_ok()).unwrap_or(0)
    }

    /// Whether a window is set (1007h, as it is now) and has passed since the last message.
    pub(crate) fn window_has_passed(&self) -> bool {
        let Some(began) = self.node.core.sync.began.filter(|began| *began < self.node.now) else {
            return false;
        };
        let window: u32 = self.node.objects.value(WINDOW, 0).unwrap_or_default();
        Timer::after(began, Microseconds(window.into())).is_due(self.node.now)
    }

    /// What 1005h can be set to. A device without 1006h cannot produce the message.
    pub(crate) fn check_sync(&self, cob_id: CobId) -> Result<(), AbortCode> {
        if cob_id.bit30() && self.node.objects.value::<u32>(PERIOD, 0).is_none() {
            return Err(AbortCode::INVALID_VALUE);
        }
        // Bit 31 has no meaning here, so an identifier is checked as that of a valid message.
        self.node.check_cob_id(CobId(cob_id.0 & !CobId::BIT_31))
    }

    /// 1005h is about to be written. While the device produces the message, only bit 30 may change.
    pub(crate) fn check_sync_change(&self, new: CobId) -> Result<(), AbortCode> {
        match self.sync_cob_id() {
            Some(old) if old.bit30() && new.bit30() && old.can_id() != new.can_id() => {
                Err(AbortCode::INVALID_VALUE)
            }
            _ => Ok(()),
        }
    }

    /// 1019h is about to be written: only while there is no period.
    pub(crate) fn check_overflow_change(&self) -> Result<(), AbortCode> {
        if self.sync_period().0 > 0 { Err(AbortCode::DEVICE_STATE) } else { Ok(()) }
    }

    /// What follows from 1005h, 1006h and 1019h: the producer begins anew, its first message after one period, and the
    /// error of a message that was expected otherwise is none any more.
    pub(crate) fn sync_changed(&mut self) {
        let has_object = self.node.objects.value::<u32>(Index::SYNC_COB_ID, 0).is_some();
        let cob_id = self.sync_cob_id();
        let fixed = self.node.core.settings.sync.filter(|_| !has_object);
        let can_id = cob_id.map(CobId::can_id).or(fixed);
        let is_producer = cob_id.is_some_and(CobId::bit30);
        let period = if is_producer { self.sync_period() } else { Microseconds(0) };
        let sync = &mut self.node.core.sync;
        if sync.can_id != can_id {
            sync.began = None;
        }
        sync.can_id = can_id;
        sync.producer = Timer::after(self.node.now, period);
        sync.next_counter = 1;
        self.sync_length_found(false, 0);
    }

    /// Whether the last message had a wrong length.
    pub(crate) fn sync_length_found(&mut self, is_wrong: bool, length: u8) {
        let was_wrong = core::mem::replace(&mut self.node.core.sync.has_wrong_length, is_wrong);
        self.found(EmcyError::SYNC_LENGTH, was_wrong, is_wrong, [length, 0, 0, 0, 0]);
    }

    /// Sends the message when it is due, or as soon after that as the queue has room, which is told.
    pub(crate) fn poll_sync(&mut self) {
        if !self.node.core.sync.producer.is_due(self.node.now) {
            return;
        }
        if self.node.is_communicating() && self.node.core.queue.room() == 0 {
            self.node.core.queue.note_loss();
            return;
        }
        let period = self.sync_period();
        self.node.core.sync.producer = self.node.core.sync.producer.again(self.node.now, period);
        let Some(can_id) = self.node.core.sync.can_id else { return };
        if !self.node.is_communicating() {
            return;
        }
        let overflow = self.sync_overflow();
        let counter = (overflow > 0).then_some(self.node.core.sync.next_counter);
        if let Some(counter) = counter {
            self.node.core.sync.next_counter = if counter >= overflow { 1 } else { counter + 1 };
        }
        self.node.core.queue.send(can_id, counter.as_slice());
        self.synchronise(counter);
    }

    /// A frame with the identifier of 1005h. A device whose period is 0 makes none itself, so it takes those of others
    /// although it may be set to produce them (bit 30).
    pub(crate) fn sync_received(&mut self, frame: &Frame) {
        if !self.node.is_communicating() || self.node.core.sync.producer.is_running() {
            return;
        }
        let counter = match (frame.data(), self.sync_overflow() > 0) {
            ([], false) => None,
            ([counter], true) => Some(*counter),
            (data, _) => {
                self.sync_length_found(true, data.len() as u8);
                return;
            }
        };
        self.sync_length_found(false, 0);
        self.synchronise(counter);
    }

    /// A period begins: what was received in the last one counts, and synchronous PDOs are sent.
    fn synchronise(&mut self, counter: Option<u8>) {
        self.node.core.sync.began = Some(self.node.now);
        self.apply_synchronous_rpdos();
        self.app.sync_received(&mut self.node, counter);
        self.send_synchronous_tpdos(counter);
    }
}
