//! Errors: when they are present, and what the gateway does about them (9.4, 9.5).

use super::super::error::{CanOpenError, GatewayError};
use super::super::event::Event;
use super::super::governor::Governor;
use super::super::standstill::Standstill;
use super::super::state::{Commander, State};
use super::side::{Phase, Silence};
use super::{Fault, Gateway, Plant};
use edskit_runtime::{Frame, Instant, Storage};
use edskit_types::{NmtState, Party};

/// The supply below which 3085 ErrVoltage is told, in mV (9.4; GW-APP-34).
const LEAST_SUPPLY: u16 = 7_500;

/// The bits of 2005h that are errors of a unit's CAN controllers, with those of the gateway.
const MIRRORED: [(GatewayError, CanOpenError); 4] = [
    (GatewayError::CanBus1, CanOpenError::GatewayCanBus1),
    (GatewayError::CanComm1, CanOpenError::GatewayCanComm1),
    (GatewayError::CanBus2, CanOpenError::GatewayCanBus2),
    (GatewayError::CanComm2, CanOpenError::GatewayCanComm2),
];

impl<G: Governor, S: Storage> Gateway<G, S> {
    /// A fault has just come.
    pub(super) fn react_to(&mut self, now: Instant, fault: Fault) {
        if !self.plant.gateway.unit.is_on() {
            return;
        }
        match fault {
            Fault::CanOpenBuffer1 => self.receive_overflow(now, GatewayError::CanComm1),
            Fault::ReceiveBuffer2 => self.receive_overflow(now, GatewayError::CanComm2),
            Fault::TransmitBuffer2 => self.transmit_overflow(now),
            Fault::GatewayCanBus2 => self.lose_bus(now),
            Fault::GatewayTransmitBuffer1 => self.plant.gateway.buffer_states[0] = true,
            Fault::GatewayReceiveBuffer1 => self.plant.gateway.buffer_states[1] = true,
            _ => {}
        }
        self.update_errors(now);
    }

    /// One of the two receive buffers of CANopen has overflown, that of the HEINZMANN side or that of the CANopen side:
    /// communication ends, and the governor initialises anew (7.2.1, 9.5 on 12422 and 12424; GW-APP-28, GW-APP-49,
    /// GW-NOTE-29, GW-NOTE-34).
    fn receive_overflow(&mut self, now: Instant, error: GatewayError) {
        self.plant.set_error(error, true);
        self.lead(now, Phase::Undefined);
    }

    /// The transmit buffer for SDO has overflown: it is emptied, and the gateway waits for the master (9.5 on 12424;
    /// GW-APP-29, GW-NMT-10).
    fn transmit_overflow(&mut self, now: Instant) {
        self.plant.set_error(GatewayError::CanComm2, true);
        while self.node.transmit().is_some() {}
        if self.state().follows(Commander::Gateway, State::Stopped) {
            self.node.enter(now, NmtState::Stopped, &mut self.plant);
        }
    }

    /// The CANopen bus is faulty: no PDOs, and a try every half second (9.5 on 12423; GW-APP-27, GW-APP-32).
    fn lose_bus(&mut self, now: Instant) {
        if self.state().follows(Commander::Gateway, State::PreOperational) {
            self.node.enter(now, NmtState::PreOperational, &mut self.plant);
        }
        self.plant.gateway.lose_bus(now);
    }

