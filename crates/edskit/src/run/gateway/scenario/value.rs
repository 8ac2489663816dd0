//! Values of a step.

use super::Action;
use super::shown::shown;
use super::words::{COMMANDS, NMT, UNITS, fault_name};
use crate::config::problem::{OUT_OF_RANGE, Problem, UNKNOWN_KEY, UNKNOWN_WORD, WRONG_TYPE};
use crate::config::{KnownSignals, Place, entries, parameters_of, span, what_is};
use edskit_devices::gateway::{Fault, Owner};
use edskit_lint::nearest;
use edskit_model::Span;
use edskit_runtime::Microseconds;
use toml::Spanned;
use toml::de::DeValue;

/// What is around the values of a scenario.
pub(super) struct Context<'t> {
    /// The text of the file.
    pub(super) text: &'t str,
    /// What is known of the governor.
    pub(super) signals: &'t KnownSignals,
}

/// A value with its place.
pub(super) type Value<'t> = Spanned<DeValue<'t>>;

/// The latest time, in s.
const LATEST: f64 = 1e6;
/// How far a number may be off from a multiple of its step before it counts as finer.
const ROUNDING: f64 = 1e-3;

/// A number that a step can hold.
struct Scale {
    /// What it is in words: `a number of seconds`.
    what: &'static str,
    low: f64,
    high: f64,
    /// How many steps make one.
    steps: f64,
    /// What it may be.
    allowed: &'static str,
}

const TIME: Scale = Scale {
    what: "a number of seconds",
    low: 0.0,
    high: LATEST,
    steps: 1e6,
    allowed: "0 to 1000000, in steps of 0.000001",
};
/// That of 3600 PowerSupply (11.3; GW-APP-42).
const SUPPLY: Scale = Scale {
    what: "a number of volts",
    low: 0.0,
    high: 55.0,
    steps: 1e3,
    allowed: "0 to 55, in steps of 0.001",
};
const EEPROM: Scale = Scale {
    what: "a whole number",
    low: 0.0,
    high: 255.0,
    steps: 1.0,
    allowed: "0 to 255, the bits of 3099",
};
const TOOL: Scale =
    Scale { what: "a whole number", low: 0.0, high: 65535.0, steps: 1.0, allowed: "0 to 65535, as 3850" };
const SETPOINT: Scale =
    Scale { what: "a whole number", low: 0.0, high: 3000.0, steps: 1.0, allowed: "0 to 3000 (1/min)" };
const LOAD: Scale =
    Scale { what: "a number", low: 0.0, high: 100.0, steps: 10.0, allowed: "0 to 100 (%), in steps of 0.1" };
const ENGINE_ERROR: Scale = Scale {
    what: "the number of an error",
    low: 3000.0,
    high: 3069.0,
    steps: 1.0,
    allowed: "3000 to 3069; the errors above are those of the gateway",
};

/// The time of a step.
pub(super) fn time(key: &str, value: &Value<'_>) -> Result<Microseconds, Problem> {
    number(key, value, &TIME).map(Microseconds)
}

/// What a key says is to be done; what is wrong with it goes to `problems`.
pub(super) fn actions(
    key: &str,
    value: &Value<'_>,
    context: &Context<'_>,
    problems: &mut Vec<Problem>,
) -> Vec<Action> {
    let one = |action: Result<Action, Problem>| action.map(|action| vec![action]);
    let actions = match key {
        "off" => units(key, value, Action::Off),
        "on" => units(key, value, Action::On),
        "reset" => units(key, value, Action::Reset),
        "gateway" => return parameters(key, value, Owner::Gateway, context, problems),
        "governor" => return parameters(key, value, Owner::Governor, context, problems),
        "pc-tool" => one(number(key, value, &TOOL).map(|identifier| Action::Tool(identifier as u16))),
        "read" => return read(key, value, context, problems),
        "store" => units(key, value, Action::Store),
        "supply" => one(number(key, value, &SUPPLY).map(|millivolts| Action::Supply(millivolts as u16))),
        "eeprom" => one(number(key, value, &EEPROM).map(|code| Action::Eeprom(code as u8))),
        "engine" => return engine(key, value, problems),
        "engine-error" => {
            return each(value, problems, |value| engine_error(key, value, Action::EngineError));
        }
        "engine-error-gone" => {
            return each(value, problems, |value| engine_error(key, value, Action::EngineErrorGone));
        }
        "inject" => return each(value, problems, |value| fault(key, value).map(Action::Inject)),
        "remove" => return each(value, problems, |value| lasting(key, value).map(Action::Remove)),
        "clear-errors" => one(clear_errors(key, value)),
        "command" => one(word(key, value, &COMMANDS).map(Action::Command)),
        _ => one(word(key, value, &NMT).map(Action::Nmt)),
    };
    actions.unwrap_or_else(|problem| {
        problems.push(problem);
        Vec::new()
    })
}

