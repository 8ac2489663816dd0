//! The node: a dictionary with all services of CiA 301 and CiA 305.

use crate::context::{Context, Core};
use crate::dictionary::Dictionary;
use crate::emcy::Emcy;
use crate::guarding::Guarding;
use crate::heartbeat::Producer;
use crate::lss::Lss;
use crate::queue::Queue;
use crate::services::{Requests, Services};
use crate::sync::Sync;
use crate::{
    Application, BusState, Entry, Frame, Instant, Leds, Microseconds, NoApplication, NotSent, Objects,
    Pattern, PdoPolicy, Reset, Storage,
};
use edskit_types::{AbortCode, BitRates, CanId, IdentifierRules, NmtState, NodeId};

/// What a node is told besides its dictionary. A generated dictionary has the constant `SETTINGS`, which says what
/// `[DeviceInfo]` of its EDS does.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// The node-ID at power-on, where LSS has stored none; `None` waits for LSS.
    pub node_id: Option<NodeId>,
    /// Whether the node goes to operational by itself, where the dictionary has no 1F80h that says so.
    pub starts_by_itself: bool,
    /// The bit rates that LSS may configure.
    pub bit_rates: BitRates,
    /// Whether the node is an LSS slave (CiA 305).
    pub has_lss: bool,
    /// Whether its SDO servers know transfers in segments. Of a device that does not, a client gets
    /// [`AbortCode::UNKNOWN_COMMAND`] for a value of more than four bytes.
    pub has_segmented_transfer: bool,
    /// Whether its SDO servers know block transfer, which is optional in CiA 301.
    pub has_block_transfer: bool,
    /// The identifier of the SYNC message where the dictionary has no 1005h; `None` for none.
    pub sync: Option<CanId>,
    /// Whether EMCY messages are sent with 80h and the node-ID where the dictionary has no 1014h.
    pub sends_emergencies: bool,
    /// How the parameters of PDOs are treated.
    pub pdos: PdoPolicy,
    /// Mapped values have a multiple of so many bits (`Granularity` of the EDS); 0 and 1 allow any length.
    pub granularity: u8,
    /// Which identifiers the services may have (CiA 301, 7.3.5). A device whose manual allows others has rules of its own;
    /// what they do not allow has no effect, wherever it comes from.
    pub identifiers: &'static IdentifierRules<'static>,
}

impl Settings {
    /// Node-ID 1, no self-start, every bit rate, LSS and block transfer, mapping by the bit, the identifiers of
    /// CiA 301.
    pub const DEFAULT: Self = Self {
        node_id: Some(NodeId::MIN),
        starts_by_itself: false,
        bit_rates: BitRates::ALL,
        has_lss: true,
        has_segmented_transfer: true,
        has_block_transfer: true,
        sync: None,
        sends_emergencies: false,
        pdos: PdoPolicy::CIA_301,
        granularity: 1,
        identifiers: &IdentifierRules::CIA_301,
    };
}

impl Default for Settings {
    /// [`Settings::DEFAULT`].
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// A CANopen node.
///
/// It does nothing by itself: [`receive`](Node::receive) hands it frames, [`poll`](Node::poll) lets it do what is due,
/// [`transmit`](Node::transmit) takes the frames that it wants to send, and [`next_deadline`](Node::next_deadline) says
/// when to poll again. The work of each call is bounded, nothing is allocated, and no frame makes it panic.
#[derive(Debug)]
pub struct Node<D, S> {
    dictionary: D,
    storage: S,
    core: Core,
}

impl<D: Dictionary, S: Storage> Node<D, S> {
    /// A node that has not been powered on yet: the first [`poll`](Node::poll) does that.
    pub const fn new(dictionary: D, settings: Settings, storage: S) -> Self {
        let core = Core {
            settings,
            node_id: None,
            pending_node_id: None,
            node_id_of_reset: None,
            bit_rate: None,
            state: NmtState::Initialising,
            has_started: false,
            is_held: false,
            queue: Queue::new(),
            has_overrun: false,
            bus_state: BusState::Active,
            next_tpdo: 0,
            requests: Requests::NONE,
            answer_delay: Microseconds(0),
            refused_values: 0,
            emcy: Emcy::new(),
            producer: Producer::OFF,
            guarding: Guarding::new(),
            sync: Sync::new(),
            lss: Lss::new(),
        };
        Self { dictionary, storage, core }
    }

    fn context<'a, A: Application + ?Sized>(&'a mut self, now: Instant, app: &'a mut A) -> Context<'a, A> {
        Context { node: self.services(now), app }
    }

    /// Takes a frame from the bus. Frames before the first [`poll`](Node::poll) are lost, as before power-on.
    pub fn receive(
        &mut self,
        now: Instant,
        frame: &impl embedded_can::Frame,
        app: &mut (impl Application + ?Sized),
    ) {
        if self.core.has_started && !self.core.is_held {
            let mut context = self.context(now, app);
            context.receive(&Frame::of(frame));
            context.do_requests();
        }
    }

