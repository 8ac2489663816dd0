//! The state of each of the two units.

use super::super::control_unit::ControlUnit;
use super::super::eeprom::EepromErrors;
use super::super::error::CanOpenErrors;
use super::super::error_memory::ErrorMemory;
use super::super::event::Refusal;
use super::super::identification::Identification;
use super::super::inputs::Reception;
use super::super::monitoring::Monitoring;
use super::super::period::MainCycle;
use super::super::table::PdoTable;
use super::super::traffic::Traffic;
use edskit_runtime::{Frame, Instant, Microseconds, Storage};

/// How much of the way to communication the gateway has gone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// No communication.
    Undefined,
    /// The governor is initialising it, or has been asked to by the master.
    Init,
    /// It communicates; the node knows its NMT state.
    Ready,
}

/// A unit waits for so many of its main cycles for the other one: about half a second (our choice; the manual says only
/// that the answer does not come in time, 7.2.1; GW-APP-39).
const SILENT_CYCLES: u16 = 32;

/// How often a faulty CANopen bus is tried (9.5 on 12423; GW-APP-27).
const ATTEMPT: Microseconds = Microseconds::from_milliseconds(500);

/// The identification number of the PC program, where nobody gives another one (8.3; our choice).
const TOOL: u16 = 1;

/// The supply that is good, in mV.
const SUPPLY: u16 = 24_000;

/// Whether the other unit is heard.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Silence(u16);

impl Silence {
    /// A main cycle passes, in which the other unit was heard or not.
    pub(super) fn main_cycle(&mut self, is_heard: bool) {
        self.0 = if is_heard { 0 } else { self.0.saturating_add(1) };
    }

    pub(super) fn is_too_long(self) -> bool {
        self.0 >= SILENT_CYCLES
    }
}

/// The governor, DC.
#[derive(Debug)]
pub(super) struct GovernorSide<G> {
    pub(super) unit: ControlUnit,
    pub(super) model: G,
    /// Main cycles since its start.
    pub(super) cycles: u32,
    /// Failed attempts to initialise the gateway.
    pub(super) attempts: u8,
    /// Why the last attempt has failed.
    pub(super) refusal: Option<Refusal>,
    /// What the gateway has accepted, until the next main cycle.
    pub(super) accepted: Option<PdoTable>,
    /// That of the gateway.
    pub(super) silence: Silence,
    pub(super) reception: Reception,
    /// The words of TPDO 1 to 3 as they were sent last since the initialisation.
    pub(super) sent: [Option<[u16; 4]>; 3],
    /// Its errors 3070 ErrCanBus and 3071 ErrCanComm.
    pub(super) can_bus_error: bool,
    pub(super) can_comm_error: bool,
}

impl<G> GovernorSide<G> {
    pub(super) fn new(model: G) -> Self {
        Self {
            unit: ControlUnit::new(MainCycle::GOVERNOR.micros),
            model,
            cycles: 0,
            attempts: 0,
            refusal: None,
            accepted: None,
            silence: Silence::default(),
            reception: Reception::default(),
            sent: [None; 3],
            can_bus_error: false,
            can_comm_error: false,
        }
    }

    /// Its program starts: no error is assumed (9.1; GW-APP-37).
    pub(super) fn start(&mut self) {
        self.cycles = 0;
        self.attempts = 0;
        self.refusal = None;
        self.accepted = None;
        self.silence = Silence::default();
        self.reception = Reception::default();
        self.sent = [None; 3];
        (self.can_bus_error, self.can_comm_error) = (false, false);
    }

    /// Operational is entered: all monitoring begins (7.1.5; GW-APP-09), and no error flag has been received (GW-NOTE-16).
    pub(super) fn begin_operation(&mut self, now: Instant) {
        self.reception.monitoring = [Monitoring::begun(now); 4];
        self.reception.flags = 0;
    }
}

