//! TPDOs: when they are sent, and why they are not.

use super::Parameters;
use super::mapping::bit_of;
use crate::Application;
use crate::context::Context;
use crate::dictionary::Position;
use crate::services::Services;
use crate::time::Timer;
use crate::{Instant, Microseconds};
use edskit_types::{NmtState, Transmission};

/// A TPDO at work.
#[derive(Clone, Copy, Debug)]
pub struct Tpdo {
    pub(super) parameters: Parameters,
    /// In multiples of 100 µs.
    inhibit_time: u16,
    pub(super) sync_start: u8,
    /// A bit for each value that it carries; others may have the same one.
    carries: u32,
    /// Whether an event has happened that has not been sent yet.
    pub(super) is_due: bool,
    /// Whether it is to be sent as soon as the queue has room, whatever else holds: its SYNC message has come, or a request.
    pub(super) is_ready: bool,
    /// Runs while the PDO must not be sent again.
    inhibit: Timer,
    /// Runs to the next transmission without an event.
    event: Timer,
    /// SYNC messages since the last transmission.
    pub(super) syncs: u8,
    /// Whether the SYNC message with the start value has not come yet.
    pub(super) waits_for_start: bool,
    /// Data sampled at the last SYNC message, for type 252, and for what has no room yet.
    pub(super) sample: Option<u64>,
}

impl Tpdo {
    /// A place for a TPDO.
    pub const NEW: Self = Self {
        parameters: Parameters::NONE,
        inhibit_time: 0,
        sync_start: 0,
        carries: 0,
        is_due: false,
        is_ready: false,
        inhibit: Timer::OFF,
        event: Timer::OFF,
        syncs: 0,
        waits_for_start: false,
        sample: None,
    };

    pub(super) fn meaning(&self) -> Transmission {
        self.parameters.meaning
    }

    fn is_event_driven(&self) -> bool {
        matches!(self.meaning(), Transmission::EventManufacturer | Transmission::EventProfile)
    }

    /// Whether an event leads to a transmission, at once or with the next SYNC message.
    fn has_events(&self) -> bool {
        self.is_event_driven() || self.meaning() == Transmission::SynchronousAcyclic
    }

    /// The time between two transmissions without an event, which only types FEh and FFh have; 0 for none.
    #[inline(never)]
    fn event_period(&self) -> Microseconds {
        if self.is_event_driven() { self.parameters.event_time() } else { Microseconds(0) }
    }

    /// Whether the PDO exists and carries something.
    pub(super) fn is_usable(&self) -> bool {
        self.parameters.can_id.is_some() && self.parameters.slots.count > 0
    }

    fn is_inhibited(&self, now: Instant) -> bool {
        self.inhibit.is_running() && !self.inhibit.is_due(now)
    }

    /// When it is to be sent; what only the queue holds back is due when the queue has room.
    pub(crate) fn deadline(&self, now: Instant, has_room: bool) -> Instant {
        let is_sent_by_event = self.is_due && self.is_event_driven();
        let waiting = if !self.is_usable() || !(self.is_ready || is_sent_by_event) {
            Instant::NEVER
        } else if !self.is_ready && self.is_inhibited(now) {
            self.inhibit.deadline()
        } else if has_room {
            Instant::default()
        } else {
            Instant::NEVER
        };
        waiting.min(self.event.deadline())
    }

    /// It ends with all that it had besides its parameters.
    fn end(&mut self) {
        self.end_of_type();
        self.is_due = false;
        self.inhibit = Timer::OFF;
        self.event = Timer::OFF;
    }

    /// It ends with what it had because of its transmission type.
    fn end_of_type(&mut self) {
        self.is_ready = false;
        self.syncs = 0;
        self.waits_for_start = self.sync_start > 0;
        self.sample = None;
    }

    /// It begins, in the state operational.
    fn begin(&mut self, now: Instant, is_event: bool) {
        self.end();
        if self.parameters.can_id.is_some() {
            self.is_due = is_event && self.has_events();
            self.event = Timer::after(now, self.event_period());
        }
    }
}

/// Why a TPDO is not being sent at the moment.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NotSent {
    /// The device has no TPDO of this number.
    NoSuchPdo,
    /// It does not exist: bit 31 of its COB-ID is 1, or its COB-ID or transmission type cannot be used.
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

