//! What the gateway does not check, and what is hardly meant.

use super::decimal::Decimal;
use super::problem::{self, Problem};
use super::reading::Reading;
use super::words;
use edskit_devices::gateway::{
    Activity, BitTiming, Hindrance, Input, Owner, Parameter, Pdo, PdoTable, Period, SignalType, Signals,
    Target,
};
use edskit_lint::Severity;

/// `told` are the identifiers of which another finding says already how they are written.
pub(super) fn of(reading: &Reading, table: &PdoTable, told: &[Parameter]) -> Vec<Problem> {
    let mut problems = Vec::new();
    engine_stop(reading, &mut problems);
    let switch_functions: Vec<Input> = reading.configuration.switch_functions().collect();
    let sensors: Vec<Input> = reading.configuration.sensors().collect();
    for (inputs, words) in [(&switch_functions, &FUNCTION), (&sensors, &SENSOR)] {
        targets(reading, inputs, words, &mut problems);
        shared(reading, inputs, &mut problems);
    }
    signals(reading, &mut problems);
    tpdos(reading, table, &mut problems);
    times(reading, table, &mut problems);
    partner(reading, &mut problems);
    units(reading, &mut problems);
    bit_timings(reading, &mut problems);
    uncompared_bit_timings(reading, &mut problems);
    decimal_identifiers(reading, told, &mut problems);
    problems
}

/// GW-CFG-05.
fn engine_stop(reading: &Reading, problems: &mut Vec<Problem>) {
    if reading.configuration.engine_stop_from_canopen() {
        let place = reading.label(Parameter::ENGINE_STOP_TYPE, "3 is CANopen");
        let problem = Problem::new(problem::ENGINE_STOP, place, "the engine stop is taken from CANopen");
        problems.push(problem.help("wire it: the manual forbids to transmit it (7.1.4.1)"));
    }
}

/// Words for switch functions or sensors.
struct Words {
    what: &'static str,
    place: &'static str,
    allowed: &'static str,
    unassigned: &'static str,
}

const FUNCTION: Words = Words {
    what: "switch function",
    place: "bit of RPDO1 word 1",
    allowed: "the bit of RPDO1 word 1, 1 to 16, or -1 to -16 if it is active while the bit is 0",
    unassigned: "the function is always 0",
};

const SENSOR: Words = Words {
    what: "sensor",
    place: "CANopen channel",
    allowed: "the channel, 1 (RPDO2 word 1) to 12 (RPDO4 word 4)",
    unassigned: "the sensor is never received",
};

/// GW-CFG-04, GW-CFG-07.
fn targets(reading: &Reading, inputs: &[Input], words: &Words, problems: &mut Vec<Problem>) {
    for Input { assignment, kind, target } in inputs.iter().copied() {
        let reason = reading.label(kind, "3: it comes from CANopen");
        let number = assignment.number();
        match target {
            Target::Bit { .. } | Target::Channel(_) => {}
            Target::Nowhere(value) => {
                let message = format!("{assignment} is {value}, and there is no such {}", words.place);
                let problem = Problem::new(problem::OUT_OF_RANGE, reading.label(assignment, ""), message);
                problems.push(problem.labels([reason]).help(format!("write {}", words.allowed)));
            }
            Target::Unassigned => {
                let message =
                    format!("the {} of {kind} comes from CANopen, but has no place there", words.what);
                let effect = reading.label(assignment, words.unassigned);
                let problem = Problem::new(problem::UNASSIGNED_INPUT, reason, message).labels([effect]);
                problems.push(problem.help(format!("write into P{number} {}", words.allowed)));
            }
        }
    }
}

fn shared(reading: &Reading, inputs: &[Input], problems: &mut Vec<Problem>) {
    let place = |target| match target {
        Target::Bit { number, .. } => Some((format!("bit {number} of RPDO1 word 1"), number)),
        Target::Channel(channel) => Some((format!("channel {channel}"), channel)),
        Target::Unassigned | Target::Nowhere(_) => None,
    };
    for (position, input) in inputs.iter().enumerate() {
        let Some((name, number)) = place(input.target) else { continue };
        let earlier = inputs[..position].iter();
        let first =
            earlier.into_iter().find(|other| place(other.target).is_some_and(|(_, own)| own == number));
        if let Some(first) = first {
            let message = format!("{} and {} are on the same {name}", first.assignment, input.assignment);
            let problem = Problem::new(problem::SHARED_INPUT, reading.label(input.assignment, ""), message);
            problems.push(problem.labels([reading.label(first.assignment, "the first one")]));
        }
    }
}