/// The gateway, GW.
#[derive(Debug)]
pub(super) struct GatewaySide<S> {
    pub(super) unit: ControlUnit,
    pub(super) storage: S,
    pub(super) identification: Identification,
    pub(super) phase: Phase,
    /// The PDOs of the present initialisation.
    pub(super) pdos: Option<PdoTable>,
    pub(super) errors: ErrorMemory,
    /// 2005h.
    pub(super) can_open: CanOpenErrors,
    /// That of the governor.
    pub(super) silence: Silence,
    /// That of the partner on CANopen.
    pub(super) heartbeat: Monitoring,
    /// In mV.
    pub(super) supply: u16,
    /// What the next start finds in the EEPROM.
    pub(super) eeprom_code: EepromErrors,
    /// What the last start has found there: 3099.
    pub(super) eeprom_errors: EepromErrors,
    /// The PC program that is connected, and the one with which parameters were stored last: 3850 and 3851 (8.3).
    pub(super) tool: u16,
    pub(super) last_tool: u16,
    /// Buffer states of the HEINZMANN bus, 2401 and 2402, which stay until errors are cleared (GW-NOTE-30).
    pub(super) buffer_states: [bool; 2],
    /// Whether a frame did not fit into the transmit buffer.
    pub(super) has_overflown: bool,
    /// Where the CANopen bus is faulty, or was at the last attempt: when it is tried next.
    pub(super) attempt: Option<Instant>,
    /// What an attempt sends.
    pub(super) attempt_frame: Option<Frame>,
    /// The RPDO that was taken last, until it is recorded.
    pub(super) rpdo: Option<u16>,
    /// Of RPDO 1 to 4, then TPDO 1 to 16.
    pub(super) traffic: [Traffic; 20],
}

impl<S: Storage> GatewaySide<S> {
    pub(super) fn new(mut storage: S) -> Self {
        Self {
            unit: ControlUnit::new(MainCycle::GATEWAY.micros),
            errors: ErrorMemory::load(&mut storage),
            storage,
            identification: Identification::default(),
            phase: Phase::Undefined,
            pdos: None,
            can_open: CanOpenErrors::default(),
            silence: Silence::default(),
            heartbeat: Monitoring::default(),
            supply: SUPPLY,
            eeprom_code: EepromErrors::default(),
            eeprom_errors: EepromErrors::default(),
            tool: TOOL,
            last_tool: 0,
            buffer_states: [false; 2],
            has_overflown: false,
            attempt: None,
            attempt_frame: None,
            rpdo: None,
            traffic: [Traffic::default(); 20],
        }
    }

    /// Its program starts: no error is assumed (9.1; GW-APP-37), what was counted stays (GW-APP-36). Where the CANopen bus is
    /// faulty already, the attempts begin with it (GW-APP-45).
    pub(super) fn start(&mut self, now: Instant, bus_is_faulty: bool) {
        self.errors = ErrorMemory::load(&mut self.storage);
        self.can_open = CanOpenErrors::default();
        self.phase = Phase::Undefined;
        self.pdos = None;
        self.silence = Silence::default();
        self.buffer_states = [false; 2];
        self.has_overflown = false;
        self.attempt = None;
        self.attempt_frame = None;
        if bus_is_faulty {
            self.lose_bus(now);
        }
    }

    /// The CANopen bus is faulty, and will be tried. Attempts that are under way go on.
    pub(super) fn lose_bus(&mut self, now: Instant) {
        self.attempt.get_or_insert(now + ATTEMPT);
    }

    /// The bus is tried where it is time to: its controller is initialised anew, and works if the bus is in order
    /// (GW-APP-46). Whether it was tried.
    pub(super) fn try_bus(&mut self, now: Instant, bus_is_faulty: bool) -> bool {
        let Some(mut due) = self.attempt.filter(|due| *due <= now) else { return false };
        while due <= now {
            due = due + ATTEMPT;
        }
        self.attempt = bus_is_faulty.then_some(due);
        true
    }

    /// Who it is, as far as it can be read (9.4; GW-APP-35).
    pub(super) fn identification(&self) -> Identification {
        match self.eeprom_errors.hides_serial_number() {
            true => Identification { serial_date: 0, serial_number: 0, ..self.identification },
            false => self.identification,
        }
    }
}
