//! What can be seen of the gateway: by the PC tool, by a terminal, by tests.

use super::super::agreement::GOVERNOR_NUMBER;
use super::super::amount::Amount;
use super::super::check::INITIALISATION_ATTEMPTS;
use super::super::configuration::Configuration;
use super::super::control_unit::ControlUnit;
use super::super::eeprom::EepromErrors;
use super::super::error::{CanOpenError, CanOpenErrors, GatewayError};
use super::super::governor::Governor;
use super::super::inputs::Inputs;
use super::super::measured;
use super::super::parameter::{Owner, Parameter, Quantity};
use super::super::pdo::Pdo;
use super::super::signal::{SignalType, is_of_canopen};
use super::super::standstill::Standstill;
use super::super::state::State;
use super::super::table::PdoTable;
use super::super::traffic::Traffic;
use super::side::Phase;
use super::{Fault, Gateway, Plant};
use edskit_runtime::{Frame, Instant, Storage};
use edskit_types::{Bitrate, NmtState, Party, PdoDirection};

impl<G: Governor, S: Storage> Gateway<G, S> {
    /// The state on CANopen (3).
    #[must_use]
    pub fn state(&self) -> State {
        match (self.plant.gateway.phase, self.node.state()) {
            (Phase::Undefined, _) => State::Undefined,
            (Phase::Init, _) | (Phase::Ready, NmtState::Initialising) => State::Init,
            (Phase::Ready, NmtState::PreOperational) => State::PreOperational,
            (Phase::Ready, NmtState::Operational) => State::Operational,
            (Phase::Ready, NmtState::Stopped) => State::Stopped,
        }
    }

    /// The errors of the gateway that are present, in the order of their numbers.
    pub fn errors(&self) -> impl Iterator<Item = GatewayError> {
        self.plant.gateway.errors.present()
    }

    /// How often an error has occurred since the error memory was cleared, up to 255 (9.1).
    #[must_use]
    pub fn error_count(&self, error: GatewayError) -> u8 {
        self.plant.gateway.errors.count(error)
    }

    /// The errors of CANopen that are present: 2005h.
    #[must_use]
    pub fn can_open_errors(&self) -> CanOpenErrors {
        self.plant.gateway.can_open
    }

    /// The errors of both units, bit k for 3000 + k (9.1; GW-NOTE-05).
    #[must_use]
    pub fn all_errors(&self) -> u128 {
        self.plant.errors()
    }

    /// The PDOs of the present initialisation; `None` before one has succeeded.
    #[must_use]
    pub fn pdos(&self) -> Option<&PdoTable> {
        self.plant.gateway.pdos.as_ref()
    }

    /// What has gone over a PDO.
    #[must_use]
    pub fn traffic(&self, pdo: &Pdo) -> Traffic {
        self.plant.gateway.traffic.get(place(pdo.direction, pdo.number)).copied().unwrap_or_default()
    }

    /// The parameters as the PC tool shows them.
    #[must_use]
    pub fn parameters(&self) -> &Configuration {
        self.plant.parameters.edited()
    }

    /// The parameters that the units work with.
    #[must_use]
    pub fn effective_parameters(&self) -> &Configuration {
        self.plant.parameters.effective()
    }

    /// The bit rate on CANopen that is in effect; `None` with manual bit timing (GW-CFG-37, GW-NOTE-41).
    #[must_use]
    pub fn bit_rate(&self) -> Option<Bitrate> {
        self.plant.parameters.effective().bit_rate()
    }

    /// Whether a unit has its supply.
    #[must_use]
    pub fn is_powered(&self, unit: Owner) -> bool {
        self.plant.unit(unit).is_powered()
    }

    /// Whether the program of a unit runs.
    #[must_use]
    pub fn is_running(&self, unit: Owner) -> bool {
        self.plant.unit(unit).is_on()
    }

    /// Whether the gateway stays in its bootloader, because 3099 has bit 0 (9.4; GW-APP-48).
    #[must_use]
    pub fn stays_in_bootloader(&self) -> bool {
        self.plant.gateway.unit.is_held()
    }

    /// The bad pages that the last start of the gateway has found: 3099 EEPROMErrorCode (9.4; GW-APP-47).
    #[must_use]
    pub fn eeprom_errors(&self) -> EepromErrors {
        self.plant.gateway.eeprom_errors
    }

