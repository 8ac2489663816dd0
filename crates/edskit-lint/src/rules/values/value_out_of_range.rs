use super::reading::{Role, each_value, fits, name};
use crate::rule::rule;
use crate::{Context, Report, Severity, Variable};
use edskit_model::{Field, Value};
use edskit_types::{DataType, NodeId, SubIndex};

rule! {
    /// A value does not fit its data type
    ///
    /// ## What it does
    /// Reports a `DefaultValue` or `ParameterValue`, or an entry of `[xxxxValue]`, that its data type cannot hold, and
    /// limits of this kind as warnings. A value that fits the data type that the object should have is left to COM002
    /// and OBJ013. Hexadecimal within the width of a signed type is accepted, because many tools
    /// write negative values so.
    ///
    /// ## Why is this bad
    /// A tool that loads the value into the device refuses it or cuts it off; a device made from the file gets
    /// another value than the file says. A limit beyond the type limits nothing and hides a mistake in one of the two.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// DataType=0x0005
    /// DefaultValue=300
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Speed
    /// DataType=0x0006
    /// DefaultValue=300
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.1.6; CiA 306 v1.3, 4.6.3.2.
    pub(crate) static VALUE_OUT_OF_RANGE = {
        code: "VAL002",
        name: "value-out-of-range",
        group: Values,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            CanChkEds("22"), EdsDcfCheck("VAL001"), EdsDcfCheck("LIB003"), Dcfchk("underflow"),
            Dcfchk("overflow"),
        ],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let Some(data_type) = variable.standard_type.filter(|data_type| data_type.is_numeric()) else { return };
    each_value(context, variable, |role, field| {
        if let Some(value @ (Value::Integer(_) | Value::Real(_))) = field.known()
            && !fits(value, data_type, NodeId::MIN)
        {
            report_value(variable, role, field, value, data_type, report);
        }
    });
}

#[cold]
fn report_value(
    variable: &Variable<'_>,
    role: Role,
    field: Field<'_, Value<'_>>,
    value: Value<'_>,
    data_type: DataType,
    report: &mut Report,
) {
    if is_wrong_type(variable, value, data_type) {
        return;
    }
    let range = match data_type.range() {
        Some((low, high)) => format!("{low} to {high}"),
        None => format!("{:e} to {:e}", f32::MIN, f32::MAX),
    };
    let finding = report.add(
        field.span(),
        format!("{} is `{}`, but {data_type} holds {range}", name(field.entry), field.text()),
    );
    finding.help(help(value, data_type));
    if role == Role::Limit {
        finding.severity(Severity::Warning);
    }
    if let Some(type_field) = variable.data_type {
        finding.label(type_field.span(), format!("the data type is {data_type}"));
    }
}

/// Whether the type is wrong rather than the value: the one that is prescribed (COM002) or that sub-index 00h has
/// (OBJ013) is another one, and the value fits it.
fn is_wrong_type(variable: &Variable<'_>, value: Value<'_>, data_type: DataType) -> bool {
    let is_better = |other: DataType| other != data_type && fits(value, other, NodeId::MIN);
    if variable.sub_index == Some(SubIndex(0)) {
        return is_better(DataType::Unsigned8);
    }
    variable.prescribed().any(|prescribed| {
        let mut types = prescribed.attributes.types.iter().filter_map(|&index| DataType::from_index(index));
        !prescribed.attributes.types.contains(&data_type.index()) && types.any(is_better)
    })
}

fn help(value: Value<'_>, data_type: DataType) -> String {
    if let (Value::Integer(number), Some((low, high)), Some(bits)) =
        (value, data_type.range(), data_type.bits())
    {
        let value = number.value();
        let digits = usize::from(bits.div_ceil(4));
        let signed_low = -(1i128 << (bits - 1));
        if low == 0 && value < 0 && value >= signed_low {
            return format!("write `0x{:0digits$X}` if the bits of {value} are meant", value + (1 << bits));
        }
        if value == high + 1 {
            return format!("write `{high}`, the largest value");
        }
        if let Some(extended) = sign_extended(value, bits).filter(|_| low < 0) {
            return format!("write `{extended}`, which is what the low {bits} bits say");
        }
        let wider = |candidate: &&DataType| {
            candidate.is_signed() == data_type.is_signed()
                && candidate.is_integer()
                && candidate.bits().is_some_and(|bits| bits.is_power_of_two())
                && candidate.range().is_some_and(|(low, high)| value >= low && value <= high)
        };
        let mut candidates: Vec<_> = DataType::ALL.iter().filter(wider).collect();
        candidates.sort_by_key(|candidate| candidate.bits());
        return match candidates.first() {
            Some(wider) => format!(
                "write a value from {low} to {high}, or the type that holds it: `DataType=0x{:04X}` ({wider})",
                wider.index()
            ),
            None => format!("write a value from {low} to {high}"),
        };
    }
    format!("write a smaller value, or the wider type: `DataType=0x{:04X}`", DataType::Real64.index())
}

