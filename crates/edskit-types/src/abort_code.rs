//! Why an SDO transfer was refused.

use core::fmt;

/// Abort code of an SDO transfer (CiA 301 v4.2, 7.2.4.3.17).
///
/// Every `u32` is an abort code: devices may send codes of their own, and a client has to show them.
///
/// ```
/// use edskit_types::AbortCode;
///
/// assert_eq!(AbortCode::OBJECT_DOES_NOT_EXIST, AbortCode(0x0602_0000));
/// assert_eq!(AbortCode(0x0602_0000).to_string(), "06020000h: object does not exist");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct AbortCode(pub u32);

macro_rules! abort_codes {
    ($($name:ident = $code:literal, $text:literal;)*) => {
        impl AbortCode {
            $(
                #[doc = concat!("`", stringify!($code), "`: ", $text, ".")]
                pub const $name: AbortCode = AbortCode($code);
            )*

            /// What the standard says the code means; `None` for a code that it does not know.
            #[must_use]
            pub const fn meaning(self) -> Option<&'static str> {
                match self.0 {
                    $($code => Some($text),)*
                    _ => None,
                }
            }
        }
    };
}

abort_codes! {
    TOGGLE_BIT = 0x0503_0000, "toggle bit not alternated";
    TIME_OUT = 0x0504_0000, "SDO protocol timed out";
    UNKNOWN_COMMAND = 0x0504_0001, "command specifier not valid or unknown";
    INVALID_BLOCK_SIZE = 0x0504_0002, "invalid block size";
    INVALID_SEQUENCE_NUMBER = 0x0504_0003, "invalid sequence number";
    CRC_ERROR = 0x0504_0004, "CRC error";
    OUT_OF_MEMORY = 0x0504_0005, "out of memory";
    UNSUPPORTED_ACCESS = 0x0601_0000, "unsupported access to an object";
    WRITE_ONLY = 0x0601_0001, "attempt to read a write-only object";
    READ_ONLY = 0x0601_0002, "attempt to write a read-only object";
    OBJECT_DOES_NOT_EXIST = 0x0602_0000, "object does not exist";
    NOT_MAPPABLE = 0x0604_0041, "object cannot be mapped to the PDO";
    PDO_LENGTH_EXCEEDED = 0x0604_0042, "mapped objects exceed the length of a PDO";
    PARAMETER_INCOMPATIBLE = 0x0604_0043, "general parameter incompatibility";
    DEVICE_INCOMPATIBLE = 0x0604_0047, "general internal incompatibility in the device";
    HARDWARE_ERROR = 0x0606_0000, "access failed due to a hardware error";
    LENGTH_MISMATCH = 0x0607_0010, "length of the parameter does not match";
    LENGTH_TOO_HIGH = 0x0607_0012, "length of the parameter too high";
    LENGTH_TOO_LOW = 0x0607_0013, "length of the parameter too low";
    SUB_INDEX_DOES_NOT_EXIST = 0x0609_0011, "sub-index does not exist";
    INVALID_VALUE = 0x0609_0030, "invalid value for the parameter";
    VALUE_TOO_HIGH = 0x0609_0031, "value of the parameter written too high";
    VALUE_TOO_LOW = 0x0609_0032, "value of the parameter written too low";
    MAXIMUM_BELOW_MINIMUM = 0x0609_0036, "maximum value is less than the minimum value";
    NO_SDO_CONNECTION = 0x060A_0023, "resource not available: SDO connection";
    GENERAL_ERROR = 0x0800_0000, "general error";
    CANNOT_TRANSFER = 0x0800_0020, "data cannot be transferred or stored to the application";
    LOCAL_CONTROL = 0x0800_0021, "data cannot be transferred or stored because of local control";
    DEVICE_STATE = 0x0800_0022, "data cannot be transferred or stored because of the present device state";
    NO_DICTIONARY = 0x0800_0023, "object dictionary generation failed or no object dictionary is present";
    NO_DATA = 0x0800_0024, "no data available";
}

/// Eight digits and `h`, with the meaning behind a colon where the standard knows it.
impl fmt::Display for AbortCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:08X}h", self.0)?;
        match self.meaning() {
            Some(meaning) => write!(f, ": {meaning}"),
            None => Ok(()),
        }
    }
}

/// `AbortCode(06020000h)`: the bits are unreadable in decimal.
impl fmt::Debug for AbortCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "AbortCode({:08X}h)", self.0)
    }
}

impl core::error::Error for AbortCode {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    #[test]
    fn notation() {
        assert_eq!(format!("{}", AbortCode::TOGGLE_BIT), "05030000h: toggle bit not alternated");
        assert_eq!(format!("{} {:?}", AbortCode(1), AbortCode::NO_DATA), "00000001h AbortCode(08000024h)");
    }
}