    /// Why there is no communication on CANopen; `None` where there is.
    #[must_use]
    pub fn standstill(&self) -> Option<Standstill> {
        let plant = &self.plant;
        let (gateway, governor) = (&plant.gateway.unit, &plant.governor.unit);
        if self.state().communicates() {
            return None;
        }
        let unit = match (gateway.is_on(), governor.is_on()) {
            (false, _) if !gateway.is_powered() => Some(Standstill::GatewayOff),
            (false, _) if gateway.is_held() => Some(Standstill::InBootloader),
            (false, _) => Some(Standstill::GatewayStarting),
            (true, false) if !governor.is_powered() => Some(Standstill::GovernorOff),
            (true, false) => Some(Standstill::GovernorStarting),
            (true, true) => None,
        };
        let apart = || plant.parameters.effective().hindrances().next().map(|_| Standstill::Apart);
        let fault = || plant.faults.iter().find(|fault| fault.breaks_link()).map(Standstill::Fault);
        let reason = unit.or_else(apart).or_else(fault).or_else(|| plant.blocking_error());
        Some(reason.unwrap_or(
            match (plant.governor.attempts >= INITIALISATION_ATTEMPTS, plant.governor.refusal) {
                (true, Some(refusal)) => Standstill::Refused(refusal),
                (true, None) => Standstill::Commanded,
                (false, _) => Standstill::Initialising,
            },
        ))
    }

    /// The faults that last.
    pub fn faults(&self) -> impl Iterator<Item = Fault> {
        self.plant.faults.iter()
    }

    /// What the governor gets from CANopen at present.
    #[must_use]
    pub fn inputs(&self) -> Inputs<'_> {
        self.plant.inputs()
    }

    /// The governor's model.
    #[must_use]
    pub fn governor(&self) -> &G {
        &self.plant.governor.model
    }

    /// A measured value of the gateway, as the PC tool shows it (list 2: 11.3; GW-APP-30, GW-APP-38 to GW-APP-42).
    /// `None` for numbers that are no measured value, and for 2406, which the manual lists and does not describe. The model
    /// has no computing time (3865), finds nothing wrong in its tests of the RAM (3895, 3896) and records no exception (3195
    /// to 3198), so that these are 0; the stacks are free as far as they reach (3897, 3898).
    #[must_use]
    pub fn measured(&self, number: u16) -> Option<u32> {
        let gateway = &self.plant.gateway;
        let identification = gateway.identification();
        let flag = |is: bool| Some(u32::from(is));
        if let Some(error) = GatewayError::from_number(number) {
            return flag(gateway.errors.is_present(error));
        }
        if let Some(error) = number.checked_sub(100).and_then(GatewayError::from_number) {
            return Some(gateway.errors.count(error).into());
        }
        if let Some(error) = CanOpenError::ALL.into_iter().find(|error| error.number() == number) {
            return flag(gateway.can_open.contains(error));
        }
        match number {
            // The governor is bit 0 in those that are coded by the type of the device (our choice).
            2401 => flag(gateway.buffer_states[0]),
            2402 => flag(gateway.buffer_states[1]),
            2403 => flag(self.plant.misses(gateway.silence)),
            2404 => flag(self.plant.faults.has(Fault::DuplicateGateway)),
            2405 => flag(self.plant.hears_governor()),
            2410 => Some(self.plant.nodes() >> 16),
            2411 => Some(self.plant.nodes() & 0xFFFF),
            // No PC is a participant of the HEINZMANN bus here.
            2424 | 2425 => Some(0),
            3099 => Some(gateway.eeprom_errors.0.into()),
            3195..=3198 => Some(0),
            3600 => Some(u32::from(gateway.supply) / 1000),
            3840 => Some(identification.hardware_version.into()),
            3841 => Some(identification.additional_hardware_version.into()),
            3842 => Some(identification.software_version.into()),
            3843 => Some(identification.boot_software_version.into()),
            3844 => Some(identification.serial_date.into()),
            3845 => Some(identification.serial_number.into()),
            3850 => Some(gateway.tool.into()),
            3851 => Some(gateway.last_tool.into()),
            3865 | 3895 | 3896 => Some(0),
            3897 | 3898 => Some(if gateway.errors.is_present(GatewayError::Stack) { 0 } else { FREE_STACK }),
            // Milliseconds that begin again at 65.536 s (GW-NOTE-44).
            3870 => Some((gateway.unit.age(self.plant.now).0 / 1000 % 65_536) as u32),
            12400 => State::ALL.iter().position(|state| *state == self.state()).map(|place| place as u32),
            12401..=12404 => flag(self.state().measured_value() == Some(number)),
            12405 => flag(self.state().communicates() && self.plant.hears()),
            12410 => Some(gateway.can_open.0.into()),
            _ => None,
        }
    }
}

/// The most bytes that a stack has free (11.3).
const FREE_STACK: u32 = 0x200;

