//! The gateway on a bus, what a scenario does to it, and what is told of it.

use super::governor::DescribedEngine;
use super::log::{Line, What};
use super::scenario::{Action, Step};
use crate::config;
use edskit_devices::gateway::{EepromErrors, Event, Gateway, Owner, Parameter, State, measured_value};
use edskit_host::{Bus, BusError, MemoryStorage, Participant, SendError, Station};
use edskit_runtime::{Device, Frame, Instant, Microseconds};
use edskit_types::CanId;
use std::collections::VecDeque;

/// The device.
pub(crate) type LiveGateway = Gateway<DescribedEngine, MemoryStorage>;

/// The errors below the gateway's own, which are those of the engine and its sensors: 3000 to 3069.
pub(super) const ENGINE_ERRORS: u128 = (1 << 70) - 1;

/// What can be read of a gateway that stays in its bootloader, as far as it is modelled: the reason, and list 9.3.2.
const SHOWN_BY_BOOTLOADER: [u16; 6] = [EepromErrors::NUMBER, 3840, 3841, 3842, 3850, 3870];

/// The gateway on its bus.
pub(super) struct Session<B> {
    pub(super) station: Station<LiveGateway, B>,
    /// The NMT master, where it is a participant of its own. On a bus that is not simulated it sends over the connection
    /// of the device, which does not get its own frames back.
    master: Option<Participant>,
    start: Instant,
    steps: VecDeque<Step>,
    lines: Vec<Line>,
    /// The state that was told last.
    state: State,
    /// The errors of engine and sensors that were told last.
    engine_errors: u128,
}

impl<B: Bus> Session<B> {
    /// A gateway that gets its supply with the first [`turn`](Self::turn).
    pub(super) fn new(device: LiveGateway, bus: B, master: Option<Participant>, steps: Vec<Step>) -> Self {
        Self {
            start: bus.now(),
            station: Station::new(device, bus),
            master,
            steps: steps.into(),
            lines: Vec::new(),
            state: State::Undefined,
            engine_errors: 0,
        }
    }

    /// How long it has run.
    pub(super) fn time(&self) -> Microseconds {
        self.station.bus.now().since(self.start)
    }

    /// When so much time since the start has passed.
    pub(super) fn instant(&self, time: Microseconds) -> Instant {
        self.start + time
    }

    /// What was told since the last call.
    pub(super) fn take_lines(&mut self) -> Vec<Line> {
        std::mem::take(&mut self.lines)
    }

    /// Lets the device do what is due, then carries out the steps whose time has come. Says when there is something to do
    /// again if nothing arrives.
    ///
    /// # Errors
    /// As [`Bus::receive`].
    pub(super) fn turn(&mut self) -> Result<Instant, BusError> {
        let mut next = self.round()?;
        while self.steps.front().is_some_and(|step| step.at <= self.time()) {
            let actions = self.steps.pop_front().map(|step| step.actions);
            for action in actions.into_iter().flatten() {
                self.carry_out(action);
            }
            next = self.round()?;
        }
        let next_step = self.steps.front().map_or(Instant::NEVER, |step| self.instant(step.at));
        Ok(next.min(next_step))
    }

    fn round(&mut self) -> Result<Instant, BusError> {
        let next = self.station.round();
        self.collect();
        next
    }

    fn carry_out(&mut self, action: Action) {
        let now = self.station.bus.now();
        match action {
            Action::Read(unit, number) => match self.read(unit, number) {
                Ok(value) => self.tell(value),
                Err(reason) => self.tell(What::step(action, Some(reason))),
            },
            _ => {
                let without_effect = self.act(now, action);
                self.tell(What::step(action, without_effect));
            }
        }
        self.collect();
    }

    /// Does what a step says; the reason where that has no effect.
    fn act(&mut self, now: Instant, action: Action) -> Option<String> {
        let device = &mut self.station.device;
        match action {
            Action::On(unit) if device.is_powered(unit) => return Some("it is on".to_owned()),
            Action::On(unit) => device.switch_on(now, unit),
            Action::Off(unit) | Action::Reset(unit) if !device.is_powered(unit) => {
                return Some("it is off".to_owned());
            }
            Action::Off(unit) => device.switch_off(now, unit),
            Action::Reset(unit) => device.reset(now, unit),
            Action::Set(parameter, value) => {
                return device.set_parameter(parameter, value).err().map(|error| error.to_string());
            }
            Action::Tool(identifier) => device.connect_tool(identifier),
            Action::Store(unit) => device.store(unit),
            Action::Supply(millivolts) => device.set_supply(now, millivolts),
            Action::Eeprom(code) => device.set_eeprom_code(code),
            Action::Setpoint(speed) => device.governor_mut().engine.set_setpoint(speed),
            Action::Load(load) => device.governor_mut().engine.set_load(load),
            Action::Running(is_running) => device.governor_mut().engine.set_running(is_running),
            Action::EngineError(number) | Action::EngineErrorGone(number) => {
                let is_present = matches!(action, Action::EngineError(_));
                let is_known = device.governor_mut().engine.set_error(number, is_present);
                return (!is_known).then(|| "the engine has no such error".to_owned());
            }
            // What is read is told instead.
            Action::Read(..) => {}
            Action::Inject(fault) => device.inject(now, fault),
            Action::Remove(fault) => device.remove(now, fault),
            Action::ClearErrors => device.clear_errors(now),
            Action::Command(state) => {
                let is_followed = device.command(now, state);
                return (!is_followed).then(|| "the gateway does not follow".to_owned());
            }
            Action::Nmt(command) => {
                let sent = self.send(now, &Frame::new(CanId::NMT, &[command.code(), 0]));
                return sent.err().map(|error| error.to_string());
            }
        }
        None
    }

