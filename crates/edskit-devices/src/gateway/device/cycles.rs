//! What both units do in their main cycles.

use super::super::agreement::{GATEWAY_LINK, GOVERNOR_LINK};
use super::super::configuration::Configuration;
use super::super::control_unit::{ControlUnit, Step};
use super::super::governor::Governor;
use super::super::inputs::{Inputs, Reception};
use super::super::parameter::{Owner, Parameter, Quantity, known};
use super::super::pdo::{Pdo, Source};
use super::{Gateway, Plant, node};
use edskit_runtime::{Instant, Microseconds, Objects, Storage};

/// How long each unit waits after its start before it misses the other one (7.2.1; GW-CFG-31).
const GATEWAY_DELAY: Parameter = known(Owner::Gateway, 400);
const GOVERNOR_DELAY: Parameter = known(Owner::Governor, 400);

impl<G: Governor, S: Storage> Gateway<G, S> {
    /// Every start and main cycle that is due, in the order of time; the governor first where both are.
    pub(super) fn run_cycles(&mut self, now: Instant) {
        loop {
            let governor_first = self.plant.governor.unit.next() <= self.plant.gateway.unit.next();
            let owner = if governor_first { Owner::Governor } else { Owner::Gateway };
            let Some(step) = self.plant.unit_mut(owner).step(now) else { return };
            match (step, owner) {
                (Step::Start, Owner::Governor) => self.start_governor(now),
                (Step::Start, Owner::Gateway) => self.start_gateway(now),
                (Step::MainCycle, Owner::Governor) => self.governor_cycle(now),
                (Step::MainCycle, Owner::Gateway) => self.gateway_cycle(now),
            }
        }
    }

    fn start_governor(&mut self, now: Instant) {
        self.plant.parameters.start(Owner::Governor);
        self.plant.governor.start();
        self.plant.governor.model.start();
        self.plant.events.push(super::Event::Started(Owner::Governor));
        self.update_errors(now);
    }

    fn start_gateway(&mut self, now: Instant) {
        self.plant.start_gateway(now);
        // The node-ID of the parameters takes effect.
        self.node = node(self.plant.parameters.effective());
        self.node.poll(now, &mut self.plant);
        self.update_errors(now);
    }

    fn gateway_cycle(&mut self, now: Instant) {
        let plant = &mut self.plant;
        if plant.is_operational() {
            let period = plant.parameters.effective().heartbeat_monitoring();
            plant.gateway.heartbeat.main_cycle(now, period);
        }
        let is_missed = plant.would_miss(&plant.gateway.unit, now, GATEWAY_LINK, GATEWAY_DELAY);
        plant.gateway.silence.main_cycle(!is_missed);
        self.update_errors(now);
    }

    fn governor_cycle(&mut self, now: Instant) {
        let plant = &mut self.plant;
        plant.governor.cycles = plant.governor.cycles.wrapping_add(1);
        let is_missed = plant.would_miss(&plant.governor.unit, now, GOVERNOR_LINK, GOVERNOR_DELAY);
        plant.governor.silence.main_cycle(!is_missed);
        plant.monitor_rpdos(now);
        let inputs = Inputs { configuration: plant.parameters.effective(), reception: plant.reception() };
        plant.governor.model.main_cycle(&inputs);
        self.initialise(now);
        self.update_errors(now);
        self.send_tpdos(now);
    }

    /// Tells the gateway the data of the TPDOs that are due; it passes them in operational only (3; GW-NMT-14).
    fn send_tpdos(&mut self, now: Instant) {
        let is_operational = self.plant.is_operational();
        let Some(table) = self.plant.gateway.pdos.as_ref().filter(|_| self.plant.hears_governor()) else {
            return;
        };
        let mut due = [0; 16];
        let mut count = 0;
        let errors = self.plant.error_words();
        let parameters = self.plant.parameters.effective();
        let mut objects = self.node.objects();
        for tpdo in table.tpdos.iter().filter(|tpdo| tpdo.activity.is_active()) {
            let governor = &mut self.plant.governor;
            let is_due = match tpdo.period {
                // Cyclic ones in main cycles of the governor (7.1.3; GW-TIMING-02).
                Some(period) => governor.cycles.is_multiple_of(period.cycles.into()),
                // The others when their data change, at most once in a main cycle (GW-TIMING-01).
                None => {
                    let words = binary_words(tpdo, errors, governor.model.engine_status());
                    let sent = governor.sent.get_mut(usize::from(tpdo.number) - 1);
                    is_operational && sent.is_some_and(|sent| sent.replace(words) != Some(words))
                }
            };
            if is_due {
                write_words(&mut objects, tpdo, &governor.model, parameters);
            }
            if let Some(place) = due.get_mut(count).filter(|_| is_due && is_operational) {
                *place = tpdo.number;
                count += 1;
            }
        }
        for number in due.into_iter().take(count) {
            self.node.services(now).trigger(number.into());
        }
    }
}

/// The words of TPDO 1 to 3.
fn binary_words(tpdo: &Pdo, errors: [u16; 6], status: u8) -> [u16; 4] {
    let mut words = [0; 4];
    for (place, word) in words.iter_mut().zip(tpdo.words()) {
        *place = match word.source {
            Source::Errors { first } => errors.get(usize::from(first) / 16).copied().unwrap_or_default(),
            _ => status.into(),
        };
    }
    words
}

