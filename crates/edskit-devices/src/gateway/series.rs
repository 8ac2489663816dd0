//! The table of parameters (11.2, 11.4, 11.5 for the gateway; 7.1 for the governor).

use super::parameter::{Owner, Parameter, Quantity, Values};

/// A row of the table: one parameter, or several with consecutive numbers and one meaning.
pub(super) struct Series {
    pub(super) owner: Owner,
    pub(super) first: u16,
    pub(super) count: u16,
    pub(super) naming: Naming,
    /// Spellings that the manual prints elsewhere (GW-NOTE-43).
    pub(super) also: &'static [&'static str],
    pub(super) level: Option<u8>,
    pub(super) values: Values,
    pub(super) quantity: Quantity,
    pub(super) default: i32,
    pub(super) meaning: &'static str,
    /// How many parameters the rows before have.
    pub(super) base: u16,
}

/// How the members of a series are called.
#[derive(Clone, Copy)]
pub(super) enum Naming {
    /// The only member.
    Single(&'static str),
    /// The stem, and the place in the series in parentheses.
    Indexed(&'static str),
    /// `CanOpTPDO4Assign(0)` to `CanOpTPDO16Assign(3)`.
    TpdoAssignment,
    /// The manual names some members only.
    Some(&'static [(u16, &'static str)]),
}

const BIT_RATES: Values = Values::OneOf(&[125, 250, 500, 1000]);
const FLAG: Values = Values::Between(0, 1);
const WORD: Values = Values::Between(0, 0xFFFF);
const NODE_NUMBER: Values = Values::Between(1, 31);
/// What the governor's own inputs may be numbered with is not in this manual.
const ANY_ASSIGNMENT: Values = Values::Between(-0x8000, 0x7FFF);
const ANY_TYPE: Values = Values::Between(0, 0xFF);

const fn gateway(number: u16, name: &'static str, values: Values, meaning: &'static str) -> Series {
    Series {
        owner: Owner::Gateway,
        first: number,
        count: 1,
        naming: Naming::Single(name),
        also: &[],
        level: Some(6),
        values,
        quantity: Quantity::Number,
        default: 0,
        meaning,
        base: 0,
    }
}

const fn governor(number: u16, naming: Naming, values: Values, meaning: &'static str) -> Series {
    Series { owner: Owner::Governor, naming, level: None, ..gateway(number, "", values, meaning) }
}

impl Series {
    const fn of(self, quantity: Quantity, default: i32) -> Series {
        Series { quantity, default, ..self }
    }

    const fn also(self, also: &'static [&'static str]) -> Series {
        Series { also, ..self }
    }

    const fn times(self, count: u16, naming: Naming) -> Series {
        Series { count, naming, ..self }
    }
}

use Naming::{Indexed, Single, TpdoAssignment};
use Quantity::{Identifier, KbitPerSecond, Milliseconds, Number, Seconds};
use Values::Between;

