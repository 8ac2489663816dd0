//! How a parameter is named in a file: `427`, `P427`, `CanOpenMyNodeID`, or number and name together.

use super::problem::{self, Problem};
use edskit_devices::gateway::{
    Owner, Parameter, measured_value, measured_value_by_name, parameters, signal_name,
};
use edskit_lint::{Severity, nearest};
use edskit_model::Span;

/// Where a key stands, so that advice fits there.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Place {
    /// In a table of a parameter file.
    File,
    /// In a step of a scenario.
    Step,
}

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
        let body = text.strip_prefix(['P', 'p']).map(|body| body.trim_start_matches(['.', ' ']));
        let body = body.filter(|body| starts_with_digit(body)).unwrap_or(text);
        if !starts_with_digit(body) {
            return Self { number: None, name: Some(text) };
        }
        let end = body.find(|character: char| !character.is_ascii_digit()).unwrap_or(body.len());
        let (digits, rest) = body.split_at(end);
        let name = rest.trim_start_matches([' ', '\t', '\u{A0}', '_', '-', ':', ';', ',', '.', '"']);
        let digits = digits.trim_start_matches('0');
        Self {
            number: Some(if digits.is_empty() { "0" } else { digits }),
            name: (!name.is_empty()).then_some(name),
        }
    }
}

/// The number of a parameter of the governor that need not be in the table.
pub(super) fn signal(text: &str) -> Option<u16> {
    let number = Key::of(text).number?.parse().ok()?;
    (number != 0).then_some(number)
}

/// The name that a key gives to such a parameter.
pub(super) fn name_of_signal(text: &str) -> Option<&str> {
    let key = Key::of(text);
    key.name.filter(|_| key.number.is_some())
}

/// Whether a key begins with a number.
pub(super) fn has_number(text: &str) -> bool {
    Key::of(text).number.is_some()
}

/// The parameter that a key names.
pub(crate) fn parameter(owner: Owner, text: &str, span: Span, place: Place) -> Result<Parameter, Problem> {
    let key = Key::of(text);
    let Some(digits) = key.number else {
        let name = key.name.unwrap_or_default();
        return Parameter::by_name(owner, name).ok_or_else(|| unknown_name(owner, name, span, place));
    };
    let number: Option<u16> = digits.parse().ok();
    let found = number.and_then(|number| Parameter::find(owner, number));
    let parameter = found.ok_or_else(|| unknown_number(owner, digits, number, span, place))?;
    match key.name {
        Some(name) => agreeing(parameter, name, span),
        None => Ok(parameter),
    }
}

