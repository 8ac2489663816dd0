//! How a parameter is named in a file: `427`, `P427`, `CanOpenMyNodeID`, or number and name together.

use super::problem::{self, Problem};
use edskit_devices::gateway::{Owner, Parameter, measured_value, measured_value_by_name, parameters};
use edskit_lint::{Severity, nearest};
use edskit_model::Span;

/// How far a number may be from that of the parameter that was meant.
const NEIGHBOURS: u16 = 5;

/// What a key says.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Key<'a> {
    /// Digits, without leading zeros.
    number: Option<&'a str>,
    name: Option<&'a str>,
}

impl<'a> Key<'a> {
    fn of(text: &'a str) -> Self {
        let text = text.trim();
        let starts_with_digit = |text: &str| text.starts_with(|character: char| character.is_ascii_digit());
        let body = text.strip_prefix(['P', 'p']).filter(|body| starts_with_digit(body)).unwrap_or(text);
        if !starts_with_digit(body) {
            return Self { number: None, name: Some(text) };
        }
        let end = body.find(|character: char| !character.is_ascii_digit()).unwrap_or(body.len());
        let (digits, rest) = body.split_at(end);
        let name = rest.trim_start_matches([' ', '_', '-']);
        let digits = digits.trim_start_matches('0');
        Self {
            number: Some(if digits.is_empty() { "0" } else { digits }),
            name: (!name.is_empty()).then_some(name),
        }
    }
}

/// The number and the name, if the key gives one, of a parameter of the governor that need not be in the table.
pub(super) fn signal(text: &str) -> Option<u16> {
    let number = Key::of(text).number?.parse().ok()?;
    (number != 0).then_some(number)
}

/// The parameter that a key names.
pub(super) fn parameter(owner: Owner, text: &str, span: Span) -> Result<Parameter, Problem> {
    let key = Key::of(text);
    let Some(digits) = key.number else {
        let name = key.name.unwrap_or_default();
        return Parameter::by_name(owner, name).ok_or_else(|| unknown_name(owner, name, span));
    };
    let number: Option<u16> = digits.parse().ok();
    let found = number.and_then(|number| Parameter::find(owner, number));
    let parameter = found.ok_or_else(|| unknown_number(owner, digits, number, span))?;
    match key.name {
        Some(name) => agreeing(parameter, name, span),
        None => Ok(parameter),
    }
}

/// The parameter of a number, if its name is the one that stands beside the number.
fn agreeing(parameter: Parameter, name: &str, span: Span) -> Result<Parameter, Problem> {
    // The manual does not name every parameter of the governor; what stands there may be right.
    let Some(own) = parameter.name().map(|own| own.to_string()) else { return Ok(parameter) };
    let named = Parameter::by_name(parameter.owner(), name);
    if own.eq_ignore_ascii_case(name) || named == Some(parameter) {
        return Ok(parameter);
    }
    let number = parameter.number();
    let problem = Problem::at(
        problem::NAME_NUMBER_MISMATCH,
        span,
        format!("parameter {number} {} is not called `{name}`", whose(parameter.owner())),
    );
    Err(match named {
        Some(other) => problem.help(format!(
            "write `P{number}` for {own}, or `P{}` for {name}: which one is meant?",
            other.number()
        )),
        None => problem.help(format!("its name is `{own}`; the number alone is enough, `P{number}`")),
    })
}

fn unknown_number(owner: Owner, digits: &str, number: Option<u16>, span: Span) -> Problem {
    let at = |kind, message| Problem::at(kind, span, message);
    if let Some(name) = number.and_then(measured_value).filter(|_| owner == Owner::Gateway) {
        return measured(digits, name, span);
    }
    let unknown = at(problem::UNKNOWN_PARAMETER, format!("there is no parameter {digits} {}", whose(owner)));
    if let Some(other) = number.and_then(|number| Parameter::find(other(owner), number)) {
        return unknown.help(elsewhere(other));
    }
    let near = number.and_then(|number| near(owner, digits, number));
    match (owner, near) {
        (Owner::Gateway, Some(near)) => unknown.help(format!("did you mean {near}?")),
        (Owner::Gateway, None) => unknown,
        (Owner::Governor, near) => unknown_of_governor(unknown, near),
    }
}