impl<G: Governor, S: Storage> Gateway<G, S> {
    /// What the PC tool shows under a number: a parameter as it is set, or a measured value (ch. 3, 9.2, 9.5, 11.3;
    /// GW-APP-51). `None` where the unit does not have it, or nothing is known of it.
    ///
    /// Of the governor these are its parameters, its errors from 3000 on, the state of CANopen with its errors, and what
    /// [`Signals`](super::super::Signals) knows.
    #[must_use]
    pub fn shown(&self, unit: Owner, number: u16) -> Option<Amount> {
        if let Some(parameter) = Parameter::find(unit, number) {
            return Some(parameter.amount(self.parameters().get(parameter)));
        }
        match unit {
            Owner::Gateway => {
                let quantity = measured::quantity(number);
                let value = match quantity {
                    Quantity::Volts => Some(u32::from(self.plant.gateway.supply)),
                    _ => self.measured(number),
                };
                Some(Amount::new(i32::try_from(value?).ok()?, quantity))
            }
            Owner::Governor => {
                self.shown_by_governor(number).map(|value| Amount::new(value, Quantity::Number))
            }
        }
    }

    fn shown_by_governor(&self, number: u16) -> Option<i32> {
        // Both units show the state and the errors of CANopen (ch. 3, 9.5).
        if is_of_canopen(number) || number == GatewayError::CanOpen.number() {
            return self.measured(number).and_then(|value| i32::try_from(value).ok());
        }
        let signal_type = self.governor().signal_type(number)?;
        let value = || self.governor().value(number);
        Some(match (number, signal_type) {
            (3000..=3095, SignalType::Bit) => {
                let errors =
                    self.plant.inputs().errors() | self.governor().errors() | self.plant.governor_errors();
                i32::from(errors >> (number - 3000) & 1 == 1)
            }
            (_, SignalType::I8 | SignalType::I16) => i32::from(value() as i16),
            _ => i32::from(value()),
        })
    }
}

impl<G: Governor, S: Storage> Plant<G, S> {
    pub(super) fn unit(&self, owner: Owner) -> &ControlUnit {
        match owner {
            Owner::Gateway => &self.gateway.unit,
            Owner::Governor => &self.governor.unit,
        }
    }

    pub(super) fn unit_mut(&mut self, owner: Owner) -> &mut ControlUnit {
        match owner {
            Owner::Gateway => &mut self.gateway.unit,
            Owner::Governor => &mut self.governor.unit,
        }
    }

    /// The governors on the HEINZMANN bus that are heard, bit by node number (7.2.1; GW-APP-40).
    fn nodes(&self) -> u32 {
        let number = self.parameters.effective().get(GOVERNOR_NUMBER);
        if self.hears_governor() { 1_u32.checked_shl(number.unsigned_abs()).unwrap_or(0) } else { 0 }
    }

    /// A frame that may be the heartbeat of the partner (6, 7.2.3; GW-HB-04, GW-HB-07).
    pub(super) fn partner_heard(&mut self, frame: &Frame) {
        let configuration = self.parameters.effective();
        let partner = configuration.partner_node_id();
        let can_id = Party::HeartbeatOf(partner).predefined_can_id(configuration.node_id());
        let is_from_partner = partner > 0 && can_id == Some(frame.can_id());
        if let (true, &[code]) = (is_from_partner, frame.data())
            && NmtState::from_code(code).is_some()
        {
            self.gateway.heartbeat.arrived(self.now);
        }
    }

    /// The RPDO that a frame was, if it was one.
    pub(super) fn record_rpdo(&mut self, now: Instant, frame: &Frame) {
        let Some(number) = self.gateway.rpdo.take() else { return };
        if let Some(traffic) = self.gateway.traffic.get_mut(place(PdoDirection::Receive, number as u8)) {
            traffic.record(now, frame);
        }
    }

    /// The TPDO that a frame is, if it is one.
    pub(super) fn record_tpdo(&mut self, frame: &Frame) {
        let Some(table) = &self.gateway.pdos else { return };
        let is_it = |tpdo: &&Pdo| tpdo.activity.is_active() && tpdo.can_id == frame.can_id();
        let Some(tpdo) = table.tpdos.iter().find(is_it) else { return };
        let place = place(tpdo.direction, tpdo.number);
        if let Some(traffic) = self.gateway.traffic.get_mut(place) {
            traffic.record(self.now, frame);
        }
    }
}

/// The place of a PDO in the records: RPDO 1 to 4, then TPDO 1 to 16.
fn place(direction: PdoDirection, number: u8) -> usize {
    let nth = usize::from(number).wrapping_sub(1);
    match direction {
        PdoDirection::Receive => nth,
        PdoDirection::Transmit => nth.wrapping_add(4),
    }
}
