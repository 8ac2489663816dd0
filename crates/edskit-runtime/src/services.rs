//! What a device can do from within its calls.

use crate::Application;
use crate::access::is_communication;
use crate::context::{Context, Core};
use crate::heartbeat_consumer::HeartbeatConsumer;
use crate::pdo::{Mapped, Rpdo, Tpdo};
use crate::ring::Ring;
use crate::sdo::SdoServer;
use crate::{Entry, Handle, Instant, Microseconds, Objects, Position, Reset, Storage, Value};
use edskit_types::{AbortCode, CanId, CobId, Index, NmtState, NodeId};

/// The node, as a device has it while the node calls it, and by [`Node::services`](crate::Node::services) between the calls:
/// the time, the dictionary, and the services.
pub struct Services<'a> {
    pub(crate) now: Instant,
    /// The dictionary.
    pub objects: Objects<'a>,
    pub(crate) rpdos: &'a mut [Rpdo],
    pub(crate) tpdos: &'a mut [Tpdo],
    pub(crate) mapped: &'a mut [Mapped],
    pub(crate) servers: &'a mut [SdoServer],
    pub(crate) consumers: &'a mut [HeartbeatConsumer],
    pub(crate) buffers: &'a mut [u8],
    pub(crate) core: &'a mut Core,
    pub(crate) storage: &'a mut dyn Storage,
}

/// What the device has asked for within a call, and what is done when the node's call ends: it leads to calls of the device,
/// which is in the middle of one.
#[derive(Debug)]
pub(crate) struct Requests {
    /// The parameters that it has changed.
    updates: Ring<Position, MOST_UPDATES>,
    /// Whether there was no room for one of them: then all are looked at.
    updates_all: bool,
    state: Option<NmtState>,
    reset: Option<Reset>,
}

/// How many parameters can wait for their services to follow them one by one.
const MOST_UPDATES: usize = 8;

impl Requests {
    pub(crate) const NONE: Self =
        Self { updates: Ring::new(Position(0)), updates_all: false, state: None, reset: None };

    /// Whether there is something to be done.
    pub(crate) fn is_some(&self) -> bool {
        !self.updates.is_empty() || self.updates_all || self.state.is_some() || self.reset.is_some()
    }
}

impl Services<'_> {
    /// The time of the call.
    #[must_use]
    pub fn now(&self) -> Instant {
        self.now
    }

    /// The NMT state.
    #[must_use]
    pub fn state(&self) -> NmtState {
        self.core.state
    }

    /// The node-ID in use; `None` while the node waits for one.
    #[must_use]
    pub fn node_id(&self) -> Option<NodeId> {
        self.core.node_id
    }

    /// Whether an SDO client may read an entry now. The places of the history 1003h that no error has taken hold nothing.
    ///
    /// # Errors
    /// [`AbortCode::WRITE_ONLY`], and [`AbortCode::NO_DATA`] for such a place (CiA 301 v4.2, 7.5.2.4).
    pub fn check_read(&self, entry: &Entry) -> Result<(), AbortCode> {
        self.objects.check_read(entry)?;
        if entry.index == Index::PREDEFINED_ERROR_FIELD && entry.sub_index.0 > 0 {
            let count: u8 = self.objects.value(entry.index, 0).unwrap_or_default();
            if entry.sub_index.0 > count {
                return Err(AbortCode::NO_DATA);
            }
        }
        Ok(())
    }

    /// What the device has begun to do within this call takes so long: an SDO client that has asked for it gets its answer
    /// then, and not before. Meanwhile its server takes no other request.
    pub fn answer_after(&mut self, time: Microseconds) {
        self.core.answer_delay = time;
    }

    /// Gives an entry a value; where it is another one than before, that is an event of each TPDO that carries the entry.
    pub fn put<T: Value>(&mut self, handle: Handle<T>, value: T) {
        let position = handle.position();
        let mut bytes = [0; 8];
        let old = self.objects.bytes(position);
        let bytes = bytes.get_mut(..old.len()).unwrap_or_default();
        value.to_bytes(bytes);
        if old != bytes {
            self.objects.set(handle, value);
            self.value_changed(position);
        }
    }

    /// The device has changed a value: an event of each TPDO that carries it. What a client or an RPDO writes is an event
    /// where [`Application::write_is_event`](crate::Application::write_is_event) says so.
    pub fn changed(&mut self, at: impl Into<Position>) {
        self.value_changed(at.into());
    }

    /// The device has changed a parameter of 1000h to 1FFFh: the service follows it as if a client had written it, at the
    /// end of the node's call, or with its next [`poll`](crate::Node::poll). A value that a client could not write has no
    /// effect. Of a mapping, sub-index 00h stands for the whole.
    pub fn update(&mut self, at: impl Into<Position>) {
        let requests = &mut self.core.requests;
        requests.updates_all |= !requests.updates.push(at.into());
    }

    /// Leads the node to another state at the end of its call, or with its next [`poll`](crate::Node::poll); the last one
    /// that was asked for counts.
    pub fn enter(&mut self, state: NmtState) {
        self.core.requests.state = Some(state);
    }

    /// Resets the node at the end of its call, or with its next [`poll`](crate::Node::poll).
    pub fn reset(&mut self, reset: Reset) {
        self.core.requests.reset = Some(reset);
    }

    /// Whether the node is in a state in which SDO, SYNC, EMCY and TIME work.
    pub(crate) fn is_communicating(&self) -> bool {
        matches!(self.core.state, NmtState::PreOperational | NmtState::Operational)
    }

    /// What holds for every COB-ID: 29-bit identifiers are not supported, and what CiA 301, or the device in its place,
    /// restricts cannot be used by a valid one.
    pub(crate) fn check_cob_id(&self, cob_id: CobId) -> Result<(), AbortCode> {
        if self.core.settings.identifiers.fault(cob_id).is_some() {
            return Err(AbortCode::INVALID_VALUE);
        }
        Ok(())
    }

    /// The identifier in an entry whose bit 31 says that the service does not exist; `None` where it says so, and where the
    /// value is one that a client could not write.
    #[inline(never)]
    pub(crate) fn valid_can_id(&self, index: Index, sub_index: u8) -> Option<CanId> {
        let cob_id = self.objects.value(index, sub_index).map(CobId)?;
        (cob_id.is_valid() && self.check_cob_id(cob_id).is_ok()).then(|| cob_id.can_id())
    }
}

impl<A: Application + ?Sized> Context<'_, A> {
    /// Does what the device has asked for. What it asks for meanwhile waits for the next call.
    pub(crate) fn do_requests(&mut self) {
        if !self.node.core.requests.is_some() {
            return;
        }
        let mut requests = core::mem::replace(&mut self.node.core.requests, Requests::NONE);
        if let Some(reset) = requests.reset {
            // All parameters are taken anew.
            return self.initialise(reset);
        }
        let table = self.node.objects.table;
        if requests.updates_all {
            for (_, entry) in table.all().filter(|(_, entry)| is_communication(entry.index)) {
                self.parameter_changed(entry);
            }
        }
        while let Some(position) = requests.updates.pop() {
            if let Some(entry) = table.entry(position) {
                self.parameter_changed(entry);
            }
        }
        if let Some(state) = requests.state {
            self.enter(state);
        }
    }
}