    /// Tries the faulty bus where it is time to. Once the gateway is initialised, it sends the boot-up message then, or a
    /// heartbeat where heartbeats are sent (9.5 on 12423; GW-APP-27, GW-NOTE-33).
    pub(super) fn try_bus(&mut self, now: Instant) {
        let is_faulty = self.plant.faults.has(Fault::GatewayCanBus2);
        let is_tried = self.plant.gateway.unit.is_on() && self.plant.gateway.try_bus(now, is_faulty);
        if !is_tried {
            return;
        }
        // Its controller begins anew, so that nothing of what waits is sent.
        while self.node.transmit().is_some() {}
        if !self.state().communicates() {
            return;
        }
        let configuration = self.plant.parameters.effective();
        let state = match configuration.heartbeat() {
            Some(_) => self.node.state(),
            None => NmtState::Initialising,
        };
        let can_id = Party::Heartbeat.predefined_can_id(configuration.node_id());
        self.plant.gateway.attempt_frame = can_id.map(|can_id| Frame::new(can_id, &[state.code()]));
    }

    /// What the node has found out during a call.
    pub(super) fn follow_up(&mut self, now: Instant) {
        if core::mem::take(&mut self.plant.gateway.has_overflown) {
            self.react_to(now, Fault::TransmitBuffer2);
        }
    }

    /// Every error is present or not as its cause says, and what must end communication ends it (9.4; GW-APP-31).
    pub(super) fn update_errors(&mut self, now: Instant) {
        if !self.plant.gateway.unit.is_on() {
            return;
        }
        self.plant.update_errors();
        if self.plant.is_blocked() && self.plant.gateway.phase != Phase::Undefined {
            self.lead(now, Phase::Undefined);
        }
    }
}

impl<G: Governor, S: Storage> Plant<G, S> {
    fn update_errors(&mut self) {
        let is_operational = self.governor.reception.is_operational;
        for error in GatewayError::ALL {
            if self.causes(error) {
                self.set_error(error, true);
            }
        }
        if !self.causes(GatewayError::Voltage) {
            self.set_error(GatewayError::Voltage, false);
        }
        self.governor.can_bus_error |= self.governor_causes(CanOpenError::GovernorCanBus);
        self.governor.can_comm_error |= self.governor_causes(CanOpenError::GovernorCanComm);
        if self.governor.can_bus_error {
            self.set_can_open(CanOpenError::GovernorCanBus, true);
        }
        if self.governor.can_comm_error {
            self.set_can_open(CanOpenError::GovernorCanComm, true);
        }
        let mut monitoring = self.governor.reception.monitoring.iter();
        let is_late = is_operational && monitoring.any(|monitoring| monitoring.is_triggered());
        self.set_can_open(CanOpenError::TimeControl, is_late);
        self.set_can_open(CanOpenError::Heartbeat, is_operational && self.gateway.heartbeat.is_triggered());
    }

    /// Whether the cause of an error is present now.
    fn causes(&self, error: GatewayError) -> bool {
        match error {
            GatewayError::CanBus1 if self.bit_rates_clash() => true,
            GatewayError::CanComm1 if self.misses(self.gateway.silence) => true,
            GatewayError::Voltage => self.gateway.supply < LEAST_SUPPLY,
            _ => self.faults.iter().any(|fault| fault.gateway_error() == Some(error)),
        }
    }

    /// Whether the cause of an error of the governor's CAN side is present now.
    fn governor_causes(&self, error: CanOpenError) -> bool {
        let is_on = self.governor.unit.is_on();
        is_on
            && match error {
                CanOpenError::GovernorCanBus => {
                    self.faults.has(Fault::GovernorCanBus) || self.bit_rates_clash()
                }
                _ => self.faults.has(Fault::GovernorCanComm) || self.misses(self.governor.silence),
            }
    }

    /// Whether a unit has missed the other one for too long, and still does.
    pub(super) fn misses(&self, silence: Silence) -> bool {
        silence.is_too_long() && !self.hears_governor()
    }

    /// Whether communication on CANopen is impossible: the cause of a fault between the units is present, or an error of
    /// the gateway itself has not been cleared (9.4, 9.5; GW-APP-21, GW-APP-22, GW-APP-25, GW-APP-26, GW-APP-31).
    pub(super) fn is_blocked(&self) -> bool {
        self.blocking_error().is_some()
    }

