//! What the gateway finds at its initialisation (7.3), and what CiA 301 says beyond that.

use super::decimal::Decimal;
use super::problem::{self, Problem};
use super::reading::Reading;
use edskit_devices::gateway::{
    Activity, CanOpenError, GatewayError, INITIALISATION_ATTEMPTS, Input, Parameter, Pdo, PdoTable, RULES,
    Source, Target,
};
use edskit_lint::Label;
use edskit_types::{CanId, Conflict, IdentifierRules, Opponent, Party, SdoMessage, conflicts};

/// What none of the pre-defined connections of any node has, and CiA 301 does not restrict.
const FREE_IDENTIFIERS: std::ops::RangeInclusive<u16> = 0x680..=0x6DF;

/// Everything that the gateway itself refuses.
pub(super) fn refused(reading: &Reading, table: &PdoTable) -> Vec<Problem> {
    let found = found(table, &RULES);
    // TPDOs whose identifier was left at 000h are each in the way of NMT, and need not be told of each other.
    let is_with_service = |conflict: &&Conflict| match conflict.with {
        Opponent::Party(other) => table.find(other).is_none(),
        Opponent::Restricted(_) => false,
    };
    let services: Vec<CanId> = found.iter().filter(is_with_service).map(|conflict| conflict.can_id).collect();
    found
        .iter()
        .filter(|conflict| is_with_service(conflict) || !services.contains(&conflict.can_id))
        .filter_map(|conflict| refusal(reading, table, conflict))
        .collect()
}

/// What the gateway accepts and CiA 301 restricts (GW-NOTE-19).
pub(super) fn restricted(reading: &Reading, table: &PdoTable) -> Vec<Problem> {
    let refused: Vec<CanId> = found(table, &RULES).iter().map(|conflict| conflict.can_id).collect();
    let found = found(table, &IdentifierRules::CIA_301);
    found
        .iter()
        .filter(|conflict| !refused.contains(&conflict.can_id))
        .filter_map(|conflict| {
            let Opponent::Restricted(range) = conflict.with else { return None };
            let pdo = table.find(conflict.party)?;
            let message =
                format!("{} has the identifier {}, which CiA 301 restricts", pdo.party(), conflict.can_id);
            let place = reading.label(pdo.identifier_parameter(), format!("in {range}"));
            let problem = Problem::new(problem::RESTRICTED_CAN_ID, place, message);
            let problem = problem.labels(why_active(reading, pdo));
            let reason = "the gateway accepts it, but other devices on the bus may use it";
            Some(match Decimal::of(reading, pdo.identifier_parameter()) {
                Some(decimal) => {
                    problem.help(format!("{}; {reason}", decimal.help_first())).decimals([decimal.parameter])
                }
                None => problem.help(format!("{reason}; {}", instead(table, pdo))),
            })
        })
        .collect()
}

fn found(table: &PdoTable, rules: &IdentifierRules<'static>) -> Vec<Conflict> {
    conflicts(table.claims().as_mut_slice(), rules).collect()
}

fn refusal(reading: &Reading, table: &PdoTable, conflict: &Conflict) -> Option<Problem> {
    let Opponent::Party(other) = conflict.with else { return None };
    let Some(pdo) = table.find(conflict.party) else { return Some(equal_node_ids(reading, table)) };
    // The parameter of a TPDO with an identifier of its own is where to mend it.
    let (pdo, other) = match table.find(other) {
        Some(second) if pdo.identifier_parameter() == Parameter::MY_NODE_ID => (second, conflict.party),
        _ => (pdo, other),
    };
    let id = conflict.can_id;
    let message = match table.find(other) {
        Some(other) => format!("{} and {} have the same identifier {id}", pdo.party(), other.party()),
        None => format!("{} has the identifier {id} of {}", pdo.party(), service(other)),
    };
    let place = reading.label(pdo.identifier_parameter(), format!("{} is on {id}", pdo.party()));
    let others = match table.find(other) {
        Some(other) => {
            let identifier = reading.label(other.identifier_parameter(), identifier_of(other));
            std::iter::once(identifier).chain(why_active(reading, other)).collect()
        }
        None => service_label(reading, other, id).into_iter().collect::<Vec<Label>>(),
    };
    let problem = Problem::new(problem::IDENTIFIER_CONFLICT, place, message);
    let problem = problem.labels(others).labels(why_active(reading, pdo));
    // An identifier in decimal digits may be another one than it looks, so that a third one is no advice.
    let parties = [Some(pdo), table.find(other)].into_iter().flatten();
    let decimals: Vec<Decimal> =
        parties.filter_map(|pdo| Decimal::of(reading, pdo.identifier_parameter())).collect();
    let mut advice: Vec<String> =
        decimals.iter().map(|decimal| format!("{}: {}", decimal.parameter, decimal.help_first())).collect();
    if advice.is_empty() {
        advice.push(instead(table, pdo));
    }
    let problem = problem.decimals(decimals.iter().map(|decimal| decimal.parameter));
    Some(problem.help(format!("{}; {}", advice.join("; "), consequence())))
}

