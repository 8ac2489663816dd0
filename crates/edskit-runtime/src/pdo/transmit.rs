//! TPDOs: when they are sent, and why they are not.

use super::Parameters;
use super::mapping::gather;
use crate::context::Context;
use crate::dictionary::Position;
use crate::time::Timer;
use crate::{Instant, Microseconds};
use edskit_types::{CanId, NmtState, PdoDirection, Transmission};

/// A TPDO at work.
#[derive(Clone, Copy, Debug)]
pub struct Tpdo {
    pub(super) parameters: Parameters,
    pub(super) inhibit_time: Microseconds,
    pub(super) sync_start: u8,
    /// Whether an event has happened that has not been sent yet.
    pub(super) is_due: bool,
    /// Runs while the PDO must not be sent again.
    pub(super) inhibit: Timer,
    /// Runs to the next transmission without an event.
    pub(super) event: Timer,
    /// SYNC messages since the last transmission.
    pub(super) syncs: u8,
    /// Whether the SYNC message with the start value has not come yet.
    pub(super) waits_for_start: bool,
    /// Data sampled at the last SYNC message, for type 252.
    pub(super) sample: Option<u64>,
}

impl Tpdo {
    /// A place for a TPDO.
    pub const NEW: Self = Self {
        parameters: Parameters::NONE,
        inhibit_time: Microseconds(0),
        sync_start: 0,
        is_due: false,
        inhibit: Timer::OFF,
        event: Timer::OFF,
        syncs: 0,
        waits_for_start: false,
        sample: None,
    };

    fn meaning(&self) -> Transmission {
        self.parameters.transmission.meaning(PdoDirection::Transmit)
    }

    fn is_event_driven(&self) -> bool {
        matches!(self.meaning(), Transmission::EventManufacturer | Transmission::EventProfile)
    }

    /// Whether the PDO exists and carries something.
    fn is_usable(&self) -> bool {
        self.parameters.can_id.is_some() && self.parameters.slots.count > 0
    }

    fn is_inhibited(&self, now: Instant) -> bool {
        self.inhibit.is_running() && !self.inhibit.is_due(now)
    }

    /// When it is to be sent; a due one that only the queue holds back is due where the queue has room.
    pub(crate) fn deadline(&self, has_room: bool) -> Instant {
        let waiting = match (self.is_due && self.is_event_driven() && self.is_usable(), has_room) {
            (true, _) if self.inhibit.is_running() => self.inhibit.deadline(),
            (true, true) => Instant::default(),
            _ => Instant::NEVER,
        };
        waiting.min(self.event.deadline())
    }
}

/// Why a TPDO is not being sent at the moment.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NotSent {
    /// The device has no TPDO of this number.
    NoSuchPdo,
    /// Bit 31 of its COB-ID is 1.
    Disabled,
    /// The mapping in the dictionary is not valid: an object does not exist or cannot be mapped, or the values are too long.
    MappingInvalid,
    /// No value is mapped.
    NothingMapped,
    /// PDOs are sent in the state operational only, and the node is in this one.
    NotOperational(NmtState),
    /// Its transmission type is synchronous, and so many SYNC messages are missing.
    WaitsForSync(u8),
    /// It begins with the SYNC message whose counter has this value.
    WaitsForSyncStart(u8),
    /// It is sent on remote request only.
    WaitsForRequest,
    /// The inhibit time runs until then.
    Inhibited(Instant),
    /// No event has happened since it was sent last, and no event timer runs before then.
    NoEvent(Instant),
    /// Nothing holds it back: it is sent as soon as the transmit queue has room.
    QueueFull,
}

