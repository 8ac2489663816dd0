//! Identifiers that are not written in hexadecimal digits, as the manual and the PC tool show them.

use super::problem::{self, Problem};
use super::reading::{Reading, Setting};
use edskit_devices::gateway::{Amount, Parameter, Quantity};
use edskit_lint::Label;

/// Such an identifier.
pub(super) struct Decimal {
    pub(super) parameter: Parameter,
    value: i32,
    radix: u32,
    /// What the same digits are in hexadecimal, where the parameter can be that.
    other: Option<i32>,
}

impl Decimal {
    /// Every one that the file has.
    pub(super) fn all(reading: &Reading) -> impl Iterator<Item = Self> {
        reading.settings().iter().filter_map(Self::of_setting)
    }

    /// That of a parameter.
    pub(super) fn of(reading: &Reading, parameter: Parameter) -> Option<Self> {
        reading.setting(parameter).and_then(Self::of_setting)
    }

    pub(super) fn of_setting(setting: &Setting) -> Option<Self> {
        let Setting { parameter, value, radix, .. } = *setting;
        // Up to 9 all notations are the same, but for one that has a prefix of its own.
        let is_clear = radix == 16 || (radix == 10 && value <= 9);
        if parameter.quantity() != Quantity::Identifier || is_clear {
            return None;
        }
        let digits = match radix {
            2 => format!("b{value:b}"),
            10 => value.to_string(),
            _ => return Some(Self { parameter, value, radix, other: None }),
        };
        let other =
            i32::from_str_radix(&digits, 16).ok().filter(|number| parameter.values().contain(*number));
        Some(Self { parameter, value, radix, other })
    }

    /// What there is to say where no rule is run into.
    pub(super) fn problem(&self, place: Label) -> Problem {
        let (parameter, digits) = (self.parameter, self.digits());
        let message = format!("{parameter} is written in {digits} digits, and is {}", self.amount());
        Problem::new(problem::DECIMAL_IDENTIFIER, place, message).help(self.help())
    }

    fn digits(&self) -> &'static str {
        match self.radix {
            2 => "binary",
            8 => "octal",
            _ => "decimal",
        }
    }

    fn amount(&self) -> Amount {
        self.parameter.amount(self.value)
    }

    /// What to write, whichever of the two is meant.
    fn help(&self) -> String {
        let value = self.value;
        match self.other {
            Some(number) => {
                format!(
                    "write `0x{value:X}`, or `0x{number:X}` if the {number:X}h of the manual's notation is meant"
                )
            }
            None => format!("write `0x{value:X}`"),
        }
    }

    /// The same where the number as it is runs into another rule, so that the other meaning comes first.
    pub(super) fn help_first(&self) -> String {
        let (value, digits) = (self.value, self.digits());
        match self.other {
            Some(number) => format!(
                "it is written in {digits} digits: write `0x{number:X}` if the {number:X}h of the manual's notation is meant, or `0x{value:X}` if {} is",
                self.amount()
            ),
            None => format!("it is written in {digits} digits: `0x{value:X}` says the same"),
        }
    }
}
