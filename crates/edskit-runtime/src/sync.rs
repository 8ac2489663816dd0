//! SYNC: consumer with counter, producer, and the synchronous window (CiA 301 v4.2, 7.2.5).

use crate::context::Context;
use crate::time::Timer;
use crate::{Error, Frame, Instant, Microseconds};
use edskit_types::{AbortCode, CanId, CobId, Index};

const PERIOD: Index = Index(0x1006);
const WINDOW: Index = Index(0x1007);
const OVERFLOW: Index = Index(0x1019);

#[derive(Debug)]
pub(crate) struct Sync {
    /// The identifier; `None` for a device without 1005h.
    can_id: Option<CanId>,
    /// Until when PDOs of the present period are in time.
    window: Timer,
    /// Runs while the device produces the message.
    producer: Timer,
    /// The counter of the next message that is produced.
    next_counter: u8,
}

impl Sync {
    pub(crate) const fn new() -> Self {
        Self { can_id: None, window: Timer::OFF, producer: Timer::OFF, next_counter: 1 }
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

    /// Whether a window is set and has passed.
    pub(crate) fn window_has_passed(&self, now: Instant) -> bool {
        self.window.is_due(now)
    }
}

impl Context<'_> {
    pub(crate) fn configure_sync(&mut self) {
        self.core.sync = Sync::new();
        self.core.sync.can_id = self.sync_cob_id().map(CobId::can_id);
        self.start_sync_producer();
    }

    fn sync_cob_id(&self) -> Option<CobId> {
        self.objects.value(Index::SYNC_COB_ID, 0).map(CobId)
    }

    fn sync_period(&self) -> Microseconds {
        Microseconds(self.objects.value::<u32>(PERIOD, 0).unwrap_or_default().into())
    }

    fn is_sync_producer(&self) -> bool {
        self.sync_cob_id().is_some_and(CobId::bit30)
    }

    /// The first message comes after one period.
    fn start_sync_producer(&mut self) {
        let period = if self.is_sync_producer() { self.sync_period() } else { Microseconds(0) };
        self.core.sync.producer = Timer::after(self.now, period);
        self.core.sync.next_counter = 1;
    }

    /// 1005h is about to be written. While the device produces the message, only bit 30 may change.
    pub(crate) fn check_sync_cob_id(&self, old: CobId, new: CobId) -> Result<(), AbortCode> {
        // Bit 31 has no meaning here, so an identifier is checked as that of a valid message.
        self.check_cob_id(CobId(new.0 & !CobId::BIT_31))?;
        if old.bit30() && new.bit30() && old.can_id() != new.can_id() {
            return Err(AbortCode::INVALID_VALUE);
        }
        if new.bit30() && self.objects.value::<u32>(PERIOD, 0).is_none() {
            return Err(AbortCode::INVALID_VALUE);
        }
        Ok(())
    }

    /// 1019h is about to be written.
    pub(crate) fn check_sync_overflow(&self, value: u8) -> Result<(), AbortCode> {
        match value {
            _ if self.sync_period().0 > 0 => Err(AbortCode::DEVICE_STATE),
            0 | 2..=240 => Ok(()),
            _ => Err(AbortCode::INVALID_VALUE),
        }
    }

    /// 1005h or 1006h has been written.
    pub(crate) fn sync_written(&mut self) {
        self.core.sync.can_id = self.sync_cob_id().map(CobId::can_id);
        self.start_sync_producer();
    }

    pub(crate) fn poll_sync(&mut self) {
        if !self.core.sync.producer.is_due(self.now) {
            return;
        }
        let period = self.sync_period();
        self.core.sync.producer = self.core.sync.producer.again(self.now, period);
        let Some(can_id) = self.core.sync.can_id else { return };
        if !self.is_communicating() {
            return;
        }
        let overflow: u8 = self.objects.value(OVERFLOW, 0).unwrap_or_default();
        let counter = (overflow > 0).then_some(self.core.sync.next_counter);
        if let Some(counter) = counter {
            self.core.sync.next_counter = if counter >= overflow { 1 } else { counter + 1 };
        }
        self.core.queue.send(can_id, counter.as_slice());
        self.synchronise(counter);
    }

    /// A frame with the identifier of 1005h.
    pub(crate) fn sync_received(&mut self, frame: &Frame) {
        if !self.is_communicating() || self.is_sync_producer() {
            return;
        }
        let has_counter = self.objects.value::<u8>(OVERFLOW, 0).unwrap_or_default() > 0;
        match (frame.data(), has_counter) {
            ([], false) => {
                self.clear(Error::SYNC_LENGTH, 0);
                self.synchronise(None);
            }
            ([counter], true) => {
                self.clear(Error::SYNC_LENGTH, 0);
                self.synchronise(Some(*counter));
            }
            (data, _) => self.raise(Error::SYNC_LENGTH, 0, [data.len() as u8, 0, 0, 0, 0]),
        }
    }

    /// A period begins: what was received in the last one counts, and synchronous PDOs are sent.
    fn synchronise(&mut self, counter: Option<u8>) {
        let window: u32 = self.objects.value(WINDOW, 0).unwrap_or_default();
        self.core.sync.window = Timer::after(self.now, Microseconds(window.into()));
        self.apply_synchronous_rpdos();
        self.app.sync_received(&mut self.objects, counter);
        self.send_synchronous_tpdos(counter);
    }
}
