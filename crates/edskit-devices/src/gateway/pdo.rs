//! One PDO: whether it is active and why, and what it carries.

use super::parameter::Parameter;
use super::period::Period;
use edskit_types::{CanId, CobId, Index, MappingEntry, NodeId, Party, PdoDirection};

/// A PDO of the gateway.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pdo {
    pub(super) node_id: NodeId,
    /// Whether the gateway sends it.
    pub direction: PdoDirection,
    /// 1 to 4 for RPDOs, 1 to 16 for TPDOs (GW-EDS-03).
    pub number: u8,
    /// The identifier, also of an inactive PDO (7.2.4; GW-CFG-12, GW-CFG-13).
    pub can_id: CanId,
    /// Whether the PDO is active, and why.
    pub activity: Activity,
    /// Of TPDO 4 to 16 how often they are sent, of RPDOs within which time they must come. `None` if that is switched
    /// off, and for TPDO 1 to 3, which are sent when their data change (7.1.3; GW-TIMING-01).
    pub period: Option<Period>,
    pub(super) words: [Word; 4],
    pub(super) length: u8,
}

/// Whether a PDO is active, and why (7.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Activity {
    /// TPDO 1 to 3: P14401 or P14402 is 1 (GW-CFG-01).
    Selected,
    /// TPDO 1 to 3: P14401 or P14402 is 0.
    NotSelected,
    /// TPDO 4 to 16: at least one assignment is valid and the cycle time is not 0 (GW-CFG-03).
    DataAndCycle,
    /// TPDO 4 to 16: the cycle time is 0.
    NoCycle,
    /// TPDO 4 to 16: no assignment is valid.
    NoData,
    /// TPDO 4 to 16: neither is there.
    NeitherDataNorCycle,
    /// RPDO 1: there are CANopen switch functions (GW-CFG-09).
    SwitchFunctions,
    /// RPDO 1: it carries the error flags of the sensors in RPDO 2 to 4 (GW-CFG-09, GW-APP-07).
    SensorFlags,
    /// RPDO 1: both.
    SwitchFunctionsAndSensorFlags,
    /// RPDO 1: there are neither CANopen switch functions nor CANopen sensors.
    NoInputs,
    /// RPDO 2 to 4: there is at least one CANopen sensor in it (GW-CFG-10).
    Sensors,
    /// RPDO 2 to 4: there is none.
    NoSensors,
}

impl Activity {
    /// Whether the PDO is active.
    #[must_use]
    pub const fn is_active(self) -> bool {
        match self {
            Self::Selected
            | Self::DataAndCycle
            | Self::SwitchFunctions
            | Self::SensorFlags
            | Self::SwitchFunctionsAndSensorFlags
            | Self::Sensors => true,
            Self::NotSelected
            | Self::NoCycle
            | Self::NoData
            | Self::NeitherDataNorCycle
            | Self::NoInputs
            | Self::NoSensors => false,
        }
    }
}

/// 16 bits of a PDO.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Word {
    /// What they are.
    pub source: Source,
    /// The entry of the PDO mapping.
    pub object: MappingEntry,
}

/// What a word of a PDO is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Nothing; the place is kept (GW-PDO-14, GW-PDO-18).
    Dummy,
    /// 16 of the 96 errors of governor and gateway (GW-PDO-02).
    Errors {
        /// The number of the first one, a multiple of 16.
        first: u8,
    },
    /// The engine status (GW-PDO-02).
    EngineStatus,
    /// A parameter of the governor, in its internal range of values (GW-PDO-04, GW-PDO-07).
    Signal {
        /// The parameter that chooses it.
        assignment: Parameter,
        /// The number of the parameter that is sent.
        number: u16,
        /// Whether it has a sign.
        signed: bool,
    },
    /// The CANopen switch functions, one for each bit (GW-PDO-14).
    SwitchFunctions,
    /// One error flag for each CANopen sensor; bit 0 is that of channel 1 (GW-PDO-14, GW-NOTE-11).
    SensorFlags,
    /// A CANopen sensor (GW-PDO-15).
    Sensor {
        /// Its channel, 1 to 12 (GW-PDO-16).
        channel: u8,
    },
}

