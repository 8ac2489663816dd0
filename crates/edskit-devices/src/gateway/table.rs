//! The PDOs that follow from a configuration.

use super::configuration::Configuration;
use super::object::{
    ANALOG_INPUTS, DIGITAL_INPUTS, DIGITAL_OUTPUTS, SIGNED_ANALOG_OUTPUTS, UNSIGNED_ANALOG_OUTPUTS,
};
use super::parameter::Parameter;
use super::pdo::{Activity, Pdo, Source, Word};
use super::period::Period;
use super::signal::{SignalType, Signals};
use edskit_types::{CanId, NodeId, Party, PdoDirection};

/// The 4 RPDOs and 16 TPDOs of the gateway, as its initialisation finds them (2, 4; GW-EDS-03).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PdoTable {
    /// RPDO 1 to 4.
    pub rpdos: [Pdo; 4],
    /// TPDO 1 to 16.
    pub tpdos: [Pdo; 16],
    /// The node-ID of the gateway.
    pub node_id: NodeId,
    /// The node-ID of the partner, 0 where there is none.
    pub partner_node_id: u8,
}

impl PdoTable {
    /// Works out every PDO: whether it is active (7.3; GW-CFG-01 to GW-CFG-10), its identifier (7.2.4; GW-CFG-12,
    /// GW-CFG-13), its content (4; GW-PDO-01 to GW-PDO-18) and its times (7.1.3, 7.1.5; GW-TIMING-01 to GW-TIMING-11).
    #[must_use]
    pub fn new(configuration: &Configuration, signals: &impl Signals) -> Self {
        let mut outputs = AnalogOutputs::default();
        let mut tpdo = 0;
        let tpdos = [(); 16].map(|()| {
            tpdo += 1;
            match tpdo {
                1..=3 => binary_tpdo(configuration, tpdo),
                _ => analogue_tpdo(configuration, tpdo, signals, &mut outputs),
            }
        });
        let rpdos = [
            switch_rpdo(configuration),
            sensor_rpdo(configuration, 2),
            sensor_rpdo(configuration, 3),
            sensor_rpdo(configuration, 4),
        ];
        Self {
            rpdos,
            tpdos,
            node_id: configuration.node_id(),
            partner_node_id: configuration.partner_node_id(),
        }
    }

    /// The table before an initialisation: no PDO carries anything.
    pub(super) fn inactive(configuration: &Configuration) -> Self {
        let mut numbers = (0, 0);
        let mut next = |direction, activity| {
            let number = match direction {
                PdoDirection::Receive => &mut numbers.0,
                PdoDirection::Transmit => &mut numbers.1,
            };
            *number += 1;
            empty(configuration, direction, *number, activity, None)
        };
        Self {
            rpdos: [(); 4].map(|()| next(PdoDirection::Receive, Activity::NoInputs)),
            tpdos: [(); 16].map(|()| next(PdoDirection::Transmit, Activity::NotSelected)),
            node_id: configuration.node_id(),
            partner_node_id: configuration.partner_node_id(),
        }
    }

    /// RPDO 1 to 4, then TPDO 1 to 16.
    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Pdo> {
        self.rpdos.iter_mut().chain(&mut self.tpdos)
    }

    /// RPDO 1 to 4, then TPDO 1 to 16.
    pub fn iter(&self) -> impl Iterator<Item = &Pdo> {
        self.rpdos.iter().chain(&self.tpdos)
    }

    /// The PDO that a party of a conflict is.
    #[must_use]
    pub fn find(&self, party: Party) -> Option<&Pdo> {
        self.iter().find(|pdo| pdo.party() == party)
    }
}

/// A PDO without content.
fn empty(
    configuration: &Configuration,
    direction: PdoDirection,
    number: u8,
    activity: Activity,
    period: Option<Period>,
) -> Pdo {
    let (node_id, can_id) = (configuration.node_id(), identifier(configuration, direction, number));
    Pdo { node_id, direction, number, can_id, activity, period, words: [Word::DUMMY; 4], length: 0 }
}

/// The identifier of a PDO, active or not: predefined, or P16404 to P16415 for TPDO 5 to 16 (7.2.4; GW-CFG-12,
/// GW-CFG-13).
pub(super) fn identifier(configuration: &Configuration, direction: PdoDirection, number: u8) -> CanId {
    let own = match direction {
        PdoDirection::Transmit => Parameter::tpdo_identifier(number),
        PdoDirection::Receive => None,
    };
    let party = Party::Pdo { direction, number: u16::from(number) };
    let can_id = match own {
        // The range of P16404 to P16415 is that of 11-bit identifiers.
        Some(parameter) => CanId::standard(configuration.get(parameter) as u16),
        None => party.predefined_can_id(configuration.node_id()),
    };
    can_id.unwrap_or(CanId::NMT)
}

