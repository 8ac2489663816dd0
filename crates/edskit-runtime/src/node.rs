//! The node: a dictionary with all services of CiA 301 and CiA 305.

use crate::context::{Context, Core};
use crate::dictionary::{Dictionary, Position};
use crate::emcy::Emcy;
use crate::guarding::Guarding;
use crate::heartbeat::Producer;
use crate::lss::Lss;
use crate::queue::Queue;
use crate::sync::Sync;
use crate::{
    Application, EmcyError, Entry, Frame, Instant, Leds, NoApplication, NotSent, Objects, Pattern, Reset,
    Storage,
};
use edskit_types::{AbortCode, BitRates, IdentifierRules, NmtState, NodeId};

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
    /// Whether its SDO servers know block transfer, which is optional in CiA 301.
    pub has_block_transfer: bool,
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
        has_block_transfer: true,
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
    pub fn new(dictionary: D, settings: Settings, storage: S) -> Self {
        let core = Core {
            settings,
            node_id: None,
            pending_node_id: None,
            node_id_of_reset: None,
            state: NmtState::Initialising,
            has_started: false,
            is_held: false,
            queue: Queue::new(),
            has_overrun: false,
            next_tpdo: 0,
            refused_values: 0,
            emcy: Emcy::new(),
            producer: Producer::OFF,
            guarding: Guarding::new(),
            sync: Sync::new(),
            lss: Lss::new(),
        };
        Self { dictionary, storage, core }
    }

    fn context<'a>(&'a mut self, now: Instant, app: &'a mut dyn Application) -> Context<'a> {
        let parts = self.dictionary.parts();
        Context {
            now,
            objects: parts.objects,
            rpdos: parts.rpdos,
            tpdos: parts.tpdos,
            mapped: parts.mapped,
            servers: parts.servers,
            consumers: parts.consumers,
            buffers: parts.buffers,
            core: &mut self.core,
            app,
            storage: &mut self.storage,
        }
    }

    /// Takes a frame from the bus. Frames before the first [`poll`](Node::poll) are lost, as before power-on.
    pub fn receive(&mut self, now: Instant, frame: &impl embedded_can::Frame, app: &mut dyn Application) {
        if self.core.has_started && !self.core.is_held {
            self.context(now, app).receive(&Frame::of(frame));
        }
    }

    /// Does what is due: boots up, sends heartbeats and PDOs, ends transfers whose client is silent, and so on.
    pub fn poll(&mut self, now: Instant, app: &mut dyn Application) {
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
    pub fn reset(&mut self, now: Instant, reset: Reset, app: &mut dyn Application) {
        self.context(now, app).initialise(reset);
    }

    /// Leads the node to another state, as the NMT master could. Nothing happens while it is initialising, and
    /// [`NmtState::Initialising`] cannot be entered in this way: see [`reset`](Node::reset).
    pub fn enter(&mut self, now: Instant, state: NmtState, app: &mut dyn Application) {
        if state != NmtState::Initialising {
            self.context(now, app).enter(state);
        }
    }

    /// An error of the device has occurred: it is told by an EMCY message, unless it is present already. `source` tells
    /// errors of one kind apart.
    ///
    /// There is room for 32 errors of the device at once, whatever the services of the node find besides. A further one is
    /// told each time that it is raised, and is not in the error register afterwards.
    pub fn raise(
        &mut self,
        now: Instant,
        error: EmcyError,
        source: u16,
        info: [u8; 5],
        app: &mut dyn Application,
    ) {
        self.context(now, app).raise(error, source, info);
    }

    /// An error of the device has gone.
    pub fn clear(&mut self, now: Instant, error: EmcyError, source: u16, app: &mut dyn Application) {
        self.context(now, app).clear(error, source);
    }

    /// An event of the TPDO with this number from 1 has happened: it is sent as its transmission type says. Types that no
    /// event sends have none.
    pub fn trigger_tpdo(&mut self, now: Instant, number: u16) {
        self.context(now, &mut NoApplication).tpdo_event(number);
    }

    /// The device has changed a value: an event of each TPDO that carries it. What a client or an RPDO writes is an event
    /// where [`Application::write_is_event`] says so.
    pub fn value_changed(&mut self, now: Instant, position: Position) {
        self.context(now, &mut NoApplication).value_changed(position);
    }

    /// The device has changed a parameter of 1000h to 1FFFh itself: the service follows it as if a client had written it.
    /// A value that a client could not write has no effect. Of a mapping, sub-index 00h stands for the whole.
    pub fn parameter_changed(&mut self, now: Instant, position: Position, app: &mut dyn Application) {
        let mut context = self.context(now, app);
        if let Some(entry) = context.objects.table.entry(position)
            && context.core.has_started
            && !context.core.is_held
        {
            context.parameter_changed(entry);
        }
    }

    /// Calls `report` with every entry whose present value is one that a client could not write, and with the abort code
    /// that it would get. Wherever such a value comes from, it has no effect: the service that it belongs to does not
    /// exist, or works as if the object did not. Without a node-ID nothing is reported.
    pub fn refused(&mut self, app: &mut dyn Application, report: &mut dyn FnMut(&Entry, AbortCode)) {
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
        Leds { run, error: self.core.emcy.pattern() }
    }
}