fn equal_node_ids(reading: &Reading, table: &PdoTable) -> Problem {
    let message = format!("the gateway and its partner both have the node-ID {}", table.node_id);
    let place = reading.label(Parameter::PARTNER_NODE_ID, "the partner");
    let own = reading.label(Parameter::MY_NODE_ID, "the gateway");
    let help = format!("write the partner's own node-ID, or 0 if there is none; {}", consequence());
    Problem::new(problem::EQUAL_NODE_IDS, place, message).labels([own]).help(help)
}

/// What the device does.
fn consequence() -> String {
    format!(
        "with this the initialisation fails, and after {INITIALISATION_ATTEMPTS} attempts the gateway stays off CANopen with {} and {}",
        CanOpenError::Init,
        GatewayError::CanOpen
    )
}

/// What to write in the place of the identifier of a TPDO.
fn instead(table: &PdoTable, pdo: &Pdo) -> String {
    // Each TPDO looks from its own place on, so that several are not given the same advice.
    let first = FREE_IDENTIFIERS.start() + u16::from(pdo.number);
    let is_free = |id: &u16| table.iter().all(|pdo| pdo.can_id.raw() != u32::from(*id));
    match (first..=*FREE_IDENTIFIERS.end()).find(is_free) {
        Some(free) => format!("write an identifier that is free for {}, such as `0x{free:X}`", pdo.party()),
        None => format!("write an identifier that is free for {}", pdo.party()),
    }
}

/// How an identifier comes about.
fn identifier_of(pdo: &Pdo) -> String {
    if pdo.identifier_parameter() == Parameter::MY_NODE_ID {
        let base = pdo.can_id.raw() - u32::from(pdo.node_id().get());
        format!("{} is on {base:03X}h + {} = {}", pdo.party(), pdo.node_id(), pdo.can_id)
    } else {
        format!("{} is on {} too", pdo.party(), pdo.can_id)
    }
}

fn service(party: Party) -> String {
    match party {
        Party::Sdo { message: SdoMessage::Response, .. } => "the gateway's SDO responses".to_owned(),
        Party::Sdo { .. } => "the gateway's SDO requests".to_owned(),
        Party::Heartbeat => "the gateway's heartbeat".to_owned(),
        Party::HeartbeatOf(node) => format!("the heartbeat of its partner, node {node}"),
        other => other.to_string(),
    }
}

/// The parameter that decides on the identifier of a service; the same for all nodes have none.
fn service_label(reading: &Reading, party: Party, id: CanId) -> Option<Label> {
    let (parameter, base) = match party {
        Party::Sdo { message: SdoMessage::Response, .. } => (Parameter::MY_NODE_ID, 0x580),
        Party::Sdo { message: SdoMessage::Request, .. } => (Parameter::MY_NODE_ID, 0x600),
        Party::Heartbeat => (Parameter::MY_NODE_ID, 0x700),
        Party::HeartbeatOf(_) => (Parameter::PARTNER_NODE_ID, 0x700),
        _ => return None,
    };
    let node = id.raw() - base;
    Some(reading.label(parameter, format!("{base:03X}h + {node} = {id}")))
}

/// The parameters that make a PDO active.
fn why_active(reading: &Reading, pdo: &Pdo) -> Vec<Label> {
    let party = pdo.party();
    let mut labels = Vec::new();
    match pdo.activity {
        Activity::Selected => {
            let selecting = pdo.activity_parameters().next();
            labels
                .extend(selecting.map(|parameter| reading.label(parameter, format!("makes {party} active"))));
        }
        Activity::DataAndCycle => {
            let assignments = pdo.words().iter().filter_map(|word| match word.source {
                Source::Signal { assignment, number, .. } => Some((assignment, number)),
                _ => None,
            });
            if let Some((assignment, number)) = assignments.into_iter().next() {
                let text = format!("{party} carries {}", reading.signals.title(number));
                labels.push(reading.label(assignment, text));
            }
            let cycle = pdo.period_parameter();
            labels.extend(cycle.map(|parameter| reading.label(parameter, format!("{party} is sent"))));
        }
        _ => labels.extend(first_input(reading, pdo)),
    }
    labels
}

/// The first switch function or sensor in an RPDO.
fn first_input(reading: &Reading, pdo: &Pdo) -> Option<Label> {
    let party = pdo.party();
    let channels: Vec<u8> = pdo
        .words()
        .iter()
        .filter_map(|word| match word.source {
            Source::Sensor { channel } => Some(channel),
            _ => None,
        })
        .collect();
    let is_in = |input: &Input| match input.target {
        Target::Bit { .. } => true,
        Target::Channel(channel) => channels.contains(&channel) || channels.is_empty(),
        Target::Unassigned | Target::Nowhere(_) => false,
    };
    let configuration = &reading.configuration;
    let functions = configuration.switch_functions().filter(|_| pdo.number == 1);
    let mut inputs = functions.chain(configuration.sensors()).filter(is_in);
    let input = inputs.next()?;
    let what = match input.target {
        Target::Bit { .. } => "a switch function in",
        _ if pdo.number == 1 => "a sensor, whose error flag is in",
        _ => "a sensor in",
    };
    Some(reading.label(input.assignment, format!("{what} {party}")))
}