    /// The error that makes communication on CANopen impossible.
    pub(super) fn blocking_error(&self) -> Option<Standstill> {
        let causes = |error: &GatewayError| match error {
            GatewayError::CanBus1 | GatewayError::CanComm1 => self.causes(*error),
            _ => error.leads_to_undefined() && self.gateway.errors.is_present(*error),
        };
        let of_governor = [CanOpenError::GovernorCanBus, CanOpenError::GovernorCanComm];
        let of_governor = || of_governor.into_iter().find(|error| self.governor_causes(*error));
        let own = GatewayError::ALL.into_iter().find(causes).map(Standstill::Error);
        own.or_else(|| of_governor().map(Standstill::GovernorError))
    }

    /// Clears what has no cause any more, on command or because operational is entered (9.2, 9.5; GW-APP-17, GW-APP-36).
    pub(super) fn clear_errors(&mut self) {
        for error in GatewayError::ALL {
            if error != GatewayError::CanOpen && !self.causes(error) {
                self.set_error(error, false);
            }
        }
        self.governor.can_bus_error &= self.governor_causes(CanOpenError::GovernorCanBus);
        self.governor.can_comm_error &= self.governor_causes(CanOpenError::GovernorCanComm);
        self.set_can_open(CanOpenError::GovernorCanBus, self.governor.can_bus_error);
        self.set_can_open(CanOpenError::GovernorCanComm, self.governor.can_comm_error);
        for error in [CanOpenError::GovernorReset, CanOpenError::GatewayReset, CanOpenError::Init] {
            self.set_can_open(error, false);
        }
        self.gateway.buffer_states =
            [Fault::GatewayTransmitBuffer1, Fault::GatewayReceiveBuffer1].map(|fault| self.faults.has(fault));
    }

    pub(super) fn set_error(&mut self, error: GatewayError, is_present: bool) {
        match self.gateway.errors.set(error, is_present, &mut self.gateway.storage) {
            Ok(true) => self.events.push(Event::Error(error, is_present)),
            Ok(false) => {}
            Err(_) => {
                self.events.push(Event::Error(error, is_present));
                self.events.push(Event::NotStored);
            }
        }
        if let Some((_, mirror)) = MIRRORED.into_iter().find(|(own, _)| *own == error) {
            self.set_can_open(mirror, is_present);
        }
    }

    /// Any bit of 2005h is error 3074 as well (5.1.6; GW-APP-16).
    pub(super) fn set_can_open(&mut self, error: CanOpenError, is_present: bool) {
        if self.gateway.can_open.set(error, is_present) {
            self.events.push(Event::CanOpenError(error, is_present));
            let has_any = !self.gateway.can_open.is_empty();
            self.set_error(GatewayError::CanOpen, has_any);
        }
    }

    /// The errors of both units, bit k for 3000 + k (9.1; GW-NOTE-05).
    pub(super) fn errors(&self) -> u128 {
        let gateway = self.gateway.errors.present().map(GatewayError::number);
        let own = gateway.fold(0, |errors, number| errors | 1 << (number - 3000));
        own | self.governor_errors() | self.inputs().errors() | self.governor.model.errors()
    }

    /// The errors of the governor's own CAN side, 3070 and 3071, in the same way.
    pub(super) fn governor_errors(&self) -> u128 {
        u128::from(self.governor.can_bus_error) << 70 | u128::from(self.governor.can_comm_error) << 71
    }

    /// When the faulty bus is tried next; never where it is in order.
    pub(super) fn next_attempt(&self) -> Instant {
        self.gateway.attempt.filter(|_| self.gateway.unit.is_on()).unwrap_or(Instant::NEVER)
    }

    /// Whether frames pass between the gateway and CANopen. A bus that is mended is used after the next attempt (GW-APP-46).
    pub(super) fn hears(&self) -> bool {
        self.gateway.unit.is_on() && self.gateway.attempt.is_none()
    }
}