impl Services<'_> {
    /// An event of the TPDO with this number from 1 has happened.
    pub fn trigger(&mut self, number: u16) {
        if self.core.state == NmtState::Operational {
            let is_it = |tpdo: &&mut Tpdo| tpdo.parameters.number == number;
            if let Some(tpdo) = self.tpdos.iter_mut().find(is_it) {
                tpdo.is_due = tpdo.has_events();
            }
        }
    }

    /// A value has changed: an event of every TPDO that carries it.
    pub(crate) fn value_changed(&mut self, position: Position) {
        if self.core.state != NmtState::Operational {
            return;
        }
        let bit = bit_of(position);
        for tpdo in self.tpdos.iter_mut().filter(|tpdo| tpdo.carries & bit != 0) {
            let mut values = tpdo.parameters.slots.of(self.mapped).iter();
            if tpdo.has_events() && values.any(|mapped| mapped.position() == Some(position)) {
                tpdo.is_due = true;
            }
        }
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// What is left of a TPDO with other parameters. Of one that is not the same any more, nothing is: it begins. A sample,
    /// a count and a transmission that waits for room belong to the transmission type; an event stays one as long as the
    /// type has events. The event timer runs as long as type and time ask for it, and begins anew when its time is another.
    pub(super) fn tpdo_changed(
        &mut self,
        place: usize,
        new: Parameters,
        inhibit_time: u16,
        sync_start: u8,
        is_remapped: bool,
    ) {
        let is_operational = self.node.core.state == NmtState::Operational;
        let Some(tpdo) = self.node.tpdos.get_mut(place) else { return };
        // The device may change what a client cannot while the PDO exists.
        let has_other_times = inhibit_time != tpdo.inhibit_time || sync_start != tpdo.sync_start;
        let is_same = new.is_same_pdo(&tpdo.parameters, is_remapped) && !has_other_times;
        let (old_meaning, old_period) = (tpdo.meaning(), tpdo.event_period());
        tpdo.parameters = new;
        tpdo.inhibit_time = inhibit_time;
        tpdo.sync_start = sync_start;
        tpdo.carries = new.slots.carries(self.node.mapped);
        if !is_same {
            tpdo.end();
            if is_operational {
                tpdo.begin(self.node.now, self.app.sends_at_start(new.number));
            }
            return;
        }
        if tpdo.meaning() != old_meaning {
            tpdo.end_of_type();
            tpdo.is_due &= tpdo.has_events();
        } else if !new.allows_rtr && !tpdo.is_of_a_period() {
            tpdo.is_ready = false;
        }
        if is_operational && tpdo.event_period() != old_period {
            tpdo.event = Timer::after(self.node.now, tpdo.event_period());
        }
    }

    /// Every PDO begins anew: the state operational is entered.
    pub(crate) fn start_pdos(&mut self) {
        for tpdo in self.node.tpdos.iter_mut() {
            tpdo.begin(self.node.now, self.app.sends_at_start(tpdo.parameters.number));
        }
        self.node.core.next_tpdo = 0;
    }

    /// The state operational is left: no PDO is sent or received any more.
    pub(crate) fn stop_pdos(&mut self) {
        for tpdo in self.node.tpdos.iter_mut() {
            tpdo.end();
        }
        for place in 0..self.node.rpdos.len() {
            self.end_rpdo(place);
        }
    }

    /// Sends what is due, beginning with the TPDO for which there was no room the last time.
    pub(crate) fn poll_tpdos(&mut self) {
        if self.node.core.state != NmtState::Operational {
            return;
        }
        let now = self.node.now;
        let is_calm = |tpdo: &Tpdo| !(tpdo.is_ready || tpdo.is_due || tpdo.event.is_due(now));
        if self.node.tpdos.iter().all(is_calm) {
            self.node.core.next_tpdo = 0;
            return;
        }
        let mut without_room = None;
        let count = self.node.tpdos.len();
        for step in 0..count {
            let place = usize::from(self.node.core.next_tpdo) + step;
            let place = if place < count { place } else { place - count };
            let Some(tpdo) = self.node.tpdos.get_mut(place) else { continue };
            if tpdo.event.is_due(self.node.now) {
                tpdo.event = tpdo.event.again(self.node.now, tpdo.event_period());
                tpdo.is_due = true;
            }
            let is_sent_by_event = tpdo.is_due && tpdo.is_event_driven() && !tpdo.is_inhibited(self.node.now);
            if (tpdo.is_ready || is_sent_by_event) && !self.send(place) {
                without_room.get_or_insert(place as u16);
            }
        }
        self.node.core.next_tpdo = without_room.unwrap_or(0);
    }

    /// The present data of a TPDO.
    pub(super) fn gather(&mut self, place: usize) -> u64 {
        let Some(tpdo) = self.node.tpdos.get(place) else { return 0 };
        let Parameters { number, slots, .. } = tpdo.parameters;
        self.app.tpdo_due(&mut self.node, number);
        for place in 0..slots.count {
            let mapped = self.node.mapped.get(usize::from(slots.first) + usize::from(place));
            let entry = mapped.and_then(|mapped| self.node.objects.table.entry(mapped.position()?));
            if let Some(entry) = entry {
                // A PDO carries the last value where the device has none at the moment.
                let _ = self.app.before_read(&mut self.node, entry);
            }
        }
        self.gather_values(slots)
    }

    /// Sends a TPDO, with the data of its SYNC message where there are any; false where the queue has no room.
    pub(super) fn send(&mut self, place: usize) -> bool {
        let Some(tpdo) = self.node.tpdos.get(place).filter(|tpdo| tpdo.is_usable()) else { return true };
        if self.node.core.queue.room() == 0 {
            return false;
        }
        let sample = tpdo.sample;
        if sample.is_some() && tpdo.is_of_a_period() && self.window_has_passed() {
            self.lose_late(place);
            return true;
        }
        let data = sample.unwrap_or_else(|| self.gather(place));
        let Some(tpdo) = self.node.tpdos.get_mut(place) else { return true };
        let Some(can_id) = tpdo.parameters.can_id else { return true };
        let bytes = data.to_le_bytes();
        let bytes = bytes.get(..tpdo.parameters.slots.bytes()).unwrap_or_default();
        self.node.core.queue.send(can_id, bytes);
        tpdo.is_ready = false;
        if tpdo.meaning() != Transmission::RtrSynchronous {
            tpdo.sample = None;
        }
        // An event since the SYNC message is not in these data.
        tpdo.is_due &= sample.is_some();
        tpdo.inhibit = Timer::after(self.node.now, Microseconds::from_inhibit_time(tpdo.inhibit_time));
        true
    }

    /// Why the TPDO with this number from 1 is not being sent at the moment.
    pub(crate) fn why_not_sent(&self, number: u16) -> NotSent {
        let Some(tpdo) = self.node.tpdos.iter().find(|tpdo| tpdo.parameters.number == number && number > 0)
        else {
            return NotSent::NoSuchPdo;
        };
        match tpdo.meaning() {
            _ if tpdo.parameters.can_id.is_none() => NotSent::Disabled,
            _ if tpdo.parameters.is_mapping_invalid => NotSent::MappingInvalid,
            _ if tpdo.parameters.slots.count == 0 => NotSent::NothingMapped,
            _ if self.node.core.state != NmtState::Operational => {
                NotSent::NotOperational(self.node.core.state)
            }
            _ if tpdo.is_ready => NotSent::QueueFull,
            Transmission::SynchronousAcyclic if tpdo.is_due => NotSent::WaitsForSync(1),
            Transmission::SynchronousCyclic(_) if tpdo.waits_for_start => {
                NotSent::WaitsForSyncStart(tpdo.sync_start)
            }
            Transmission::SynchronousCyclic(every) => NotSent::WaitsForSync(every.saturating_sub(tpdo.syncs)),
            Transmission::RtrSynchronous | Transmission::RtrEvent => NotSent::WaitsForRequest,
            _ if !tpdo.is_due => NotSent::NoEvent(tpdo.event.deadline()),
            _ if tpdo.is_inhibited(self.node.now) => NotSent::Inhibited(tpdo.inhibit.deadline()),
            _ => NotSent::QueueFull,
        }
    }
}
