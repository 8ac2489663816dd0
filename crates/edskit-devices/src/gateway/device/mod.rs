//! The gateway as a live device: both control units, the link between them, and the node on CANopen.
//!
//! The manual splits the work between two units (2, table 1; GW-APP-03). The governor runs in main cycles of 15.625 ms:
//! it initialises the gateway, sends the TPDOs, monitors the RPDOs and works with their contents. The gateway runs in
//! main cycles of 16 ms: it has the state machine, the object dictionary, the SDO server and the heartbeats.

mod application;
mod cycles;
mod initialisation;
mod reactions;
mod side;
mod view;

use super::check::RULES;
use super::configuration::{Configuration, OutOfRange};
use super::dictionary::canopen_gateway::Dictionary;
use super::eeprom::EepromErrors;
use super::event::{Event, Events};
use super::fault::{Fault, Faults};
use super::governor::Governor;
use super::identification::Identification;
use super::parameter::{Owner, Parameter};
use super::parameter_memory::ParameterMemory;
use edskit_runtime::{Device, Frame, Instant, NoStorage, Node, Parts, Reset, Settings, Storage};
use side::{GatewaySide, GovernorSide, Phase};

/// The Heinzmann CANopen gateway with the digital governor behind it.
///
/// It is a [`Device`] on CANopen. What else the world does to it are calls: the PC tool changes and stores
/// [parameters](Self::set_parameter) and [clears errors](Self::clear_errors), units are [switched](Self::switch_on) and
/// reset, and [faults](Self::inject) come and go.
///
/// ```
/// use edskit_devices::gateway::{Configuration, Engine, Gateway, State};
/// use edskit_runtime::{Device, Instant, NoStorage};
///
/// let mut gateway = Gateway::new(Configuration::new(), Engine::new(), NoStorage);
/// let mut now = Instant(0);
/// let boot_up = loop {
///     gateway.poll(now);
///     if let Some(frame) = gateway.transmit() {
///         break frame;
///     }
///     now = gateway.next_deadline(now);
/// };
/// assert_eq!((boot_up.can_id().raw(), boot_up.data()), (0x701, &[0x00][..]));
/// assert_eq!(gateway.state(), State::PreOperational);
/// // 200 ms for the start of the units, then two main cycles of the governor.
/// assert_eq!(now, Instant(231_250));
/// ```
#[derive(Debug)]
pub struct Gateway<G, S> {
    node: Node<Unmonitored, NoStorage>,
    plant: Plant<G, S>,
}

/// The generated dictionary without the heartbeat consumer of CiA 301: the gateway monitors its partner itself, in its
/// main cycles and in operational only (7.2.3; GW-NOTE-27), and stays in its state when it is missed (GW-HB-05).
#[derive(Debug)]
struct Unmonitored(Dictionary);

impl edskit_runtime::Dictionary for Unmonitored {
    fn parts(&mut self) -> Parts<'_> {
        Parts { consumers: &mut [], ..self.0.parts() }
    }
}

/// Everything behind the node.
#[derive(Debug)]
struct Plant<G, S> {
    parameters: ParameterMemory,
    governor: GovernorSide<G>,
    gateway: GatewaySide<S>,
    faults: Faults,
    events: Events,
    /// Whether a unit has been switched on or off yet.
    has_begun: bool,
    /// The time of the last call as a [`Device`].
    now: Instant,
}

/// A node with the node-ID that is in effect, before its first call.
fn node(configuration: &Configuration) -> Node<Unmonitored, NoStorage> {
    let settings = Settings {
        node_id: Some(configuration.node_id()),
        // GW-EDS-05, GW-SDO-01
        has_lss: false,
        has_block_transfer: false,
        // What the gateway accepts at its initialisation, its node uses: 003h too (7.1.2.2).
        identifiers: &RULES,
        ..Settings::default()
    };
    Node::new(Unmonitored(Dictionary::new()), settings, NoStorage)
}

impl<G: Governor, S: Storage> Gateway<G, S> {
    /// Both units with these stored parameters, without supply until the first [`poll`](Device::poll). `storage` keeps
    /// the counters of the error memory.
    pub fn new(parameters: Configuration, governor: G, storage: S) -> Self {
        let parameters = ParameterMemory::new(parameters);
        Self {
            node: node(parameters.effective()),
            plant: Plant {
                parameters,
                governor: GovernorSide::new(governor),
                gateway: GatewaySide::new(storage),
                faults: Faults::default(),
                events: Events::default(),
                has_begun: false,
                now: Instant(0),
            },
        }
    }

    /// With this identification instead of the default one (8.1, 8.2; GW-APP-41).
    #[must_use]
    pub fn identified(mut self, identification: Identification) -> Self {
        self.plant.gateway.identification = identification;
        self
    }

    /// The PC tool changes a parameter. It takes effect when its unit has [stored](Self::store) it and starts again
    /// (7; GW-CFG-30).
    ///
    /// # Errors
    /// [`OutOfRange`] if the parameter cannot have the value.
    pub fn set_parameter(&mut self, parameter: Parameter, value: i32) -> Result<(), OutOfRange> {
        self.plant.parameters.set(parameter, value)
    }

    /// The PC tool has a unit store its parameters.
    pub fn store(&mut self, unit: Owner) {
        self.plant.parameters.store(unit);
        if unit == Owner::Gateway {
            self.plant.gateway.last_tool = self.plant.gateway.tool;
        }
    }