/// The parameter whose number is close by, or looks much the same.
fn near(owner: Owner, digits: &str, number: u16) -> Option<Parameter> {
    let away = |parameter: &Parameter| parameter.number().abs_diff(number);
    let next = of(owner).min_by_key(away).filter(|parameter| away(parameter) <= NEIGHBOURS);
    let similar = || {
        let numbers: Vec<String> = of(owner).map(|parameter| parameter.number().to_string()).collect();
        let as_long = numbers.iter().map(String::as_str).filter(|other| other.len() == digits.len());
        let similar = nearest(digits, as_long)?;
        Parameter::find(owner, similar.parse().ok()?)
    };
    next.or_else(similar)
}

fn unknown_name(owner: Owner, name: &str, span: Span) -> Problem {
    if let Some(number) = measured_value_by_name(name).filter(|_| owner == Owner::Gateway) {
        return measured(&number.to_string(), name, span);
    }
    let message = format!("there is no parameter `{name}` {}", whose(owner));
    let unknown = Problem::at(problem::UNKNOWN_PARAMETER, span, message);
    if let Some(other) = Parameter::by_name(other(owner), name) {
        return unknown.help(elsewhere(other));
    }
    let names: Vec<String> =
        of(owner).filter_map(|parameter| parameter.name()).map(|name| name.to_string()).collect();
    match (nearest(name, names.iter().map(String::as_str)), owner) {
        (Some(near), _) => unknown.help(format!("did you mean `{near}`?")),
        (None, Owner::Gateway) => unknown,
        (None, Owner::Governor) => unknown_of_governor(unknown, None),
    }
}

/// A governor has many parameters that have nothing to do with the gateway.
fn unknown_of_governor(unknown: Problem, near: Option<Parameter>) -> Problem {
    let near = near.map(|near| format!(", unless {near} was meant")).unwrap_or_default();
    let help =
        format!("the manual of the gateway names none; nothing follows from it here, so leave it out{near}");
    unknown.severity(Severity::Warning).help(help)
}

fn measured(number: &str, name: &str, span: Span) -> Problem {
    let message = format!("{number} {name} is a value that the gateway measures, and not a parameter");
    Problem::at(problem::MEASURED_VALUE, span, message).help("leave it out: it cannot be set")
}

fn elsewhere(parameter: Parameter) -> String {
    let (whose, table) = match parameter.owner() {
        Owner::Gateway => ("gateway", "[gateway]"),
        Owner::Governor => ("governor", "[governor]"),
    };
    format!("{parameter} is a parameter of the {whose}: write it in `{table}`")
}

fn of(owner: Owner) -> impl Iterator<Item = Parameter> {
    parameters().filter(move |parameter| parameter.owner() == owner)
}

const fn other(owner: Owner) -> Owner {
    match owner {
        Owner::Gateway => Owner::Governor,
        Owner::Governor => Owner::Gateway,
    }
}

const fn whose(owner: Owner) -> &'static str {
    match owner {
        Owner::Gateway => "of the gateway",
        Owner::Governor => "of the governor",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names_are_told_apart() {
        let key = |number, name| Key { number, name };
        for (text, expected) in [
            ("427", key(Some("427"), None)),
            ("P427", key(Some("427"), None)),
            ("p0427", key(Some("427"), None)),
            ("CanOpenMyNodeID", key(None, Some("CanOpenMyNodeID"))),
            ("PowerSupply", key(None, Some("PowerSupply"))),
            ("427 CanOpenMyNodeID", key(Some("427"), Some("CanOpenMyNodeID"))),
            ("P16404_CanOpTPDO5-16ID(0)", key(Some("16404"), Some("CanOpTPDO5-16ID(0)"))),
            ("P", key(None, Some("P"))),
            ("", key(None, Some(""))),
            ("P0", key(Some("0"), None)),
        ] {
            assert_eq!(Key::of(text), expected, "{text}");
        }
    }

    #[test]
    fn signals_have_numbers_from_1_on() {
        assert_eq!(signal("2000"), Some(2000));
        assert_eq!(signal("P2000 Speed"), Some(2000));
        assert_eq!([signal("0"), signal("65536"), signal("Speed")], [None; 3]);
    }
}