const ROWS: [Series; 50] = [
    gateway(400, "CanStartTimeOutDelay", Between(0, 100_000), "delay of the monitoring of the HEINZMANN bus")
        .of(Seconds, 1000),
    gateway(401, "CanMyNodeNumber", NODE_NUMBER, "own node number on the HEINZMANN bus").of(Number, 1),
    gateway(402, "CanDCNodeNumber", NODE_NUMBER, "node number of the governor").of(Number, 1),
    gateway(410, "HzmCanPrescaler", Between(0, 63), "prescaler of the HEINZMANN bus"),
    gateway(411, "HzmCanSyncJumpWidth", Between(0, 3), "synchronisation jump width of the HEINZMANN bus"),
    gateway(412, "HzmCanSamplingMode", FLAG, "sampling mode of the HEINZMANN bus"),
    gateway(413, "HzmCanPhaseSegment1", Between(0, 7), "phase segment 1 of the HEINZMANN bus"),
    gateway(414, "HzmCanPhaseSegment2", Between(0, 7), "phase segment 2 of the HEINZMANN bus"),
    gateway(415, "HzmCanPropSegment", Between(0, 7), "propagation segment of the HEINZMANN bus"),
    gateway(416, "HzmCanBaudrate", BIT_RATES, "bit rate of the HEINZMANN bus").of(KbitPerSecond, 250),
    gateway(420, "CanOpenPrescaler", Between(0, 63), "prescaler of the CANopen bus"),
    gateway(421, "CanOpenSyncJumpWidth", Between(0, 3), "synchronisation jump width of the CANopen bus"),
    gateway(422, "CanOpenSamplingMode", FLAG, "sampling mode of the CANopen bus"),
    gateway(423, "CanOpenPhaseSegment1", Between(0, 7), "phase segment 1 of the CANopen bus"),
    gateway(424, "CanOpenPhaseSegment2", Between(0, 7), "phase segment 2 of the CANopen bus"),
    gateway(425, "CanOpenPropSegment", Between(0, 7), "propagation segment of the CANopen bus"),
    gateway(426, "CanOpenBaudrate", BIT_RATES, "bit rate of the CANopen bus").of(KbitPerSecond, 125),
    gateway(427, "CanOpenMyNodeID", Between(1, 127), "own node-ID").of(Number, 1),
    gateway(428, "CanOpenPartnerNodeID", Between(0, 127), "node-ID of the monitored partner"),
    gateway(429, "CanOpHeartBeatTxTime", WORD, "cycle time of the own heartbeat").of(Milliseconds, 0),
    gateway(430, "CanOpHeartBeatRxTime", WORD, "monitoring time of the partner's heartbeat")
        .of(Milliseconds, 0),
    Series {
        level: Some(1),
        ..gateway(1800, "Level", Between(1, 7), "user level of the PC tool").of(Number, 1)
    },
    gateway(4400, "HzmCanCommDCOn", FLAG, "communication with the governor").of(Number, 1),
    gateway(4416, "HzmCanSegmOrBaudrate", FLAG, "manual bit timing of the HEINZMANN bus")
        .also(&["HzmCanSegmentOrBaurdate", "HzmCanSegmentOrBaudrate"]),
    gateway(4426, "CanOpSegmOrBaudrate", FLAG, "manual bit timing of the CANopen bus")
        .also(&["CanOpSegmentOrBaurdate", "CanOpSegmentOrBaudrate"]),
    gateway(16404, "", Between(0, 0x7FF), "identifier of a TPDO, 5 to 16")
        .of(Identifier, 0)
        .times(12, Indexed("CanOpTPDO5-16ID")),
    governor(
        400,
        Single("CanStartTimeOutDelay"),
        Between(0, 100_000),
        "delay of the monitoring of the HEINZMANN bus",
    )
    .of(Seconds, 1000),
    governor(401, Single("CanMyNodeNumber"), NODE_NUMBER, "own node number on the HEINZMANN bus")
        .of(Number, 1),
    governor(403, Single("CanCMNodeNumber"), NODE_NUMBER, "node number of the gateway").of(Number, 1),
    // The bit rate of the governor stands in the manual under two numbers, 409 in the example and 416 in the text, and
    // so does the switch of its bit timing. Each pair is one parameter (GW-NOTE-37).
    governor(409, Single("CanBaudrate"), BIT_RATES, "bit rate of the HEINZMANN bus").of(KbitPerSecond, 250),
    governor(410, Single("CanPrescaler"), Between(0, 63), "prescaler of the HEINZMANN bus"),
    governor(
        411,
        Single("CanSyncJumpWidth"),
        Between(0, 3),
        "synchronisation jump width of the HEINZMANN bus",
    ),
    governor(412, Single("CanSamplingMode"), FLAG, "sampling mode of the HEINZMANN bus"),
    governor(413, Single("CanPhaseSegment1"), Between(0, 7), "phase segment 1 of the HEINZMANN bus"),
    governor(414, Single("CanPhaseSegment2"), Between(0, 7), "phase segment 2 of the HEINZMANN bus"),
    governor(416, Single("CanBaudrate"), BIT_RATES, "bit rate of the HEINZMANN bus").of(KbitPerSecond, 250),
    governor(810, Naming::Some(&[]), ANY_ASSIGNMENT, "assignment of the engine stop switch function"),
    governor(811, Naming::Some(FUNCTIONS), ANY_ASSIGNMENT, "assignment of a switch function")
        .times(SWITCH_FUNCTIONS, Naming::Some(FUNCTIONS)),
    governor(900, Naming::Some(ASSIGNMENTS), ANY_ASSIGNMENT, "assignment of a sensor")
        .times(SENSORS, Naming::Some(ASSIGNMENTS)),
    governor(4406, Single("CanCommCMOn"), FLAG, "communication with the gateway").of(Number, 1),
    governor(4409, Single("CanSegmentOrBaudrate"), FLAG, "manual bit timing of the HEINZMANN bus")
        .also(&["CanSegmentOrBaurdate"]),
    governor(4416, Single("CanSegmentOrBaudrate"), FLAG, "manual bit timing of the HEINZMANN bus")
        .also(&["CanSegmentOrBaurdate"]),
    governor(4810, Naming::Some(&[]), ANY_TYPE, "where the engine stop switch function comes from"),
    governor(4811, Naming::Some(FUNCTION_TYPES), ANY_TYPE, "where a switch function comes from")
        .times(SWITCH_FUNCTIONS, Naming::Some(FUNCTION_TYPES)),
    governor(4900, Naming::Some(CHANNEL_TYPES), ANY_TYPE, "where a sensor comes from")
        .times(SENSORS, Naming::Some(CHANNEL_TYPES)),
    governor(14401, Single("CanOpenSendErrors"), FLAG, "TPDO 1 and 2 are active"),
    governor(14402, Single("CanOpenSendStatus"), FLAG, "TPDO 3 is active"),
    governor(16400, TpdoAssignment, WORD, "parameter that a word of a TPDO carries")
        .times(52, TpdoAssignment),
    governor(16460, Indexed("CanOpTPDO4-16Cyc"), WORD, "cycle time of a TPDO, 4 to 16")
        .of(Milliseconds, 0)
        .times(13, Indexed("CanOpTPDO4-16Cyc")),
    governor(16480, Indexed("CanOpRPDO1-4Cyc"), WORD, "monitoring time of an RPDO")
        .of(Milliseconds, 0)
        .times(4, Indexed("CanOpRPDO1-4Cyc")),
];