    /// What a unit shows under a number, with the PC tool (GW-APP-51); the reason where it shows nothing.
    fn read(&self, unit: Owner, number: u16) -> Result<What, String> {
        let device = &self.station.device;
        if !device.is_powered(unit) {
            return Err("it is off".to_owned());
        }
        let is_in_bootloader = unit == Owner::Gateway && device.stays_in_bootloader();
        match device.is_running(unit) {
            true => {}
            false if is_in_bootloader && SHOWN_BY_BOOTLOADER.contains(&number) => {}
            false if is_in_bootloader => return Err("the gateway stays in its bootloader".to_owned()),
            false => return Err("its program has not started".to_owned()),
        }
        let amount = device.shown(unit, number).ok_or("nothing is known of it")?;
        let name = match (unit, Parameter::find(unit, number)) {
            (_, Some(parameter)) => parameter.name().map(|name| name.to_string()),
            (Owner::Gateway, None) => measured_value(number).map(str::to_owned),
            (Owner::Governor, None) => device.governor().signals.name(number),
        };
        Ok(What::value(unit, number, name, amount))
    }

    /// Sends a frame of the NMT master.
    fn send(&mut self, now: Instant, frame: &Frame) -> Result<(), SendError> {
        match &mut self.master {
            Some(master) => master.send(frame),
            None => {
                self.station.bus.send(frame)?;
                self.station.device.receive(now, frame);
                Ok(())
            }
        }
    }

    /// Adds a line at the present time.
    pub(super) fn tell(&mut self, what: What) {
        self.lines.push(Line::new(self.time(), what));
    }

    /// Tells what has happened to the bus and to the device.
    fn collect(&mut self) {
        while let Some(event) = self.station.bus.event() {
            self.tell(What::Bus { message: event.to_string() });
        }
        let mut has_started = false;
        while let Some(event) = self.station.device.take_event() {
            has_started |= matches!(event, Event::Started(_));
            self.tell_event(event);
        }
        if has_started {
            self.tell_hindrances();
        }
        // A governor that does not run has no errors; that it is off has been told.
        let is_running = self.station.device.is_running(Owner::Governor);
        let errors = if is_running { self.station.device.all_errors() & ENGINE_ERRORS } else { 0 };
        let before = std::mem::replace(&mut self.engine_errors, errors);
        let changed = if is_running { errors ^ before } else { 0 };
        for nth in (0..70).filter(|nth| changed >> nth & 1 == 1) {
            self.tell(What::governor_error(3000 + nth, errors >> nth & 1 == 1));
        }
    }

    fn tell_event(&mut self, event: Event) {
        match event {
            Event::Started(Owner::Gateway) => {
                let parameters = self.station.device.effective_parameters();
                let node_id = parameters.node_id().get();
                let bit_rate = parameters.bit_rate().map(|rate| rate.kbit_per_s());
                self.tell(What::GatewayStarted { node_id, bit_rate });
            }
            Event::State(state) => {
                self.tell(What::of(event));
                if std::mem::replace(&mut self.state, state) == State::Init && state == State::PreOperational
                {
                    self.tell_capped_times();
                }
            }
            _ => self.tell(What::of(event)),
        }
    }

    /// What keeps the units from hearing each other, once both have started with it (GW-CFG-48).
    fn tell_hindrances(&mut self) {
        let device = &self.station.device;
        let both_run = device.is_running(Owner::Gateway) && device.is_running(Owner::Governor);
        let reason = config::apart(device.effective_parameters()).filter(|_| both_run);
        if let Some(reason) = reason {
            self.tell(What::UnitsApart { reason });
        }
    }

    /// The times of active PDOs that are longer than the longest (GW-NOTE-08).
    fn tell_capped_times(&mut self) {
        let pdos = self.station.device.pdos().into_iter().flat_map(|table| table.iter());
        let capped = pdos.filter(|pdo| pdo.activity.is_active()).filter_map(|pdo| {
            let period = pdo.period.filter(|period| period.is_capped)?;
            Some(What::capped(pdo.period_parameter()?, period))
        });
        for what in capped.collect::<Vec<_>>() {
            self.tell(what);
        }
    }
}