/// Puts the governor's values into the entries that a TPDO carries. Errors and status are brought up to date whenever
/// they are read.
fn write_words(objects: &mut Objects<'_>, tpdo: &Pdo, governor: &impl Governor, parameters: &Configuration) {
    for word in tpdo.words() {
        if let Source::Signal { number, .. } = word.source {
            let value = match Parameter::find(Owner::Governor, number) {
                Some(parameter) => internal_value(parameter, parameters),
                None => governor.value(number),
            };
            objects.set_value(word.object.index(), word.object.sub_index().0, value);
        }
    }
}

/// A parameter of the governor itself, in 16 bits: times in s as steps of 10 ms (our choice; 7.1.2.2, GW-PDO-07).
fn internal_value(parameter: Parameter, parameters: &Configuration) -> u16 {
    let value = parameters.get(parameter);
    match parameter.quantity() {
        Quantity::Seconds => (value / 10) as u16,
        _ => value as u16,
    }
}

impl<G: Governor, S: Storage> Plant<G, S> {
    /// The gateway's program starts with what it has stored, as far as its pages are good (9.4; GW-APP-35).
    fn start_gateway(&mut self, now: Instant) {
        let found = self.gateway.eeprom_code.of_program();
        self.gateway.eeprom_errors = found;
        match found.loses_parameters() {
            true => self.parameters.start_with_defaults(Owner::Gateway),
            false => self.parameters.start(Owner::Gateway),
        }
        self.gateway.start(now, self.faults.has(super::Fault::GatewayCanBus2));
        if found.clears_error_memory()
            && self.gateway.errors.clear_counters(&mut self.gateway.storage).is_err()
        {
            self.events.push(super::Event::NotStored);
        }
        self.events.push(super::Event::Started(Owner::Gateway));
        if !found.is_empty() {
            self.events.push(super::Event::EepromErrors(found));
        }
    }

    fn is_set(&self, parameter: Parameter) -> bool {
        self.parameters.effective().get(parameter) != 0
    }

    /// Whether a unit that works hears nothing of the other one, although it is to communicate with it (`link`) and its
    /// delay after the start (`delay`) is over.
    fn would_miss(&self, unit: &ControlUnit, now: Instant, link: Parameter, delay: Parameter) -> bool {
        let delay = self.parameters.effective().get(delay).unsigned_abs();
        let is_monitored = self.is_set(link) && unit.age(now) >= Microseconds::from_milliseconds(delay);
        is_monitored && !self.hears_governor()
    }

    /// Whether the programs of both units run.
    fn both_run(&self) -> bool {
        self.governor.unit.is_on() && self.gateway.unit.is_on()
    }

    /// Whether both units are on the HEINZMANN bus with different bit rates, which disturbs every frame there (7.2.1, 9.4
    /// on 3070; GW-APP-50).
    pub(super) fn bit_rates_clash(&self) -> bool {
        let is_used = self.is_set(GATEWAY_LINK) || self.is_set(GOVERNOR_LINK);
        self.both_run() && is_used && self.parameters.effective().bit_rates_differ()
    }

    /// Whether the gateway gets telegrams of the governor now (7.1.1, 7.2.1; GW-CFG-32 to GW-CFG-34, GW-CFG-46).
    pub(super) fn hears_governor(&self) -> bool {
        self.both_run()
            && !self.faults.iter().any(super::Fault::breaks_link)
            && self.parameters.effective().hindrances().next().is_none()
    }

    /// The monitoring of active RPDOs runs in operational (7.1.5; GW-APP-09).
    fn monitor_rpdos(&mut self, now: Instant) {
        let is_operational = self.is_operational();
        let Some(table) = self.gateway.pdos.as_ref().filter(|_| is_operational) else { return };
        for (monitoring, rpdo) in self.governor.reception.monitoring.iter_mut().zip(&table.rpdos) {
            monitoring.main_cycle(now, rpdo.period.filter(|_| rpdo.activity.is_active()));
        }
    }

    pub(super) fn is_operational(&self) -> bool {
        self.governor.reception.is_operational
    }

    /// What the governor gets from CANopen.
    pub(super) fn inputs(&self) -> Inputs<'_> {
        Inputs { configuration: self.parameters.effective(), reception: self.reception() }
    }

    /// What has come from CANopen, and whether it can be believed.
    fn reception(&self) -> Reception {
        let configuration = self.parameters.effective();
        let mut rpdo = 0;
        Reception {
            is_monitored: [(); 4].map(|()| {
                rpdo += 1;
                configuration.rpdo_monitoring(rpdo).is_some()
            }),
            heartbeat_is_missing: self.gateway.heartbeat.is_triggered(),
            ..self.governor.reception
        }
    }

    /// The 96 errors of governor and gateway, bit k of the whole for 3000 + k (GW-NOTE-05).
    pub(super) fn error_words(&self) -> [u16; 6] {
        let mut errors = self.errors();
        [(); 6].map(|()| {
            let word = errors as u16;
            errors >>= 16;
            word
        })
    }
}
