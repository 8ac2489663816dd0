//! Values of parameters.

use super::problem::{self, Problem};
use edskit_devices::gateway::{Parameter, Quantity, Values};
use edskit_model::Span;
use toml::de::DeValue;

/// The most that a time in s is off from whole ms before it counts as finer.
const ROUNDING: f64 = 1e-6;

/// A value as the device holds it.
pub(super) fn read(parameter: Parameter, value: &DeValue<'_>, span: Span) -> Result<i32, Problem> {
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
        _ => return Err(wrong_type(parameter, value, span)),
    };
    match number.filter(|number| parameter.values().contain(*number)) {
        Some(number) => Ok(number),
        None => {
            let message = match number {
                Some(number) => format!("{parameter} cannot be {}", parameter.amount(number)),
                None => format!("{parameter} cannot have this value"),
            };
            let help = allowed(parameter);
            Err(Problem::at(problem::OUT_OF_RANGE, span, message).help(help))
        }
    }
}

/// What a parameter may be, identifiers as TOML writes them.
fn allowed(parameter: Parameter) -> String {
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

fn wrong_type(parameter: Parameter, value: &DeValue<'_>, span: Span) -> Problem {
    let what = what_is(value);
    let wanted =
        if parameter.quantity() == Quantity::Seconds { "a number of seconds" } else { "a whole number" };
    let problem =
        Problem::at(problem::WRONG_TYPE, span, format!("{parameter} needs {wanted}, and this is {what}"));
    match meant(parameter, value) {
        Some(meant) => problem.help(format!("write `{meant}`")),
        None => problem.help(allowed(parameter)),
    }
}

/// What was probably meant by a value of the wrong type.
fn meant(parameter: Parameter, value: &DeValue<'_>) -> Option<String> {
    match value {
        DeValue::Boolean(flag) if !parameter.values().contain(2) => Some(u8::from(*flag).to_string()),
        DeValue::Float(float) => {
            let digits = float.as_str().strip_suffix(".0")?;
            digits.parse::<i32>().ok().map(|number| number.to_string())
        }
        DeValue::String(text) if parameter.quantity() == Quantity::Identifier => {
            let digits = text.trim().trim_end_matches(['h', 'H']);
            let digits = digits.strip_prefix("0x").unwrap_or(digits);
            let number = i32::from_str_radix(digits, 16).ok()?;
            parameter.values().contain(number).then(|| format!("0x{number:X}"))
        }
        DeValue::String(text) => {
            let number = text.trim().parse().ok()?;
            parameter.values().contain(number).then(|| number.to_string())
        }
        _ => None,
    }
}
