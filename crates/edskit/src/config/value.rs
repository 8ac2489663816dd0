//! Values of parameters.

use super::problem::{self, Problem};
use super::typed::number;
use edskit_devices::gateway::{Parameter, Quantity, Values};
use edskit_model::Span;
use toml::de::DeValue;

/// The most that a time in s is off from whole ms before it counts as finer.
const ROUNDING: f64 = 1e-6;

/// A value as the device holds it. `written` is how the file writes it.
pub(super) fn read(
    parameter: Parameter,
    value: &DeValue<'_>,
    span: Span,
    written: &str,
) -> Result<i32, Problem> {
    let in_seconds = parameter.quantity() == Quantity::Seconds;
    let number = match value {
        DeValue::Integer(integer) => {
            let number = i64::from_str_radix(integer.as_str(), integer.radix()).ok();
            let number = number.and_then(|number| number.checked_mul(if in_seconds { 1000 } else { 1 }));
            number.and_then(|number| i32::try_from(number).ok())
        }
        DeValue::Float(float) if in_seconds => {
            let milliseconds = float.as_str().parse().unwrap_or(f64::NAN) * 1000.0;
            if (milliseconds - milliseconds.round()).abs() > ROUNDING {
                let message = format!("{parameter} is given in s, in steps of 0.001 s");
                let help = allowed(parameter);
                return Err(Problem::at(problem::OUT_OF_RANGE, span, message).help(help));
            }
            (milliseconds.abs() < f64::from(i32::MAX)).then_some(milliseconds.round() as i32)
        }
        _ => return Err(wrong_type(parameter, value, span, written)),
    };
    let allowed = number.filter(|number| parameter.values().contain(*number));
    allowed.ok_or_else(|| out_of_range(parameter, number, span))
}

/// A number that the parameter cannot be, where it is one that the device can hold.
pub(super) fn out_of_range(parameter: Parameter, number: Option<i32>, span: Span) -> Problem {
    let message = match number {
        Some(number) => format!("{parameter} cannot be {}", parameter.amount(number)),
        None => format!("{parameter} cannot have this value"),
    };
    Problem::at(problem::OUT_OF_RANGE, span, message).help(allowed(parameter))
}

/// What a parameter may be, identifiers as TOML writes them.
pub(super) fn allowed(parameter: Parameter) -> String {
    match (parameter.quantity(), parameter.values()) {
        (Quantity::Identifier, Values::Between(low, high)) => {
            format!("it may be 0x{low:03X} to 0x{high:03X}")
        }
        _ => format!("it may be {}", parameter.allowed()),
    }
}

/// Words for the type of a value.
pub(crate) fn what_is(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) => "a whole number",
        DeValue::Float(_) => "a number with a decimal point",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date or time",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}

fn wrong_type(parameter: Parameter, value: &DeValue<'_>, span: Span, written: &str) -> Problem {
    let what = what_is(value);
    let wanted =
        if parameter.quantity() == Quantity::Seconds { "a number of seconds" } else { "a whole number" };
    let problem =
        Problem::at(problem::WRONG_TYPE, span, format!("{parameter} needs {wanted}, and this is {what}"));
    match meant(parameter, value, written) {
        Some(meant) => problem.help(format!("write {meant}")),
        None => problem.help(allowed(parameter)),
    }
}

/// What was probably meant by a value of the wrong type.
fn meant(parameter: Parameter, value: &DeValue<'_>, written: &str) -> Option<String> {
    if matches!(value, DeValue::Array(_) | DeValue::Table(_) | DeValue::Datetime(_)) {
        return None;
    }
    let meanings = number::read(parameter, written).meanings;
    let texts = meanings.iter().map(|meaning| {
        let text = format!("`{}`", meaning.toml(parameter));
        if meaning.only_if.is_empty() { text } else { format!("{text} if {}", meaning.only_if) }
    });
    let texts: Vec<String> = texts.collect();
    (!texts.is_empty()).then(|| texts.join(", or "))
}
