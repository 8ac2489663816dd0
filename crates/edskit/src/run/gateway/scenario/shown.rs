//! What the PC tool can read: numbers and names of parameters and measured values.

use super::value::Value;
use super::words::{UNITS, word_for};
use crate::config::problem::{Problem, UNKNOWN_PARAMETER, WRONG_TYPE};
use crate::config::{KnownSignals, span, what_is};
use edskit_devices::gateway::{
    MEASURED_VALUES, Owner, Parameter, measured_value, measured_value_by_name, signal_name,
};
use edskit_lint::{Severity, nearest};
use toml::de::DeValue;

/// The only measured value that the manual lists and nowhere describes (GW-NOTE-40).
const UNDESCRIBED: u16 = 2406;

/// The number of something that a unit shows, written as a number, a name, or both.
pub(super) fn shown(unit: Owner, value: &Value<'_>, signals: &KnownSignals) -> Result<u16, Problem> {
    let place = span(value.span());
    let written = match value.get_ref() {
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().to_owned(),
        DeValue::String(text) => text.trim().to_owned(),
        other => {
            let message = format!("a value is read by its number, and this is {}", what_is(other));
            return Err(
                Problem::at(WRONG_TYPE, place, message).help("write `2411`, or `\"CanDCNodeState15to01\"`")
            );
        }
    };
    let body = written.strip_prefix(['P', 'p']).unwrap_or(&written);
    let digits = body.split(|character: char| !character.is_ascii_digit()).next().unwrap_or_default();
    let number = match digits.is_empty() {
        true => by_name(unit, &written),
        false => digits.parse().ok().filter(|number| is_shown(unit, *number, signals)),
    };
    number.ok_or_else(|| {
        let whose = word_for(&UNITS, unit);
        let message = format!("the {whose} shows nothing under `{written}`");
        let problem = Problem::at(UNKNOWN_PARAMETER, place, message);
        let digits = digits.parse().ok();
        let problem = match (unit, digits) {
            (_, Some(UNDESCRIBED)) => {
                problem.help("the manual lists it without a description, so that it has no value here")
            }
            (unit, Some(number)) if is_shown(other(unit), number, signals) => {
                problem.help(format!("the {} has it", word_for(&UNITS, other(unit))))
            }
            (Owner::Governor, _) => problem
                .help("describe it in `[governor.signals]` of the parameter file, if the governor has it"),
            (Owner::Gateway, Some(_)) => {
                problem.help("docs/gateway.md and 11.3 of the manual list what there is")
            }
            (Owner::Gateway, None) => {
                match nearest(&written, MEASURED_VALUES.iter().map(|(_, name)| *name)) {
                    Some(near) => problem.help(format!("did you mean `{near}`?")),
                    None => problem,
                }
            }
        };
        // Another governor may have it (GW-GAP-15).
        if unit == Owner::Governor { problem.severity(Severity::Warning) } else { problem }
    })
}

fn is_shown(unit: Owner, number: u16, signals: &KnownSignals) -> bool {
    let is_measured = || match unit {
        Owner::Gateway => measured_value(number).is_some() && number != UNDESCRIBED,
        Owner::Governor => signals.knows(number),
    };
    Parameter::find(unit, number).is_some() || is_measured()
}

fn by_name(unit: Owner, name: &str) -> Option<u16> {
    let parameter = Parameter::by_name(unit, name).map(Parameter::number);
    parameter.or_else(|| match unit {
        Owner::Gateway => measured_value_by_name(name).filter(|number| *number != UNDESCRIBED),
        Owner::Governor => {
            let is_it = |number: &u16| {
                signal_name(*number).is_some_and(|own| own.to_string().eq_ignore_ascii_case(name))
            };
            (2000..=12_500).find(is_it)
        }
    })
}

const fn other(unit: Owner) -> Owner {
    match unit {
        Owner::Gateway => Owner::Governor,
        Owner::Governor => Owner::Gateway,
    }
}