/// The table with [`Series::base`] filled in.
pub(super) static SERIES: [Series; ROWS.len()] = {
    let mut rows = ROWS;
    let (mut nth, mut base) = (0, 0);
    while nth < rows.len() {
        rows[nth].base = base;
        base += rows[nth].count;
        nth += 1;
    }
    rows
};

/// How many parameters there are.
pub(super) const PARAMETERS: usize = {
    let last = &SERIES[SERIES.len() - 1];
    (last.base + last.count) as usize
};

/// The parameter with this number.
pub(super) const fn find(owner: Owner, number: u16) -> Option<Parameter> {
    let mut nth = 0;
    while nth < SERIES.len() {
        let series = &SERIES[nth];
        let same_owner = matches!(
            (series.owner, owner),
            (Owner::Gateway, Owner::Gateway) | (Owner::Governor, Owner::Governor)
        );
        if same_owner && series.first <= number && number - series.first < series.count {
            return Some(Parameter { series, offset: number - series.first });
        }
        nth += 1;
    }
    None
}

/// P811 to P899 and P4811 to P4899.
const SWITCH_FUNCTIONS: u16 = 89;
/// P900 to P999 and P4900 to P4999.
const SENSORS: u16 = 100;

/// The named members from 811 on (7.1.4.1; GW-NOTE-09).
const FUNCTIONS: &[(u16, &str)] =
    &[(0, "FunctIdleSpeed"), (16, "FunctSetpoint2Or1"), (24, "FunctLoadEnable")];
/// The named members from 4811 on (7.1.4.1).
const FUNCTION_TYPES: &[(u16, &str)] =
    &[(0, "Type_IdleSpeed"), (16, "Type_Setpoint2Or1"), (24, "Type_LoadEnable")];
/// The named members from 900 on (7.1.4.2; GW-NOTE-10).
const ASSIGNMENTS: &[(u16, &str)] = &[
    (0, "AssignIn_Setp1Ext"),
    (1, "AssignIn_Setp2Ext"),
    (6, "AssignIn_AmbPress"),
    (17, "AssignIn_CurrentLoad"),
];
/// The named members from 4900 on (7.1.4.2; GW-NOTE-10).
const CHANNEL_TYPES: &[(u16, &str)] = &[
    (0, "ChanType_Setp1Ext"),
    (1, "ChanType_Setp2Ext"),
    (6, "ChanType_AmbPress"),
    (17, "ChanType_CurrentLoad"),
];
