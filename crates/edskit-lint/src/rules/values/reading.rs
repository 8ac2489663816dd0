//! What a literal can mean to the readers in use, and which values a variable has.

use crate::evaluate::commissioned;
use crate::{Context, Variable};
use core::fmt;
use edskit_model::meant::value_length;
use edskit_model::{Entry, Field, KeyName, Radix, Section, SectionKind, Value};
use edskit_types::{DataType, Index, NodeId};

/// One meaning of a literal. All values of one data type are of one variant, so they compare.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub(super) enum Scalar {
    /// An integer.
    Integer(i128),
    /// A real number.
    Real(f64),
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Integer(value) => value.fmt(f),
            // Most digits of a very large or very small number would be zeros that say nothing.
            Self::Real(value) if *value != 0.0 && !(1e-5..1e16).contains(&value.abs()) => {
                match *value as f32 {
                    short if f64::from(short) == *value => fmt::LowerExp::fmt(&short, f),
                    _ => fmt::LowerExp::fmt(value, f),
                }
            }
            // The shortest text that a REAL32 reads back, where the value is one.
            Self::Real(value) if f64::from(*value as f32) == *value => (*value as f32).fmt(f),
            Self::Real(value) => value.fmt(f),
        }
    }
}

/// The two meanings of a literal. They differ for hexadecimal literals alone: of a signed type where the top bit is
/// set, and of a REAL.
///
/// CiA 306 does not say which one counts. Tools in use differ, and some read limits one way and defaults the other.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Readings {
    /// As a number.
    pub(super) as_written: Scalar,
    /// As the bits of the data type: two's complement, IEEE 754.
    pub(super) as_bits: Scalar,
}

impl Readings {
    /// The readings of a value of a numeric data type, for a node-ID if it is a formula. `None` for other types and for
    /// sums above 64 bits.
    pub(super) fn of(value: Value<'_>, data_type: DataType, node_id: NodeId) -> Option<Self> {
        let integer = |as_written: i128, as_bits: Option<i128>| Self {
            as_written: Scalar::Integer(as_written),
            as_bits: Scalar::Integer(as_bits.unwrap_or(as_written)),
        };
        let real = |as_written: f64, as_bits: f64| {
            // Two spellings of one REAL32 must be equal, so neither keeps more digits than the device does.
            let round =
                |value: f64| if data_type == DataType::Real32 { f64::from(value as f32) } else { value };
            Self { as_written: Scalar::Real(round(as_written)), as_bits: Scalar::Real(round(as_bits)) }
        };
        let signed_bits = data_type.bits().filter(|_| data_type.is_signed());
        match value {
            Value::Integer(number) => {
                Some(integer(number.value(), signed_bits.and_then(|bits| number.twos_complement(bits))))
            }
            Value::Formula(formula) => {
                let sum = i128::from(formula.evaluate(node_id)?);
                let bits = signed_bits.filter(|bits| !formula.style().decimal && sum >> (bits - 1) == 1);
                Some(integer(sum, bits.map(|bits| sum - (1 << bits))))
            }
            Value::Real(value) => Some(real(value, value)),
            Value::RealBits(bits) => Some(real(bits as f64, value.real(data_type)?)),
            _ => None,
        }
    }

    /// Both readings, the one that devices take first.
    pub(super) fn all(self) -> [Scalar; 2] {
        [self.as_bits, self.as_written]
    }

    /// Whether readers differ.
    pub(super) fn is_ambiguous(self) -> bool {
        self.as_written != self.as_bits
    }
}

/// The node-IDs that formulas are tried with: the one that a DCF commissions, else the lowest and the highest.
pub(super) fn node_ids(context: &Context<'_>) -> [NodeId; 2] {
    match commissioned(context) {
        Some(node_id) => [node_id; 2],
        None => [NodeId::MIN, NodeId::MAX],
    }
}

/// Whether one reading of an integer or real value lies in its integer or real data type. A value that is neither
/// does.
#[inline]
pub(super) fn fits(value: Value<'_>, data_type: DataType, node_id: NodeId) -> bool {
    let Some(bits) = data_type.bits().map(u32::from) else { return true };
    // Hexadecimal literals of signed types may use the bit of the sign.
    let fits = |value: u64, is_hex: bool| {
        let width = if data_type.is_signed() && !is_hex { bits - 1 } else { bits };
        value.checked_shr(width).is_none_or(|rest| rest == 0)
    };
    match value {
        Value::Integer(number) => match number.to::<u64>() {
            Some(value) => fits(value, number.radix() == Radix::Hexadecimal),
            None => data_type.range().is_none_or(|(low, _)| number.value() >= low),
        },
        Value::Formula(formula) => {
            formula.evaluate(node_id).is_some_and(|sum| fits(sum, !formula.style().decimal))
        }
        // The bits of a hexadecimal REAL were counted when it was read, and infinities are written on purpose.
        Value::Real(real) => data_type != DataType::Real32 || !real.is_finite() || (real as f32).is_finite(),
        _ => true,
    }
}