/// TPDO 1 to 3: errors and engine status (4.1.1; GW-PDO-01 to GW-PDO-03, GW-CFG-01).
fn binary_tpdo(configuration: &Configuration, number: u8) -> Pdo {
    let (parameter, subs) = match number {
        1 => (Parameter::SEND_ERRORS, 1..=4),
        2 => (Parameter::SEND_ERRORS, 5..=6),
        _ => (Parameter::SEND_STATUS, 7..=7),
    };
    let selected = configuration.get(parameter) != 0;
    let activity = if selected { Activity::Selected } else { Activity::NotSelected };
    let mut pdo = empty(configuration, PdoDirection::Transmit, number, activity, None);
    for sub_index in subs.filter(|_| selected) {
        let source = match sub_index {
            7 => Source::EngineStatus,
            _ => Source::Errors { first: (sub_index - 1) * 16 },
        };
        pdo.push(Word::new(source, DIGITAL_OUTPUTS, sub_index));
    }
    pdo
}

/// How many entries of 2001h and 2002h are in use. They are numbered as they come, by TPDO and word, separately
/// (GW-NOTE-03).
#[derive(Default)]
struct AnalogOutputs {
    unsigned: u8,
    signed: u8,
}

impl AnalogOutputs {
    fn next(&mut self, source: Source, is_signed: bool) -> Word {
        let (index, count) = match is_signed {
            true => (SIGNED_ANALOG_OUTPUTS, &mut self.signed),
            false => (UNSIGNED_ANALOG_OUTPUTS, &mut self.unsigned),
        };
        // At most 52, the words of 13 TPDOs.
        *count += 1;
        Word::new(source, index, *count)
    }
}

/// TPDO 4 to 16: up to four parameters of the governor (4.1.2, 7.1.2.2; GW-PDO-04 to GW-PDO-12, GW-CFG-03).
fn analogue_tpdo(
    configuration: &Configuration,
    number: u8,
    signals: &impl Signals,
    outputs: &mut AnalogOutputs,
) -> Pdo {
    let period = configuration.tpdo_cycle(number);
    let assignments = || (0..4).filter_map(|word| valid_assignment(configuration, number, word, signals));
    let activity = match (assignments().next().is_some(), period.is_some()) {
        (true, true) => Activity::DataAndCycle,
        (true, false) => Activity::NoCycle,
        (false, true) => Activity::NoData,
        (false, false) => Activity::NeitherDataNorCycle,
    };
    let mut pdo = empty(configuration, PdoDirection::Transmit, number, activity, period);
    if activity.is_active() {
        // There is no dummy in a TPDO: what is invalid is left out, and the rest moves up (GW-PDO-08).
        for (assignment, number, signal_type) in assignments() {
            let signed = signal_type.is_signed();
            pdo.push(outputs.next(Source::Signal { assignment, number, signed }, signed));
        }
    }
    pdo
}

/// The parameter that word `word` (0 to 3) of a TPDO is to carry, if it exists and is analogue.
fn valid_assignment(
    configuration: &Configuration,
    tpdo: u8,
    word: u8,
    signals: &impl Signals,
) -> Option<(Parameter, u16, SignalType)> {
    let assignment = Parameter::tpdo_assignment(tpdo, word)?;
    let number = configuration.get(assignment) as u16;
    let signal_type = if number == 0 { None } else { signals.signal_type(number) }?;
    signal_type.is_analogue().then_some((assignment, number, signal_type))
}

/// RPDO 1: switch functions, and the error flags of the sensors (4.2.1; GW-PDO-14, GW-PDO-17, GW-CFG-09).
fn switch_rpdo(configuration: &Configuration) -> Pdo {
    let switch_functions = configuration.switch_functions().any(|input| input.target.is_assigned());
    let sensors = configuration.sensors().any(|input| input.target.is_assigned());
    let activity = match (switch_functions, sensors) {
        (true, true) => Activity::SwitchFunctionsAndSensorFlags,
        (true, false) => Activity::SwitchFunctions,
        (false, true) => Activity::SensorFlags,
        (false, false) => Activity::NoInputs,
    };
    let mut pdo = empty(configuration, PdoDirection::Receive, 1, activity, configuration.rpdo_monitoring(1));
    if activity.is_active() {
        pdo.push(Word::new(Source::SwitchFunctions, DIGITAL_INPUTS, 1));
    }
    if sensors {
        pdo.push(Word::DUMMY);
        pdo.push(Word::new(Source::SensorFlags, DIGITAL_INPUTS, 2));
    }
    pdo
}

/// RPDO 2 to 4: sensors, at the places that their channels say (4.2.2, 7.1.4.2; GW-PDO-15 to GW-PDO-18, GW-CFG-10).
///
/// The sub-index of a sensor in 2004h is its channel (GW-NOTE-13).
fn sensor_rpdo(configuration: &Configuration, number: u8) -> Pdo {
    let first = 4 * (number - 2) + 1;
    let is_used = |channel| configuration.sensors().any(|input| input.target.channel() == Some(channel));
    let last_used = (first..first + 4).rev().find(|&channel| is_used(channel));
    let activity = if last_used.is_some() { Activity::Sensors } else { Activity::NoSensors };
    let period = configuration.rpdo_monitoring(number);
    let mut pdo = empty(configuration, PdoDirection::Receive, number, activity, period);
    for channel in first..=last_used.unwrap_or(0) {
        pdo.push(match is_used(channel) {
            true => Word::new(Source::Sensor { channel }, ANALOG_INPUTS, channel),
            false => Word::DUMMY,
        });
    }
    pdo
}