/// The parameter of a number, if its name is the one that stands beside the number.
fn agreeing(parameter: Parameter, name: &str, span: Span) -> Result<Parameter, Problem> {
    let number = parameter.number();
    let named = Parameter::by_name(parameter.owner(), name);
    let own = match (parameter.name(), named) {
        _ if parameter.is_called(name) => return Ok(parameter),
        // The manual does not name every parameter of the governor; what stands there may be right.
        (None, None) => return Ok(parameter),
        (None, Some(_)) => format!("the parameter {number}"),
        (Some(own), _) => own.to_string(),
    };
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

fn unknown_number(owner: Owner, digits: &str, number: Option<u16>, span: Span, place: Place) -> Problem {
    let at = |kind, message| Problem::at(kind, span, message);
    if let Some(name) = number.and_then(measured_value).filter(|_| owner == Owner::Gateway) {
        return measured(digits, name, span, place);
    }
    let unknown = at(problem::UNKNOWN_PARAMETER, format!("there is no parameter {digits} {}", whose(owner)));
    let other = number.and_then(|number| Parameter::find(other(owner), number));
    let near = number.filter(|_| other.is_none()).and_then(|number| near(owner, digits, number));
    match (owner, other, near) {
        (Owner::Gateway, Some(other), _) => unknown.help(elsewhere(other, place)),
        (Owner::Gateway, None, Some(near)) => unknown.help(format!("did you mean {near}?")),
        (Owner::Gateway, None, None) => unknown,
        (Owner::Governor, other, near) => {
            let name = number.and_then(signal_name).map(|name| format!(" {name}")).unwrap_or_default();
            unknown_of_governor(unknown, &format!("{digits}{name}"), other, near, place)
        }
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

fn unknown_name(owner: Owner, name: &str, span: Span, place: Place) -> Problem {
    if let Some(number) = measured_value_by_name(name).filter(|_| owner == Owner::Gateway) {
        return measured(&number.to_string(), name, span, place);
    }
    let message = format!("there is no parameter `{name}` {}", whose(owner));
    let unknown = Problem::at(problem::UNKNOWN_PARAMETER, span, message);
    let other = Parameter::by_name(other(owner), name);
    if let (Owner::Gateway, Some(other)) = (owner, other) {
        return unknown.help(elsewhere(other, place));
    }
    let names: Vec<String> =
        of(owner).filter_map(|parameter| parameter.name()).map(|name| name.to_string()).collect();
    let near = nearest(name, names.iter().map(String::as_str)).filter(|_| other.is_none());
    match (near, owner) {
        (Some(near), Owner::Gateway) => unknown.help(format!("did you mean `{near}`?")),
        (None, Owner::Gateway) => unknown,
        (near, Owner::Governor) => {
            let near = near.and_then(|near| Parameter::by_name(owner, near));
            unknown_of_governor(unknown, name, other, near, place)
        }
    }
}

/// A governor has many parameters that have nothing to do with the gateway, some under a number that the gateway has too
/// (GW-GAP-15).
fn unknown_of_governor(
    unknown: Problem,
    name: &str,
    other: Option<Parameter>,
    near: Option<Parameter>,
    place: Place,
) -> Problem {
    let (unless, brief) = match (other, near) {
        (Some(other), _) => {
            let brief = format!("{name} ({other} of the gateway?)");
            (format!("; {}, if that was meant", elsewhere(other, place)), brief)
        }
        (None, Some(near)) => (format!(", unless {near} was meant"), format!("{name} ({near}?)")),
        (None, None) => (String::new(), name.to_owned()),
    };
    let unknown = unknown.severity(Severity::Warning).brief(brief);
    unknown.help(format!("{NOTHING_FOLLOWS}, so leave it out{unless}"))
}

/// What there is to say of a parameter that is not known of the governor.
const NOTHING_FOLLOWS: &str = "the manual of the gateway names none; nothing follows from it here";

/// All parameters that are not known of the governor as one, so that a full list of them does not hide the rest.
pub(crate) fn unknown_in_one(problems: Vec<Problem>) -> Vec<Problem> {
    let message = |count| {
        format!("the manual of the gateway does not name {count} of these parameters of the governor")
    };
    problem::merged(problems, message, "nothing follows from them here; they may stay or be left out")
}

fn measured(number: &str, name: &str, span: Span, place: Place) -> Problem {
    let message = format!("{number} {name} is a value that the gateway measures, and not a parameter");
    let help = match place {
        Place::File => "leave it out: it cannot be set".to_owned(),
        Place::Step => format!("it cannot be set; `read = {{ gateway = [{number}] }}` reads it"),
    };
    Problem::at(problem::MEASURED_VALUE, span, message).help(help)
}

fn elsewhere(parameter: Parameter, place: Place) -> String {
    let whose = match parameter.owner() {
        Owner::Gateway => "gateway",
        Owner::Governor => "governor",
    };
    let table = match place {
        Place::File => format!("[{whose}]"),
        Place::Step => format!("{whose} = {{ .. }}"),
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
            ("P 427", key(Some("427"), None)),
            ("P. 427: CanOpenMyNodeID", key(Some("427"), Some("CanOpenMyNodeID"))),
        ] {
            assert_eq!(Key::of(text), expected, "{text}");
        }
    }

    #[test]
    fn signals_have_numbers_from_1_on() {
        assert_eq!(signal("2000"), Some(2000));
        assert_eq!(signal("P2000 Speed"), Some(2000));
        assert_eq!([name_of_signal("2000 Speed"), name_of_signal("2000")], [Some("Speed"), None]);
        assert_eq!([signal("0"), signal("65536"), signal("Speed")], [None; 3]);
    }
}