impl Word {
    /// A gap: 16 bits of the data type UNSIGNED16 (GW-PDO-17, GW-EDS-08).
    pub(super) const DUMMY: Word = Word { source: Source::Dummy, object: MappingEntry(0x0006_0010) };

    pub(super) const fn new(source: Source, index: Index, sub_index: u8) -> Word {
        Word { source, object: MappingEntry((index.0 as u32) << 16 | (sub_index as u32) << 8 | 16) }
    }
}

impl Pdo {
    /// The node-ID of the gateway.
    #[must_use]
    pub const fn node_id(&self) -> NodeId {
        self.node_id
    }

    /// What it carries, word by word; nothing if it is inactive.
    #[must_use]
    pub fn words(&self) -> &[Word] {
        self.words.get(..usize::from(self.length)).unwrap_or_default()
    }

    /// The length of the frame in bytes, 0 if the PDO is inactive (GW-PDO-03, GW-PDO-08).
    #[must_use]
    pub const fn bytes(&self) -> u8 {
        2 * self.length
    }

    /// Adds a word; a fifth one is dropped, as a frame holds four.
    pub(super) fn push(&mut self, word: Word) {
        if let Some(place) = self.words.get_mut(usize::from(self.length)) {
            *place = word;
            self.length += 1;
        }
    }

    /// Who it is in the check of identifiers.
    #[must_use]
    pub const fn party(&self) -> Party {
        Party::Pdo { direction: self.direction, number: self.number as u16 }
    }

    /// The value of its communication parameter, sub-index 01h, with bit 31 set if it is inactive.
    ///
    /// An inactive TPDO 5 to 16 shows the node-ID with bit 31, as in the data sheet, whatever P16404 to P16415 say
    /// (chapter 10; GW-OD-08, GW-OD-11, GW-NOTE-18, GW-GAP-08).
    #[must_use]
    pub fn cob_id(&self) -> CobId {
        if self.activity.is_active() {
            return CobId(self.can_id.raw());
        }
        let predefined = self.party().predefined_can_id(self.node_id);
        CobId(CobId::BIT_31 | predefined.map_or(u32::from(self.node_id.get()), CanId::raw))
    }

    /// The parameter that decides on the identifier: P427, or P16404 to P16415 for TPDO 5 to 16 (GW-CFG-12,
    /// GW-CFG-13).
    #[must_use]
    pub fn identifier_parameter(&self) -> Parameter {
        self.of_tpdo(Parameter::tpdo_identifier).unwrap_or(Parameter::MY_NODE_ID)
    }

    /// The parameter that decides on the period, if there is one (GW-TIMING-04, GW-TIMING-09).
    #[must_use]
    pub fn period_parameter(&self) -> Option<Parameter> {
        match self.direction {
            PdoDirection::Transmit => Parameter::tpdo_cycle(self.number),
            PdoDirection::Receive => Parameter::rpdo_monitoring(self.number),
        }
    }

    fn of_tpdo(&self, parameter: fn(u8) -> Option<Parameter>) -> Option<Parameter> {
        match self.direction {
            PdoDirection::Transmit => parameter(self.number),
            PdoDirection::Receive => None,
        }
    }

    /// The parameters of the governor that make the PDO active or keep it inactive, but for switch functions and
    /// sensors, which [`Configuration`](super::Configuration) lists (7.3).
    pub fn activity_parameters(&self) -> impl Iterator<Item = Parameter> {
        let selecting = self.of_tpdo(|number| match number {
            1 | 2 => Some(Parameter::SEND_ERRORS),
            3 => Some(Parameter::SEND_STATUS),
            _ => None,
        });
        let number = self.number;
        let assignments = (0..4).filter_map(move |word| Parameter::tpdo_assignment(number, word));
        let is_tpdo = self.direction == PdoDirection::Transmit;
        let cycle = self.of_tpdo(Parameter::tpdo_cycle);
        selecting.into_iter().chain(assignments.filter(move |_| is_tpdo)).chain(cycle)
    }
}