impl Context<'_> {
    /// Every PDO begins anew: the state operational is entered.
    pub(crate) fn start_pdos(&mut self) {
        let now = self.now;
        for tpdo in self.tpdos.iter_mut() {
            tpdo.is_due = self.app.sends_at_start(tpdo.parameters.number);
            tpdo.inhibit = Timer::OFF;
            tpdo.syncs = 0;
            tpdo.waits_for_start = tpdo.sync_start > 0;
            tpdo.sample = None;
            tpdo.event = if tpdo.is_event_driven() {
                Timer::after(now, tpdo.parameters.event_time)
            } else {
                Timer::OFF
            };
        }
    }

    /// The state operational is left.
    pub(crate) fn stop_pdos(&mut self) {
        for tpdo in self.tpdos.iter_mut() {
            tpdo.is_due = false;
            tpdo.event = Timer::OFF;
            tpdo.inhibit = Timer::OFF;
        }
        for rpdo in self.rpdos.iter_mut() {
            rpdo.waiting = None;
            rpdo.deadline = Timer::OFF;
        }
    }

    /// An event of the TPDO with this number from 1 has happened.
    pub(crate) fn tpdo_event(&mut self, number: u16) {
        if self.core.state == NmtState::Operational {
            let is_it = |tpdo: &&mut Tpdo| tpdo.parameters.number == number;
            if let Some(tpdo) = self.tpdos.iter_mut().find(is_it) {
                tpdo.is_due = true;
            }
        }
    }

    /// A value has changed: an event of every TPDO that carries it.
    pub(crate) fn value_changed(&mut self, position: Position) {
        if self.core.state != NmtState::Operational {
            return;
        }
        for tpdo in self.tpdos.iter_mut() {
            let mut values = tpdo.parameters.slots.of(self.mapped).iter();
            if values.any(|mapped| mapped.position() == Some(position)) {
                tpdo.is_due = true;
            }
        }
    }

    pub(crate) fn poll_tpdos(&mut self) {
        if self.core.state != NmtState::Operational {
            return;
        }
        for place in 0..self.tpdos.len() {
            let Some(tpdo) = self.tpdos.get_mut(place) else { continue };
            if tpdo.event.is_due(self.now) {
                tpdo.event = tpdo.event.again(self.now, tpdo.parameters.event_time);
                tpdo.is_due = true;
            }
            if tpdo.is_due && tpdo.is_event_driven() && !tpdo.is_inhibited(self.now) {
                self.send(place);
            }
        }
    }

    /// The SYNC message has come.
    pub(crate) fn send_synchronous_tpdos(&mut self, counter: Option<u8>) {
        if self.core.state != NmtState::Operational {
            return;
        }
        for place in 0..self.tpdos.len() {
            let Some(tpdo) = self.tpdos.get_mut(place) else { continue };
            match tpdo.meaning() {
                Transmission::SynchronousAcyclic if tpdo.is_due => self.send(place),
                Transmission::SynchronousCyclic(every) => {
                    if tpdo.waits_for_start && counter.is_some() {
                        if counter != Some(tpdo.sync_start) {
                            continue;
                        }
                        tpdo.waits_for_start = false;
                        tpdo.syncs = every;
                    } else {
                        tpdo.syncs = tpdo.syncs.saturating_add(1);
                    }
                    if tpdo.syncs >= every {
                        tpdo.syncs = 0;
                        self.send(place);
                    }
                }
                Transmission::RtrSynchronous => {
                    let sample = self.gather(place);
                    if let Some(tpdo) = self.tpdos.get_mut(place) {
                        tpdo.sample = Some(sample);
                    }
                }
                _ => {}
            }
        }
    }

    /// A remote frame that may ask for a TPDO.
    pub(crate) fn tpdo_requested(&mut self, can_id: CanId) {
        if self.core.state != NmtState::Operational {
            return;
        }
        // Bit 30 of the COB-ID forbids remote requests.
        let is_asked = |tpdo: &Tpdo| {
            tpdo.is_usable() && tpdo.parameters.allows_rtr && tpdo.parameters.can_id == Some(can_id)
        };
        let Some(place) = self.tpdos.iter().position(is_asked) else { return };
        let Some(tpdo) = self.tpdos.get(place) else { return };
        match (tpdo.meaning(), tpdo.sample) {
            (Transmission::RtrSynchronous, Some(sample)) => self.send_data(place, sample),
            (Transmission::RtrSynchronous, None) => {}
            _ => self.send(place),
        }
    }

    /// The present data of a TPDO.
    fn gather(&mut self, place: usize) -> u64 {
        let Some(tpdo) = self.tpdos.get(place) else { return 0 };
        let slots = tpdo.parameters.slots;
        self.app.tpdo_due(&mut self.objects, tpdo.parameters.number);
        for mapped in slots.of(self.mapped) {
            let entry = mapped.position().and_then(|position| self.objects.table.entry(position));
            if let Some(entry) = entry {
                // A PDO carries the last value where the device has none at the moment.
                let _ = self.app.before_read(&mut self.objects, entry);
            }
        }
        gather(&self.objects, slots.of(self.mapped))
    }

    fn send(&mut self, place: usize) {
        if self.tpdos.get(place).is_some_and(Tpdo::is_usable) {
            let data = self.gather(place);
            self.send_data(place, data);
        }
    }

    fn send_data(&mut self, place: usize, data: u64) {
        let Some(tpdo) = self.tpdos.get_mut(place) else { return };
        let Some(can_id) = tpdo.parameters.can_id else { return };
        // Without room the PDO stays due, and carries newer data once there is room.
        if self.core.queue.room() == 0 {
            tpdo.is_due = true;
            return;
        }
        let bytes = data.to_le_bytes();
        let bytes = bytes.get(..tpdo.parameters.slots.bytes()).unwrap_or_default();
        self.core.queue.send(can_id, bytes);
        tpdo.is_due = false;
        tpdo.inhibit = Timer::after(self.now, tpdo.inhibit_time);
        if tpdo.is_event_driven() && !tpdo.event.is_running() {
            tpdo.event = Timer::after(self.now, tpdo.parameters.event_time);
        }
    }

    /// Why the TPDO with this number from 1 is not being sent at the moment.
    pub(crate) fn why_not_sent(&self, number: u16) -> NotSent {
        let Some(tpdo) = self.tpdos.iter().find(|tpdo| tpdo.parameters.number == number && number > 0) else {
            return NotSent::NoSuchPdo;
        };
        match tpdo.meaning() {
            _ if tpdo.parameters.can_id.is_none() => NotSent::Disabled,
            _ if tpdo.parameters.is_mapping_invalid => NotSent::MappingInvalid,
            _ if tpdo.parameters.slots.count == 0 => NotSent::NothingMapped,
            _ if self.core.state != NmtState::Operational => NotSent::NotOperational(self.core.state),
            Transmission::SynchronousAcyclic if tpdo.is_due => NotSent::WaitsForSync(1),
            Transmission::SynchronousCyclic(_) if tpdo.waits_for_start => {
                NotSent::WaitsForSyncStart(tpdo.sync_start)
            }
            Transmission::SynchronousCyclic(every) => NotSent::WaitsForSync(every.saturating_sub(tpdo.syncs)),
            Transmission::RtrSynchronous | Transmission::RtrEvent => NotSent::WaitsForRequest,
            _ if !tpdo.is_due => NotSent::NoEvent(tpdo.event.deadline()),
            _ if tpdo.is_inhibited(self.now) => NotSent::Inhibited(tpdo.inhibit.deadline()),
            _ => NotSent::QueueFull,
        }
    }
}