/// GW-PDO-05, GW-PDO-08.
fn signals(reading: &Reading, problems: &mut Vec<Problem>) {
    let assignments =
        (4..=16).flat_map(|tpdo| (0..4).map(move |word| (tpdo, Parameter::tpdo_assignment(tpdo, word))));
    for (tpdo, assignment) in assignments.filter_map(|(tpdo, assignment)| Some((tpdo, assignment?))) {
        let number = reading.configuration.get(assignment) as u16;
        if number == 0 {
            continue;
        }
        let title = reading.signals.title(number);
        let place = reading.label(assignment, "");
        if !reading.signals.knows(number) {
            let message = format!("nothing is known of parameter {title}, which TPDO{tpdo} is to carry");
            let help = format!(
                "if the governor has it as an 8-bit or 16-bit value, describe it: `{number} = {{ name = \"..\", type = \"u16\" }}` in `[governor.signals]`; if not, the word is left out"
            );
            problems.push(Problem::new(problem::UNKNOWN_SIGNAL, place, message).help(help));
        } else if reading.signals.signal_type(number) == Some(SignalType::Bit) {
            let message = format!("{title} is a single bit, which TPDO{tpdo} cannot carry");
            let help = "the word is left out, and the TPDO is 2 bytes shorter; write another parameter, or 0";
            let problem = Problem::new(problem::NOT_ANALOGUE, place, message);
            let declared = reading.signals.declared.get(&number);
            let problem = match declared {
                Some(declared) => problem.label(declared.span, "described here"),
                None => problem,
            };
            problems.push(problem.help(help));
        }
    }
}

/// GW-CFG-03.
fn tpdos(reading: &Reading, table: &PdoTable, problems: &mut Vec<Problem>) {
    for pdo in &table.tpdos {
        let party = pdo.party();
        let Some(cycle) = pdo.period_parameter() else { continue };
        match pdo.activity {
            Activity::NoCycle => {
                let message = format!("{party} has data but no cycle time, so that it is not sent");
                let problem = Problem::new(problem::IDLE_TPDO, reading.label(cycle, ""), message);
                let help = format!(
                    "write the cycle time in ms into P{}, or leave it if that is meant",
                    cycle.number()
                );
                problems.push(problem.help(help));
            }
            // What is assigned and cannot be sent has been reported.
            Activity::NoData if is_unassigned(reading, pdo) => {
                let message = format!("{party} has a cycle time but no data, so that it is not sent");
                let problem = Problem::new(problem::IDLE_TPDO, reading.label(cycle, ""), message);
                let first = pdo.activity_parameters().next();
                problems.push(match first {
                    Some(first) => problem.help(format!(
                        "write into P{} to P{} what it is to carry, or leave it if that is meant",
                        first.number(),
                        first.number() + 3
                    )),
                    None => problem,
                });
            }
            _ => {}
        }
    }
}

fn is_unassigned(reading: &Reading, pdo: &Pdo) -> bool {
    (0..4)
        .filter_map(|word| Parameter::tpdo_assignment(pdo.number, word))
        .all(|p| reading.configuration.get(p) == 0)
}

/// GW-NOTE-08.
fn times(reading: &Reading, table: &PdoTable, problems: &mut Vec<Problem>) {
    for pdo in table.iter() {
        let (Some(parameter), Some(period)) = (pdo.period_parameter(), pdo.period) else { continue };
        if period.is_capped {
            let Period { setting_ms, cycle, .. } = period;
            let longest = words::milliseconds(period.micros());
            let message =
                format!("{parameter} is {setting_ms} ms, longer than the longest time, {longest} ms");
            let place = reading.label(parameter, format!("counts as {longest} ms"));
            let help =
                format!("a time is at most {} main cycles of the governor; write at most 3999", cycle.most);
            problems.push(Problem::new(problem::CAPPED_TIME, place, message).help(help));
        }
    }
}

fn partner(reading: &Reading, problems: &mut Vec<Problem>) {
    let monitored = reading.configuration.heartbeat_monitoring().is_some();
    if monitored && reading.configuration.partner_node_id() == 0 {
        let place = reading.label(Parameter::PARTNER_NODE_ID, "no node has node-ID 0");
        let time = reading.label(Parameter::HEARTBEAT_RX_TIME, "switches the monitoring on");
        let problem =
            Problem::new(problem::NO_PARTNER, place, "a heartbeat is monitored, but no partner is named");
        problems.push(problem.labels([time]).help("write the partner's node-ID into P428, or 0 into P430"));
    }
}