/// The negative value of `bits` bits that was extended with ones to 16, 32 or 64 bits.
fn sign_extended(value: i128, bits: u16) -> Option<i128> {
    let widths = [16, 32, 64].into_iter().filter(|&width| width > bits);
    let extended = widths.map(|width| value - (1i128 << width));
    extended.into_iter().find(|extended| (-(1i128 << (bits - 1))..0).contains(extended))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in, lint};
    use edskit_model::Datasheet;

    #[test]
    fn a_value_that_fits_the_right_type_shows_the_wrong_one() {
        let found = |text: &str| findings(&VALUE_OUT_OF_RANGE, text).len();
        assert_eq!(found("[1000]\nDataType=6\nDefaultValue=0x20192\n"), 0);
        assert_eq!(found("[1000]\nDataType=7\nDefaultValue=0x120192000\n"), 1);
        assert_eq!(found("[1003]\nObjectType=8\n[1003sub0]\nDataType=2\nDefaultValue=200\n"), 0);
    }

    fn one(data_type: u16, value: &str) -> String {
        findings(&VALUE_OUT_OF_RANGE, &format!("[2000]\nDataType={data_type}\nDefaultValue={value}\n"))
            .join("|")
    }

    fn help_of(data_type: u16, value: &str) -> String {
        let text = format!("[2000]\nDataType={data_type}\nDefaultValue={value}\n");
        let sheet = Datasheet::parse(text.as_bytes());
        lint(&VALUE_OUT_OF_RANGE, "a.eds", &sheet).remove(0).help.unwrap()
    }

    #[test]
    fn integers_have_a_range() {
        assert_eq!(one(5, "256"), "3:14 error: `DefaultValue` is `256`, but UNSIGNED8 holds 0 to 255");
        assert_eq!(one(2, "-129"), "3:14 error: `DefaultValue` is `-129`, but INTEGER8 holds -128 to 127");
        for (data_type, value) in
            [(5, "255"), (2, "0xFF"), (2, "-0x80"), (4, "0xFFFFFF9C"), (7, "$NODEID"), (5, "x")]
        {
            assert_eq!(one(data_type, value), "");
        }
    }

    #[test]
    fn a_real32_has_a_largest_value() {
        assert_eq!(
            one(8, "1e39"),
            "3:14 error: `DefaultValue` is `1e39`, but REAL32 holds -3.4028235e38 to 3.4028235e38"
        );
        assert_eq!(one(0x11, "1e39"), "");
    }

    #[test]
    fn limits_are_warnings_and_compact_values_are_values() {
        let text = "[2000]\nObjectType=8\nDataType=5\nCompactSubObj=3\nLowLimit=-1\nHighLimit=255\n[2000Value]\nNrOfEntries=2\n1=255\n2=256\n";
        assert_eq!(
            findings_in(&VALUE_OUT_OF_RANGE, "a.dcf", text.as_bytes()),
            [
                "5:10 warning: `LowLimit` is `-1`, but UNSIGNED8 holds 0 to 255",
                "10:3 error: value 2 of `[2000Value]` is `256`, but UNSIGNED8 holds 0 to 255"
            ]
        );
    }

    #[test]
    fn the_help_guesses_what_was_meant() {
        assert_eq!(help_of(5, "-1"), "write `0xFF` if the bits of -1 are meant");
        assert_eq!(help_of(6, "65536"), "write `65535`, the largest value");
        assert_eq!(help_of(3, "0xFFFF8000"), "write `-32768`, which is what the low 16 bits say");
        assert_eq!(
            help_of(5, "300"),
            "write a value from 0 to 255, or the type that holds it: `DataType=0x0006` (UNSIGNED16)"
        );
        assert_eq!(
            help_of(0x15, "-9223372036854775809"),
            "write a value from -9223372036854775808 to 9223372036854775807"
        );
    }
}