/// Reads one value, or each of a list.
fn each(
    value: &Value<'_>,
    problems: &mut Vec<Problem>,
    read: impl Fn(&Value<'_>) -> Result<Action, Problem>,
) -> Vec<Action> {
    let values = match value.get_ref() {
        DeValue::Array(values) => values.iter().collect(),
        _ => vec![value],
    };
    let mut actions = Vec::new();
    for read in values.into_iter().map(read) {
        match read {
            Ok(action) => actions.push(action),
            Err(problem) => problems.push(problem),
        }
    }
    actions
}

fn wrong_type(key: &str, wanted: &str, value: &Value<'_>) -> Problem {
    let message = format!("`{key}` needs {wanted}, and this is {}", what_is(value.get_ref()));
    Problem::at(WRONG_TYPE, place(value), message)
}

fn place(value: &Value<'_>) -> Span {
    span(value.span())
}

/// A number in its steps.
fn number(key: &str, value: &Value<'_>, scale: &Scale) -> Result<u64, Problem> {
    let may_be = format!("it may be {}", scale.allowed);
    let number = match value.get_ref() {
        DeValue::Integer(integer) => {
            i64::from_str_radix(integer.as_str(), integer.radix()).map_or(f64::NAN, |number| number as f64)
        }
        DeValue::Float(float) if scale.steps > 1.0 => float.as_str().parse().unwrap_or(f64::NAN),
        _ => return Err(wrong_type(key, scale.what, value).help(may_be)),
    };
    let steps = number * scale.steps;
    let is_whole = (steps - steps.round()).abs() <= ROUNDING;
    if !(scale.low..=scale.high).contains(&number) || !is_whole {
        let message = format!("`{key}` cannot have this value");
        return Err(Problem::at(OUT_OF_RANGE, place(value), message).help(may_be));
    }
    Ok(steps.round() as u64)
}

/// The meaning of a word.
fn word<T: Copy>(key: &str, value: &Value<'_>, known: &[(&'static str, T)]) -> Result<T, Problem> {
    let all = || known.iter().map(|(word, _)| format!("`{word}`")).collect::<Vec<_>>().join(", ");
    let DeValue::String(text) = value.get_ref() else {
        return Err(wrong_type(key, "a word", value).help(format!("there are {}", all())));
    };
    if let Some((_, meaning)) = known.iter().find(|(word, _)| word == text) {
        return Ok(*meaning);
    }
    let problem = Problem::at(UNKNOWN_WORD, place(value), format!("`{key}` has no `{text}`"));
    Err(match nearest(text, known.iter().map(|(word, _)| *word)) {
        Some(near) => problem.help(format!("did you mean `{near}`?")),
        None => problem.help(format!("there are {}", all())),
    })
}

fn units(key: &str, value: &Value<'_>, action: fn(Owner) -> Action) -> Result<Vec<Action>, Problem> {
    let [gateway, governor] = UNITS;
    let known = [(gateway.0, &UNITS[..1]), (governor.0, &UNITS[1..]), ("both", &UNITS[..])];
    let units = word(key, value, &known)?;
    Ok(units.iter().map(|(_, unit)| action(*unit)).collect())
}

fn fault(key: &str, value: &Value<'_>) -> Result<Fault, Problem> {
    word(key, value, &Fault::ALL.map(|fault| (fault_name(fault), fault)))
}

/// A fault that can be removed.
fn lasting(key: &str, value: &Value<'_>) -> Result<Fault, Problem> {
    let fault = fault(key, value)?;
    if !fault.is_momentary() {
        return Ok(fault);
    }
    let message = format!("`{}` happens and is over, so that nothing is left to remove", fault_name(fault));
    Err(Problem::at(UNKNOWN_WORD, place(value), message).help("leave it out"))
}

