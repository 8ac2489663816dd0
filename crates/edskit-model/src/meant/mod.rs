//! What a value that is written wrongly was meant to be: the second answer, beside "known" and "unknown".
//!
//! Suppliers' files are full of such values, integrators cannot mend them, and most have one meaning only. [`of`] is the
//! one place that knows these spellings: [`Field::known`](crate::Field::known) goes on with what is certain, so that a
//! device can be shown, run, generated and checked, and the fixes of the linter write it. The linter still reports the text.
//!
//! | what is wrong | written | meant |
//! |---|---|---|
//! | a comment or a remark behind the value | `0x0007 ; UNSIGNED32`, `ro # fixed`, `5 (five)` | `0x0007`, `ro`, `5` |
//! | a mark or a quote around it | `0x10;`, `5,`, `"rw"` | `0x10`, `5`, `rw` |
//! | a prefix twice, or one of another language | `0x0x1A`, `$1A`, `16#1A`, `&H1A`, `1Ah` | `0x1A` |
//! | no prefix; in lists of indices and mappings of decimal digits too | `1A00`, `1=2000` | `0x1A00`, `1=0x2000` |
//! | blanks and separators inside | `0x1234 5678`, `1_000`, `10 000` | `0x12345678`, `1000`, `10000` |
//! | letters that look like digits | `Ox1O` | `0x10` |
//! | a formula in another spelling | `NODEID + 180h`, `{NodeID}+0x180` | `$NODEID+0x180` |
//! | a word for an access, a flag, a type, an object code | `R/W`, `yes`, `UNSIGNED8`, `RECORD` | `rw`, `1`, `0x0005`, `0x9` |
//! | a decimal comma, a suffix of C | `1,5`, `1.5f` | `1.5` |
//! | octets with blanks or `0x` | `01 02`, `0x0102` | `0102` |

mod behind;
mod formula;
mod number;
mod words;

pub(crate) use behind::before_comment;
pub use behind::value_length;
pub use formula::{formula, is_hexadecimal};
use number::index;
pub use number::{number, without_prefix};
pub use words::{access, flag};

use crate::value::{Formula, Number, Value};
use edskit_types::{AccessType, DataType, DataTypeKind, ObjectCode};

/// The text that was meant in the place of a malformed one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Slip {
    /// The text as it should be written.
    pub text: String,
    /// What is wrong with the one that stands there.
    pub reason: &'static str,
    /// Whether nothing else can have been meant. What is not certain is an advice to people, and never a value.
    pub certain: bool,
    /// What it may be as well, where that is possible but less likely.
    pub other: Option<String>,
}

/// What has to stand somewhere.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wanted {
    /// A number.
    Number,
    /// The index of an object.
    Index,
    /// The index of a data type.
    DataType,
    /// An object code.
    ObjectCode,
    /// `0` or `1`.
    Flag,
    /// An access type.
    Access,
    /// A value of a data type; `None` for one that is not known.
    Value(Option<DataType>),
}

/// How many things are taken away around a value, one after the other.
const MOST_LAYERS: usize = 4;

/// What `raw`, which is not what is wanted, was meant to be; `None` where nobody can know.
///
/// ```
/// use edskit_model::meant::{Wanted, of};
/// let slip = of(b"0x0007 ; UNSIGNED32", Wanted::DataType).unwrap();
/// assert_eq!((&*slip.text, slip.certain), ("0x0007", true));
/// assert_eq!(of(b"R/W", Wanted::Access).unwrap().text, "rw");
/// assert_eq!(of(b"UNKNOWN", Wanted::Access), None);
/// ```
pub fn of(raw: &[u8], wanted: Wanted) -> Option<Slip> {
    // Comments may hold any bytes, and those who want free text never ask.
    let text = String::from_utf8_lossy(raw);
    unwrapped(text.trim(), wanted, MOST_LAYERS).filter(|slip| wanted.is_met_by(&slip.text))
}

/// Takes away what stands around the text, until it can be read.
fn unwrapped(text: &str, wanted: Wanted, layers: usize) -> Option<Slip> {
    let own = wanted.respelt(text);
    if own.as_ref().is_some_and(|slip| slip.certain) {
        return own;
    }
    for (reason, take) in behind::LAYERS.iter().filter(|_| layers > 0) {
        let Some(rest) = take(text).filter(|rest| rest.len() < text.len() && !rest.is_empty()) else {
            continue;
        };
        if wanted.is_met_by(rest) {
            return Some(Slip { text: rest.to_owned(), reason, certain: true, other: None });
        }
        if let Some(slip) = unwrapped(rest, wanted, layers - 1) {
            return Some(Slip { reason, ..slip });
        }
    }
    own
}

impl Wanted {
    /// Whether a text is what is wanted.
    fn is_met_by(self, text: &str) -> bool {
        let raw = text.as_bytes();
        let number = || Number::parse(raw).ok();
        match self {
            Self::Number | Self::Index | Self::DataType => number().is_some(),
            Self::ObjectCode => number().and_then(Number::to).and_then(ObjectCode::from_code).is_some(),
            Self::Flag => number().is_some_and(|number| matches!(number.to::<u64>(), Some(0 | 1))),
            Self::Access => AccessType::parse(raw).is_some(),
            Self::Value(Some(data_type)) => Value::parse(data_type, raw).is_ok(),
            Self::Value(None) => number().is_some() || Formula::parse(raw).is_ok(),
        }
    }

    /// What a text without anything around it was meant to be.
    fn respelt(self, text: &str) -> Option<Slip> {
        let word =
            |word: Option<String>, reason| word.map(|text| Slip { text, reason, certain: true, other: None });
        match self {
            Self::Number => number(text),
            Self::Index => index(text),
            Self::DataType => {
                let named = words::data_type(text).or_else(|| words::data_type_twice(text));
                word(named, "a data type is given by its index").or_else(|| index(text))
            }
            Self::ObjectCode => {
                word(words::object_code(text), "an object code is a number").or_else(|| number(text))
            }
            Self::Flag => word(flag(text).map(str::to_owned), "a flag is 0 or 1").or_else(|| number(text)),
            Self::Access => {
                word(access(text).map(|access| access.as_str().to_owned()), "the access types are six words")
            }
            Self::Value(data_type) => match data_type.map(DataType::kind) {
                Some(DataTypeKind::Boolean) => {
                    word(words::boolean(text).map(str::to_owned), "a BOOLEAN is 0 or 1")
                        .or_else(|| number(text))
                }
                Some(DataTypeKind::Real) => word(number::real(text), "a real number has a decimal point"),
                Some(DataTypeKind::OctetString | DataTypeKind::Domain) => {
                    word(number::octets(text), "octets are pairs of hexadecimal digits and nothing else")
                }
                Some(DataTypeKind::Signed | DataTypeKind::Unsigned) | None => {
                    let formula = formula(text.as_bytes()).map(|formula| formula.to_string());
                    word(formula, "the node-ID is written `$NODEID`").or_else(|| number(text))
                }
                Some(_) => None,
            },
        }
    }
}

#[cfg(test)]
mod tests;