    /// Does what is due: boots up, sends heartbeats and PDOs, ends transfers whose client is silent, and so on.
    pub fn poll(&mut self, now: Instant, app: &mut (impl Application + ?Sized)) {
        self.context(now, app).poll();
    }

    /// The next frame to be sent; `None` where there is none for now.
    pub fn transmit(&mut self) -> Option<Frame> {
        self.core.queue.pop()
    }

    /// When [`poll`](Node::poll) has something to do, unless a frame comes before; `now` where it has already, and
    /// [`Instant::NEVER`] where only a frame can change something.
    pub fn next_deadline(&mut self, now: Instant) -> Instant {
        self.context(now, &mut NoApplication).next_deadline()
    }

    /// The dictionary.
    pub fn objects(&mut self) -> Objects<'_> {
        self.dictionary.parts().objects
    }

    /// The NMT state.
    pub fn state(&self) -> NmtState {
        self.core.state
    }

    /// The node-ID in use; `None` while the node waits for one.
    pub fn node_id(&self) -> Option<NodeId> {
        self.core.node_id
    }

    /// Resets the node, as the NMT master could.
    pub fn reset(&mut self, now: Instant, reset: Reset, app: &mut (impl Application + ?Sized)) {
        self.context(now, app).initialise(reset);
    }

    /// Leads the node to another state, as the NMT master could. Nothing happens while it is initialising, and
    /// [`NmtState::Initialising`] cannot be entered in this way: see [`reset`](Node::reset).
    pub fn enter(&mut self, now: Instant, state: NmtState, app: &mut (impl Application + ?Sized)) {
        self.context(now, app).enter(state);
    }

    /// The CAN controller is in another state. Error passive is told by EMCY 8120h while it lasts, and a recovery from bus-off
    /// by 8140h; bus-off is a communication error to which the node reacts as 1029h says
    /// ([`Application::reaction`]). The red indicator shows each.
    pub fn bus_state(&mut self, now: Instant, state: BusState, app: &mut (impl Application + ?Sized)) {
        let mut context = self.context(now, app);
        context.bus_found(state);
        context.do_requests();
    }

    /// The dictionary and the services, for what the device does between the calls of the node: raise an error, trigger a
    /// TPDO, and so on.
    ///
    /// ```
    /// use edskit_runtime::{Dictionary, EmcyError, Instant, Node, Storage};
    ///
    /// fn too_hot<D: Dictionary, S: Storage>(node: &mut Node<D, S>, now: Instant) {
    ///     node.services(now).raise(EmcyError { code: 0x4210, register: 1 << 3 }, 0, [0; 5]);
    /// }
    /// ```
    pub fn services(&mut self, now: Instant) -> Services<'_> {
        let parts = self.dictionary.parts();
        Services {
            now,
            objects: parts.objects,
            rpdos: parts.rpdos,
            tpdos: parts.tpdos,
            mapped: parts.mapped,
            servers: parts.servers,
            consumers: parts.consumers,
            buffers: parts.buffers,
            core: &mut self.core,
            storage: &mut self.storage,
        }
    }

    /// Calls `report` with every entry whose present value is one that a client could not write, and with the abort code
    /// that it would get. Wherever such a value comes from, it has no effect: the service that it belongs to does not
    /// exist, or works as if the object did not. Without a node-ID nothing is reported.
    pub fn refused(
        &mut self,
        app: &mut (impl Application + ?Sized),
        report: &mut dyn FnMut(&Entry, AbortCode),
    ) {
        self.context(Instant::default(), app).refused(report);
    }

    /// How many values of RPDOs were refused since the node was made, by their limits or by the device; it stops at the
    /// highest number. [`Application::rpdo_value_refused`] is told each.
    pub fn refused_rpdo_values(&self) -> u32 {
        self.core.refused_values
    }

    /// Why the TPDO with this number from 1 is not being sent at the moment.
    pub fn why_not_sent(&mut self, now: Instant, number: u16) -> NotSent {
        self.context(now, &mut NoApplication).why_not_sent(number)
    }

    /// What the indicators show.
    pub fn leds(&self) -> Leds {
        let run = match self.core.state {
            _ if self.core.lss.is_in_configuration() || self.core.node_id.is_none() => Pattern::Flickering,
            NmtState::Initialising => Pattern::Off,
            NmtState::Stopped => Pattern::SingleFlash,
            NmtState::PreOperational => Pattern::Blinking,
            NmtState::Operational => Pattern::On,
        };
        let error = match self.core.bus_state {
            BusState::Off => Pattern::On,
            state => self.core.emcy.pattern(state != BusState::Active),
        };
        Leds { run, error }
    }
}