fn engine_error(key: &str, value: &Value<'_>, action: fn(u16) -> Action) -> Result<Action, Problem> {
    number(key, value, &ENGINE_ERROR).map(|number| action(number as u16))
}

fn clear_errors(key: &str, value: &Value<'_>) -> Result<Action, Problem> {
    match value.get_ref() {
        DeValue::Boolean(true) => Ok(Action::ClearErrors),
        DeValue::Boolean(false) => {
            let problem = Problem::at(OUT_OF_RANGE, place(value), format!("`{key}` cannot be `false`"));
            Err(problem.help("write `true`, or leave it out"))
        }
        _ => Err(wrong_type(key, "`true`", value).help("write `true`, or leave it out")),
    }
}

fn parameters(
    key: &str,
    value: &Value<'_>,
    owner: Owner,
    context: &Context<'_>,
    problems: &mut Vec<Problem>,
) -> Vec<Action> {
    let DeValue::Table(table) = value.get_ref() else {
        let problem = wrong_type(key, "a table of parameters", value);
        problems.push(problem.help(format!("write `{key} = {{ P400 = 1.0 }}`")));
        return Vec::new();
    };
    let settings = parameters_of(owner, entries(table), context.text, Place::Step, problems);
    problems.extend(settings.iter().filter_map(|(setting, _)| setting.decimal()));
    settings.into_iter().map(|(setting, value)| Action::Set(setting.parameter, value)).collect()
}

/// What `read` names of each unit.
fn read(key: &str, value: &Value<'_>, context: &Context<'_>, problems: &mut Vec<Problem>) -> Vec<Action> {
    let DeValue::Table(table) = value.get_ref() else {
        let problem = wrong_type(key, "a table of units", value);
        problems.push(problem.help(format!("write `{key} = {{ gateway = [2411, 12403] }}`")));
        return Vec::new();
    };
    let mut actions = Vec::new();
    for (name, key_span, value) in entries(table) {
        let Some((_, unit)) = UNITS.into_iter().find(|(word, _)| *word == name) else {
            let words = UNITS.map(|(word, _)| word);
            problems.push(unknown_key(&format!("`{key}`"), name, key_span, &words));
            continue;
        };
        actions.extend(each(value, problems, |value| {
            shown(unit, value, context.signals).map(|number| Action::Read(unit, number))
        }));
    }
    actions
}

fn engine(key: &str, value: &Value<'_>, problems: &mut Vec<Problem>) -> Vec<Action> {
    let DeValue::Table(table) = value.get_ref() else {
        let problem = wrong_type(key, "a table", value);
        problems.push(
            problem.help(format!("write `{key} = {{ setpoint = 1500, load = 50.0, running = true }}`")),
        );
        return Vec::new();
    };
    let mut actions = Vec::new();
    for (name, key_span, value) in entries(table) {
        let action = match name {
            "setpoint" => number(name, value, &SETPOINT).map(|speed| Action::Setpoint(speed as u16)),
            "load" => number(name, value, &LOAD).map(|load| Action::Load(load as u16)),
            "running" => match value.get_ref() {
                DeValue::Boolean(is_running) => Ok(Action::Running(*is_running)),
                _ => Err(wrong_type(name, "`true` or `false`", value)),
            },
            _ => Err(unknown_key(&format!("`{key}`"), name, key_span, &["setpoint", "load", "running"])),
        };
        match action {
            Ok(action) => actions.push(action),
            Err(problem) => problems.push(problem),
        }
    }
    actions
}

/// A key that `whole` has no place for.
pub(super) fn unknown_key(whole: &str, key: &str, place: Span, known: &[&str]) -> Problem {
    let problem = Problem::at(UNKNOWN_KEY, place, format!("{whole} has no `{key}`"));
    let all: Vec<String> = known.iter().map(|key| format!("`{key}`")).collect();
    match (nearest(key, known.iter().copied()), &all[..]) {
        (Some(near), _) => problem.help(format!("did you mean `{near}`?")),
        (None, [only]) => problem.help(format!("there is {only} alone")),
        (None, all) => problem.help(format!("there are {}", all.join(", "))),
    }
}
