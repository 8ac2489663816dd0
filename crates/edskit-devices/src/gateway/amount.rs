//! Values as the manual writes them.

use super::parameter::{Parameter, Quantity, Values};
use core::fmt;

/// A value with its unit: `100 ms`, `1.0 s`, `282h`, `125 kbit/s`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Amount {
    value: i32,
    quantity: Quantity,
}

/// The values of a parameter with their unit: `1 to 127`, `125, 250, 500 or 1000 kbit/s`.
#[derive(Clone, Copy, Debug)]
pub struct Allowed {
    values: Values,
    quantity: Quantity,
}

impl Parameter {
    /// A value of this parameter with its unit.
    #[must_use]
    pub fn amount(self, value: i32) -> Amount {
        Amount { value, quantity: self.quantity() }
    }

    /// The values that the parameter can have.
    #[must_use]
    pub fn allowed(self) -> Allowed {
        Allowed { values: self.values(), quantity: self.quantity() }
    }
}

impl Amount {
    /// A number of something.
    pub(super) const fn new(value: i32, quantity: Quantity) -> Self {
        Self { value, quantity }
    }

    /// The number, in parts of the unit where [`Quantity::per_unit`] is not 1.
    #[must_use]
    pub const fn value(self) -> i32 {
        self.value
    }

    /// What it is a number of.
    #[must_use]
    pub const fn quantity(self) -> Quantity {
        self.quantity
    }

    /// The number without its unit.
    fn write_number(self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { value, quantity } = self;
        match quantity {
            Quantity::Identifier if value >= 0 => write!(f, "{value:03X}h"),
            Quantity::Bits if value >= 0 => write!(f, "{value:04X}h"),
            Quantity::Seconds | Quantity::Volts | Quantity::FineMilliseconds => {
                let milliseconds = value.unsigned_abs() % 1000;
                let sign = if value < 0 { "-" } else { "" };
                write!(f, "{sign}{}.", value.unsigned_abs() / 1000)?;
                match (milliseconds % 100, milliseconds % 10) {
                    (0, _) => write!(f, "{}", milliseconds / 100),
                    (_, 0) => write!(f, "{:02}", milliseconds / 10),
                    _ => write!(f, "{milliseconds:03}"),
                }
            }
            _ => write!(f, "{value}"),
        }
    }
}

/// The unit with a blank before it.
const fn unit(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Number | Quantity::Identifier | Quantity::Bits => "",
        Quantity::Seconds => " s",
        Quantity::Milliseconds | Quantity::FineMilliseconds => " ms",
        Quantity::Volts => " V",
        Quantity::KbitPerSecond => " kbit/s",
    }
}

impl fmt::Display for Amount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_number(f)?;
        f.write_str(unit(self.quantity))
    }
}

impl fmt::Display for Allowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |value| Amount { value, quantity: self.quantity };
        match self.values {
            Values::Between(low, high) => {
                number(low).write_number(f)?;
                f.write_str(if high - low == 1 { " or " } else { " to " })?;
                number(high).write_number(f)?;
            }
            Values::OneOf(values) => {
                for (nth, value) in values.iter().enumerate() {
                    match values.len() - nth {
                        _ if nth == 0 => {}
                        1 => f.write_str(" or ")?,
                        _ => f.write_str(", ")?,
                    }
                    number(*value).write_number(f)?;
                }
            }
        }
        f.write_str(unit(self.quantity))
    }
}
