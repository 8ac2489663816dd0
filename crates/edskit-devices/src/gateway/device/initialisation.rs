//! The initialisation of the gateway by the governor (3, 7.3, 9.5).

use super::super::check::{INITIALISATION_ATTEMPTS, RULES};
use super::super::error::CanOpenError;
use super::super::event::{Event, Refusal};
use super::super::governor::Governor;
use super::super::state::{Commander, State};
use super::super::table::PdoTable;
use super::super::telegram::{Telegram, assemble};
use super::side::Phase;
use super::{Fault, Gateway, Plant};
use edskit_runtime::{Instant, Storage};
use edskit_types::{NmtState, conflicts};

impl<G: Governor, S: Storage> Gateway<G, S> {
    /// The governor commands a state; false where the gateway does not follow (3; GW-NMT-03, GW-NMT-09, GW-NMT-11,
    /// GW-NMT-12). Undefined lasts until the governor commands init or its errors are cleared. The way from init to
    /// pre-operational is the governor's own business once the initialisation has succeeded.
    pub fn command(&mut self, now: Instant, to: State) -> bool {
        let from = self.state();
        if !self.plant.hears_governor() || !from.follows(Commander::Governor, to) || self.plant.is_blocked() {
            return false;
        }
        match to {
            State::Undefined => {
                self.plant.governor.attempts = INITIALISATION_ATTEMPTS;
                self.plant.governor.refusal = None;
                self.lead(now, Phase::Undefined);
            }
            State::Init => {
                self.plant.governor.attempts = 0;
                self.lead(now, Phase::Init);
            }
            _ if from == State::Init => return false,
            _ => self.node.enter(now, NmtState::PreOperational, &mut self.plant),
        }
        true
    }

    /// What the governor does about the initialisation in one main cycle: it sends its telegrams in one, and the command
    /// to go to pre-operational in the next.
    pub(super) fn initialise(&mut self, now: Instant) {
        if !self.plant.hears_governor() || self.plant.is_blocked() {
            return;
        }
        if self.plant.meet() && self.plant.gateway.phase == Phase::Ready {
            self.lead(now, Phase::Init);
        }
        let plant = &mut self.plant;
        match plant.gateway.phase {
            Phase::Undefined if plant.governor.attempts < INITIALISATION_ATTEMPTS => {
                plant.enter_phase(Phase::Init);
                plant.exchange();
            }
            Phase::Init => match plant.governor.accepted.take() {
                Some(table) => plant.make_ready(table),
                None => plant.exchange(),
            },
            Phase::Undefined | Phase::Ready => {}
        }
    }
}

impl<G: Governor, S: Storage> Plant<G, S> {
    /// The units hear each other for the first time since one of them has started; whether that is so. Who of them was
    /// reset while the other was not, is told as an error (9.5; GW-APP-18, GW-APP-23).
    fn meet(&mut self) -> bool {
        let fresh = (self.governor.unit.is_fresh, self.gateway.unit.is_fresh);
        (self.governor.unit.is_fresh, self.gateway.unit.is_fresh) = (false, false);
        match fresh {
            (false, false) => return false,
            (true, false) => self.set_can_open(CanOpenError::GovernorReset, true),
            (false, true) => self.set_can_open(CanOpenError::GatewayReset, true),
            (true, true) => {}
        }
        self.governor.attempts = 0;
        self.governor.accepted = None;
        true
    }

    /// The governor sends its telegrams, and the gateway checks them and what follows from them (7.3; GW-CFG-17).
    fn exchange(&mut self) {
        match self.check() {
            Ok(table) => self.governor.accepted = Some(table),
            Err(reason) => {
                self.governor.attempts += 1;
                self.governor.refusal = Some(reason);
                let attempt = self.governor.attempts;
                self.events.push(Event::InitialisationFailed { attempt, reason });
                self.set_can_open(CanOpenError::Init, true);
                self.enter_phase(Phase::Undefined);
            }
        }
    }

    fn check(&self) -> Result<PdoTable, Refusal> {
        let configuration = self.parameters.effective();
        let told = PdoTable::new(configuration, &self.governor.model);
        let lacks_end = self.faults.has(Fault::InitTelegrams);
        let telegrams = told.telegrams().filter(|telegram| !(lacks_end && *telegram == Telegram::End));
        let table = assemble(telegrams, configuration).map_err(Refusal::Structure)?;
        match conflicts(table.claims().as_mut_slice(), &RULES).next() {
            Some(conflict) => Err(Refusal::Conflict(conflict)),
            None => Ok(table),
        }
    }

    /// The gateway goes to pre-operational: its node boots up with the next call.
    fn make_ready(&mut self, table: PdoTable) {
        self.governor.attempts = 0;
        self.gateway.pdos = Some(table);
        // Nothing has been sent since this initialisation (GW-GAP-10, GW-NOTE-46).
        self.governor.sent = [None; 3];
        self.gateway.traffic = Default::default();
        self.enter_phase(Phase::Ready);
    }

    /// Goes on the way to communication, or back; the node of the gateway follows.
    pub(super) fn enter_phase(&mut self, phase: Phase) {
        if self.gateway.phase == phase {
            return;
        }
        self.gateway.phase = phase;
        match phase {
            Phase::Undefined => self.events.push(Event::State(State::Undefined)),
            Phase::Init => self.events.push(Event::State(State::Init)),
            // The node tells that it is pre-operational.
            Phase::Ready => return,
        }
        self.gateway.pdos = None;
        self.governor.accepted = None;
    }
}