/// What a typed value is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Role {
    /// DefaultValue, ParameterValue, or an entry of `[xxxxValue]`.
    Value,
    /// LowLimit or HighLimit.
    Limit,
}

/// Shows `visit` every typed value of a variable, those of `[xxxxValue]` included (CiA 306 v1.3, 5.3.3.2).
///
/// An ARRAY or RECORD that is not compact has no value of its own; whatever its section says is not looked at.
#[inline]
pub(super) fn each_value<'a>(
    context: &'a Context<'_>,
    variable: &Variable<'a>,
    mut visit: impl FnMut(Role, Field<'a, Value<'a>>),
) {
    if !variable.holds_value() {
        if !is_compact(variable) {
            return;
        }
        let list = context.sheet.section(SectionKind::CompactValues(variable.index));
        for entry in list.into_iter().flat_map(|list| list.all_numbered(KeyName::Item)) {
            if !entry.is_empty() {
                visit(Role::Value, entry.value(variable.standard_type));
            }
        }
    }
    // One after the other rather than in a loop: most variables lack most of them, and a loop would copy all four.
    if let Some(field) = variable.default_value {
        visit(Role::Value, field);
    }
    if let Some(field) = variable.parameter_value {
        visit(Role::Value, field);
    }
    if let Some(field) = variable.low_limit {
        visit(Role::Limit, field);
    }
    if let Some(field) = variable.high_limit {
        visit(Role::Limit, field);
    }
}

/// Whether the variable is an object with CompactSubObj, whose section describes its elements.
pub(super) fn is_compact(variable: &Variable<'_>) -> bool {
    variable.sub_index.is_none()
        && variable.data_type.is_some()
        && variable.description.compact_sub_obj().and_then(Field::known).is_some_and(|count| count > 0)
}

/// Whether other rules own what is wrong with the text: a formula or an inline comment.
pub(super) fn is_owned_elsewhere(raw: &[u8]) -> bool {
    is_formula(raw) || value_length(raw).is_some()
}

/// Whether a text that is no integer speaks of the node-ID. `$` alone may begin a hexadecimal number.
pub(super) fn is_formula(raw: &[u8]) -> bool {
    raw.contains(&b'$') && raw.windows(5).any(|word| word.eq_ignore_ascii_case(b"$NODE"))
}

/// How messages call an entry.
pub(super) fn name(entry: Entry<'_>) -> String {
    match entry.key().name {
        KeyName::Item => {
            let list = entry.section().map(Section::name).unwrap_or_default();
            format!("value {} of `[{list}]`", entry.key().number)
        }
        KeyName::DefaultValue | KeyName::ParameterValue if is_of_data_type(entry) => {
            format!("the limit `[{}]`", entry.section().map(Section::name).unwrap_or_default())
        }
        name => format!("`{}`", name.spelling()),
    }
}

/// Whether the entry belongs to the definition of a range type.
fn is_of_data_type(entry: Entry<'_>) -> bool {
    let index = entry.section().and_then(|section| section.kind().index());
    index.is_some_and(|index| index < Index::DEVICE_TYPE)
}

