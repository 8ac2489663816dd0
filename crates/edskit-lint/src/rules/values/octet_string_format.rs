use super::reading::{Role, each_value, is_owned_elsewhere, name};
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity, Variable};
use edskit_model::{Field, Number, Value, ValueErrorKind};
use edskit_types::{DataType, DataTypeKind};

rule! {
    /// An octet string is not written as pairs of hexadecimal digits
    ///
    /// ## What it does
    /// Reports a value of an OCTET_STRING or DOMAIN that holds anything but hexadecimal digits, or an odd number of
    /// them. A DOMAIN whose value is the number 0, which writers put there for no data, is reported as an information.
    ///
    /// ## Why is this bad
    /// Every octet has two digits and nothing stands between them, so readers refuse the value or drop it in silence.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Key
    /// DataType=0x000A
    /// DefaultValue=0A1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Key
    /// DataType=0x000A
    /// DefaultValue=00A1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3.
    pub(crate) static OCTET_STRING_FORMAT = {
        code: "VAL009",
        name: "octet-string-format",
        group: Values,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("VAL001")],
        check: Variable(check),
    }
}

fn check(context: &Context<'_>, variable: &Variable<'_>, report: &mut Report) {
    let is_octets = |kind| matches!(kind, DataTypeKind::OctetString | DataTypeKind::Domain);
    if !variable.standard_type.is_some_and(|data_type| is_octets(data_type.kind())) {
        return;
    }
    each_value(context, variable, |role, field| {
        if role == Role::Value && field.value.is_err() && !is_owned_elsewhere(field.entry.raw()) {
            report_value(variable, field, report);
        }
    });
}

#[cold]
fn report_value(variable: &Variable<'_>, field: Field<'_, Value<'_>>, report: &mut Report) {
    let Err(error) = field.value else { return };
    let raw = field.entry.raw();
    let (what, span) = match error.kind {
        ValueErrorKind::OddDigits => ("has an odd number of hexadecimal digits".to_owned(), field.span()),
        _ if raw.starts_with(b"0x") || raw.starts_with(b"0X") => {
            ("begins with `0x`".to_owned(), field.span().sub(0, 2))
        }
        _ => (format!("is no octet string: {error}"), field.error_span().unwrap_or(field.span())),
    };
    let finding = report.add(span, format!("{} {what}", name(field.entry)));
    if variable.standard_type == Some(DataType::Domain)
        && Number::parse(raw).is_ok_and(|number| number.value() == 0)
    {
        finding.help("leave the value out where there are no data").severity(Severity::Info);
        return;
    }
    match repaired(raw) {
        Some(text) if text.len() <= 32 => {
            finding.help(format!("write two digits for each octet, such as `{text}`"));
            finding.unsafe_fix("Write pairs of digits", vec![Edit::replace(field.span(), text)]);
        }
        Some(text) => {
            finding.help("write two digits for each octet and nothing else");
            finding.unsafe_fix("Write pairs of digits", vec![Edit::replace(field.span(), text)]);
        }
        None => {
            finding.help("write two hexadecimal digits for each octet and nothing else");
        }
    }
}

/// The octets that were meant, if a `0x`, blanks between them or the zero of a first digit is all that is wrong.
fn repaired(raw: &[u8]) -> Option<String> {
    let mut text = String::new();
    for part in raw.split(|byte| matches!(byte, b' ' | b'\t')).filter(|part| !part.is_empty()) {
        let digits = part.strip_prefix(b"0x").or_else(|| part.strip_prefix(b"0X")).unwrap_or(part);
        if digits.is_empty() || !digits.iter().all(u8::is_ascii_hexdigit) {
            return None;
        }
        if digits.len() % 2 == 1 {
            text.push('0');
        }
        text.extend(digits.iter().map(|&digit| digit as char));
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn default(value: &str) -> (String, String) {
        let text = format!("[2000]\nDataType=10\nDefaultValue={value}\n");
        let after = fixed(&OCTET_STRING_FORMAT, &text);
        let value = after.rsplit('=').next().unwrap_or_default().trim_end().to_owned();
        (findings(&OCTET_STRING_FORMAT, &text).join("|"), value)
    }

    #[test]
    fn what_is_wrong_is_said_and_mended_where_it_is_plain() {
        for (value, message, after) in [
            ("00fF", "", "00fF"),
            ("ABC", "3:14 warning: `DefaultValue` has an odd number of hexadecimal digits", "0ABC"),
            ("0x1AB", "3:14 warning: `DefaultValue` begins with `0x`", "01AB"),
            (
                "01 2 0x3",
                "3:16 warning: `DefaultValue` is no octet string: a blank is not a hexadecimal digit",
                "010203",
            ),
            (
                "\"ab\"",
                "3:14 warning: `DefaultValue` is no octet string: `\"` is not a hexadecimal digit",
                "\"ab\"",
            ),
            ("0 ; none", "", "0 ; none"),
        ] {
            assert_eq!(default(value), (message.to_owned(), after.to_owned()), "{value}");
        }
    }

    #[test]
    fn a_domain_is_read_alike_and_its_limits_are_not() {
        let text =
            "[2000]\nObjectType=2\nDefaultValue=123\nLowLimit=0\n[2001]\nDataType=15\nDefaultValue=0x00\n";
        assert_eq!(
            findings(&OCTET_STRING_FORMAT, text),
            [
                "3:14 warning: `DefaultValue` has an odd number of hexadecimal digits",
                "7:14 info: `DefaultValue` begins with `0x`"
            ]
        );
    }
}