/// What must be equal in both units, and whether they communicate (7.1.1, 7.2.1; GW-CFG-31 to GW-CFG-34, GW-CFG-46).
fn units(reading: &Reading, problems: &mut Vec<Problem>) {
    for hindrance in reading.configuration.hindrances() {
        problems.push(match hindrance {
            Hindrance::NodeNumbers { gateway, governor } | Hindrance::BitRates { gateway, governor } => {
                disagreement(reading, gateway, governor)
                    .help(format!("write the same value into both; {NO_CANOPEN}"))
            }
            Hindrance::SwitchedOff(parameter) => {
                let peer = match parameter.owner() {
                    Owner::Gateway => "governor",
                    Owner::Governor => "gateway",
                };
                let message = format!("{parameter} switches the communication with the {peer} off");
                let problem = Problem::new(problem::COMMUNICATION_OFF, reading.label(parameter, ""), message);
                problem.help(format!("{NO_CANOPEN}; write 1"))
            }
        });
    }
    // All participants should have one delay; without it they initialise each other nevertheless.
    let delays = [Owner::Gateway, Owner::Governor].map(|owner| Parameter::find(owner, 400));
    if let [Some(gateway), Some(governor)] = delays
        && [gateway, governor].iter().all(|delay| reading.setting(*delay).is_some())
        && reading.configuration.get(gateway) != reading.configuration.get(governor)
    {
        let problem = disagreement(reading, gateway, governor).severity(Severity::Warning);
        problems.push(problem.help("write the same value into both"));
    }
}

const NO_CANOPEN: &str = "without it there is no initialisation and no CANopen";

/// Two parameters that should be equal and are not, at the one that the file sets.
fn disagreement(reading: &Reading, gateway: Parameter, governor: Parameter) -> Problem {
    let is = |parameter: Parameter| parameter.amount(reading.configuration.get(parameter));
    let [gateway, governor] = [gateway, governor].map(|parameter| reading.as_set(parameter));
    let message = format!(
        "{gateway} of the gateway is {}, and {governor} of the governor is {}",
        is(gateway),
        is(governor)
    );
    let mut labels = [(gateway, "in the gateway"), (governor, "in the governor")];
    labels.sort_by_key(|(parameter, _)| reading.setting(*parameter).is_none());
    let [place, other] = labels.map(|(parameter, text)| reading.label(parameter, text));
    Problem::new(problem::UNITS_DISAGREE, place, message).labels([other])
}

/// GW-CFG-47.
fn bit_timings(reading: &Reading, problems: &mut Vec<Problem>) {
    for timing in BitTiming::ALL.iter().filter(|timing| !timing.is_manual(&reading.configuration)) {
        let set: Vec<Parameter> =
            timing.segments().filter(|segment| reading.configuration.get(*segment) != 0).collect();
        let [first, others @ ..] = &set[..] else { continue };
        let switch = reading.as_set(timing.switch);
        let all = match others.last() {
            Some(last) => format!("P{} to P{} have", first.number(), last.number()),
            None => format!("{first} has"),
        };
        let message = format!("{all} no effect, because {switch} is 0");
        let place = reading.label(*first, "for a manual bit timing");
        let problem = Problem::new(problem::UNUSED_BIT_TIMING, place, message);
        let problem = problem.labels(others.iter().map(|other| reading.label(*other, "")));
        let problem = problem.labels([reading.label(switch, "its switch")]);
        problems.push(problem.help(format!("write `{} = 1`, or 0 into the segments", switch.number())));
    }
}

/// GW-NOTE-48.
fn uncompared_bit_timings(reading: &Reading, problems: &mut Vec<Problem>) {
    let timings = [BitTiming::OF_GATEWAY, BitTiming::OF_GOVERNOR];
    let manual = timings.map(|timing| timing.is_manual(&reading.configuration));
    let place = |timing: &BitTiming| reading.label(timing.switch, "a manual bit timing");
    let help = "both must come to one bit rate, which cannot be computed; compare the two by hand";
    let values = |timing: &BitTiming| {
        timing.segments().take(5).map(|segment| reading.configuration.get(segment)).collect::<Vec<_>>()
    };
    let [of_gateway, of_governor] = &timings;
    let (timing, message) = match manual {
        [true, false] => (of_gateway, "the gateway alone has a manual bit timing on the HEINZMANN bus"),
        [false, true] => (of_governor, "the governor alone has a manual bit timing on the HEINZMANN bus"),
        [true, true] if values(of_gateway) != values(of_governor) => {
            (of_gateway, "the manual bit timings of gateway and governor differ")
        }
        _ => return,
    };
    problems.push(Problem::new(problem::UNCOMPARED_BIT_TIMING, place(timing), message).help(help));
}

fn decimal_identifiers(reading: &Reading, told: &[Parameter], problems: &mut Vec<Problem>) {
    let untold = Decimal::all(reading).filter(|decimal| !told.contains(&decimal.parameter));
    problems.extend(untold.map(|decimal| decimal.problem(reading.label(decimal.parameter, ""))));
}