/// How messages show a value: as written, and in decimal where that looks different.
pub(super) fn shown(entry: Entry<'_>, meaning: Scalar) -> String {
    let (text, meaning) = (entry.text_before_comment(), meaning.to_string());
    if text == meaning || !matches!(entry.raw(), [b'0', b'x' | b'X', ..] | [b'-', b'0', b'x' | b'X', ..]) {
        format!("`{text}`")
    } else {
        format!("`{text}` ({meaning})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readings(data_type: DataType, text: &str, node_id: u8) -> Readings {
        let value = Value::parse(data_type, text.as_bytes()).unwrap();
        Readings::of(value, data_type, NodeId::new(node_id).unwrap()).unwrap()
    }

    fn integers(data_type: DataType, text: &str, node_id: u8) -> [i128; 2] {
        readings(data_type, text, node_id).all().map(|reading| match reading {
            Scalar::Integer(value) => value,
            Scalar::Real(_) => panic!("an integer"),
        })
    }

    #[test]
    fn hexadecimal_of_a_signed_type_has_two_readings() {
        assert_eq!(integers(DataType::Integer16, "0x8000", 1), [-0x8000, 0x8000]);
        assert_eq!(integers(DataType::Integer16, "0x7FFF", 1), [0x7FFF, 0x7FFF]);
        assert_eq!(integers(DataType::Integer16, "-0x80", 1), [-0x80, -0x80]);
        assert_eq!(integers(DataType::Integer16, "40000", 1), [40000, 40000]);
        assert_eq!(integers(DataType::Unsigned16, "0x8000", 1), [0x8000, 0x8000]);
        assert_eq!(integers(DataType::Integer64, "0xFFFFFFFFFFFFFFFF", 1), [-1, u64::MAX.into()]);
    }

    #[test]
    fn the_shortest_text_that_reads_back_is_shown() {
        for (bits, shown) in [
            (0x5555_5555, "7.073319e-315"),
            (f64::MAX.to_bits(), "1.7976931348623157e308"),
            (1e16f64.to_bits(), "1e16"),
            (123_456_789.0f64.to_bits(), "123456789"),
            (0.1f64.to_bits(), "0.1"),
            (1e-5f64.to_bits(), "0.00001"),
            (2e-6f64.to_bits(), "2e-6"),
            (0, "0"),
            ((-1e300f64).to_bits(), "-1e300"),
        ] {
            let value = f64::from_bits(bits);
            let text = Scalar::Real(value).to_string();
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), bits, "{text}");
            assert!(text.len() <= 24 && (bits == 0x5555_5555 || text == shown), "{text}");
        }
        for bits in [1u32, 0x0080_0000, 0x7F7F_FFFF, 0x6000_0000, 0x3DCC_CCCD] {
            let value = f32::from_bits(bits);
            let text = Scalar::Real(value.into()).to_string();
            assert_eq!(text.parse::<f32>().unwrap().to_bits(), bits, "{text}");
            assert!(text.len() <= 14, "{text}");
        }
        assert_eq!(Scalar::Real(f64::INFINITY).to_string(), "inf");
    }

    #[test]
    fn a_formula_is_read_for_its_node_id() {
        assert_eq!(integers(DataType::Unsigned32, "$NODEID+0x180", 5), [0x185, 0x185]);
        assert_eq!(integers(DataType::Integer8, "$NODEID+0x80", 1), [-127, 129]);
        assert_eq!(integers(DataType::Integer8, "$NODEID+128", 1), [129, 129]);
        let value = Value::parse(DataType::Unsigned64, b"$NODEID+0xFFFFFFFFFFFFFFFF").unwrap();
        assert_eq!(Readings::of(value, DataType::Unsigned64, NodeId::MAX), None);
    }

    #[test]
    fn spellings_of_one_real32_are_equal() {
        let [bits, number] = readings(DataType::Real32, "0x3DCCCCCD", 1).all();
        assert_eq!(bits, readings(DataType::Real32, "0.1", 1).as_bits);
        assert_eq!(number, Scalar::Real(f64::from(0x3DCC_CCCD_u32 as f32)));
        assert!(!readings(DataType::Real64, "0.1", 1).is_ambiguous());
    }

    #[test]
    fn one_reading_that_fits_is_enough() {
        let fits = |data_type, text: &str| {
            fits(Value::parse(data_type, text.as_bytes()).unwrap(), data_type, NodeId::MAX)
        };
        assert!(fits(DataType::Integer8, "0xFE"));
        assert!(!fits(DataType::Integer8, "254"));
        assert!(!fits(DataType::Integer8, "0xFFFE"));
        assert!(!fits(DataType::Unsigned8, "-1"));
        assert!(fits(DataType::Integer8, "$NODEID+0x80"));
        assert!(!fits(DataType::Integer8, "$NODEID+0x81"));
        assert!(fits(DataType::Real32, "3.4028235e38") && fits(DataType::Real32, "inf"));
        assert!(!fits(DataType::Real32, "1e39"));
        assert!(fits(DataType::VisibleString, "anything"));
    }

    #[test]
    fn decimal_is_added_where_it_helps() {
        let sheet =
            edskit_model::Datasheet::parse(b"[1000]\nDefaultValue=0x10\nLowLimit=16\n[2100Value]\n3=1\n");
        let entries: Vec<_> = sheet.entries().collect();
        assert_eq!(shown(entries[0], Scalar::Integer(16)), "`0x10` (16)");
        assert_eq!(shown(entries[1], Scalar::Integer(16)), "`16`");
        assert_eq!(name(entries[1]), "`LowLimit`");
        assert_eq!(name(entries[2]), "value 3 of `[2100Value]`");
    }
}