    /// A PC program or hand programmer with this identification number is connected, 3850 Identifier (8.3; GW-APP-52).
    pub fn connect_tool(&mut self, identifier: u16) {
        self.plant.gateway.tool = identifier;
    }

    /// A unit gets its supply; nothing happens where it has it.
    pub fn switch_on(&mut self, now: Instant, unit: Owner) {
        self.plant.has_begun = true;
        if !self.plant.unit(unit).is_powered() {
            self.start(now, unit);
        }
    }

    /// A unit loses its supply; nothing happens where it has none.
    pub fn switch_off(&mut self, now: Instant, unit: Owner) {
        if !self.is_powered(unit) {
            return;
        }
        self.plant.unit_mut(unit).switch_off();
        self.plant.events.push(Event::Off(unit));
        if unit == Owner::Gateway {
            self.lead(now, Phase::Undefined);
        }
    }

    /// A unit is reset, as if it lost its supply for a moment; nothing happens where it has none.
    pub fn reset(&mut self, now: Instant, unit: Owner) {
        if self.is_powered(unit) {
            self.switch_off(now, unit);
            self.start(now, unit);
        }
    }

    fn start(&mut self, now: Instant, unit: Owner) {
        self.plant.unit_mut(unit).switch_on(now);
        if unit == Owner::Governor {
            return;
        }
        // The bootloader finds its own page at once, the program the others when it starts.
        let found = self.plant.gateway.eeprom_code;
        if found.holds_in_bootloader() {
            self.plant.gateway.unit.hold();
            self.plant.gateway.eeprom_errors = found;
            self.plant.events.push(Event::EepromErrors(found));
        }
    }

    /// Something goes wrong.
    pub fn inject(&mut self, now: Instant, fault: Fault) {
        if !fault.is_momentary() {
            self.plant.faults.set(fault, true);
        }
        self.react_to(now, fault);
    }

    /// A fault is gone.
    pub fn remove(&mut self, now: Instant, fault: Fault) {
        self.plant.faults.set(fault, false);
        self.update_errors(now);
    }

    /// The PC tool clears the present errors of both units, as far as their causes are gone (9.2, 9.5; GW-APP-36). Where
    /// the governor has given up initialising the gateway, it tries again (GW-APP-14).
    pub fn clear_errors(&mut self, now: Instant) {
        self.plant.clear_errors();
        self.plant.governor.attempts = 0;
        self.update_errors(now);
    }

    /// The supply voltage in mV; below 7.5 V it is told by 3085 ErrVoltage (9.4; GW-APP-34).
    pub fn set_supply(&mut self, now: Instant, millivolts: u16) {
        self.plant.gateway.supply = millivolts;
        self.update_errors(now);
    }

    /// What the next start of the gateway finds in its EEPROM: the bits of 3099 (9.4; GW-APP-35).
    pub fn set_eeprom_code(&mut self, code: impl Into<u16>) {
        self.plant.gateway.eeprom_code = EepromErrors(code.into());
    }

    /// The governor's model.
    pub fn governor_mut(&mut self) -> &mut G {
        &mut self.plant.governor.model
    }

    /// The next event that nobody has taken yet.
    pub fn take_event(&mut self) -> Option<Event> {
        self.plant.events.pop()
    }

    /// Takes the gateway out of communication, into a phase of it.
    fn lead(&mut self, now: Instant, phase: Phase) {
        self.plant.enter_phase(phase);
        self.node.reset(now, Reset::Node, &mut self.plant);
    }
}

impl<G: Governor, S: Storage> Device for Gateway<G, S> {
    /// Takes a frame from CANopen. Frames with 29-bit identifiers and remote frames are not for it (2; GW-EDS-02,
    /// GW-GAP-07).
    fn receive(&mut self, now: Instant, frame: &Frame) {
        if !self.plant.hears() || frame.can_id().is_extended() || frame.is_remote() {
            return;
        }
        self.plant.now = now;
        self.plant.partner_heard(frame);
        self.node.receive(now, frame, &mut self.plant);
        self.plant.record_rpdo(now, frame);
        self.follow_up(now);
    }

    fn poll(&mut self, now: Instant) {
        self.plant.now = now;
        if !self.plant.has_begun {
            self.switch_on(now, Owner::Governor);
            self.switch_on(now, Owner::Gateway);
        }
        self.run_cycles(now);
        self.node.poll(now, &mut self.plant);
        self.follow_up(now);
        self.try_bus(now);
    }

    fn transmit(&mut self) -> Option<Frame> {
        let attempt = self.plant.gateway.attempt_frame.take();
        if let Some(frame) = attempt.filter(|_| self.plant.gateway.unit.is_on()) {
            return Some(frame);
        }
        loop {
            let frame = self.node.transmit()?;
            if self.plant.hears() {
                self.plant.record_tpdo(&frame);
                return Some(frame);
            }
        }
    }

    fn next_deadline(&mut self, now: Instant) -> Instant {
        if !self.plant.has_begun {
            return now;
        }
        let units = self.plant.governor.unit.next().min(self.plant.gateway.unit.next());
        units.min(self.plant.next_attempt()).min(self.node.next_deadline(now)).max(now)
    }
}
