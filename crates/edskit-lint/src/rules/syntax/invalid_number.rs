use super::{lost_header, typed};
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::meant::{self, Slip, Wanted, value_length};
use edskit_model::{Entry, KeyName, Number, NumberError, NumberErrorKind, Section, SectionKind, Shape};
use edskit_types::DataType;

rule! {
    /// A value that must be a number is none
    ///
    /// ## What it does
    /// Reports values that are no decimal, hexadecimal (`0x`) or octal (leading `0`) number where one must stand: counts,
    /// identity numbers, data types, items of lists, and values and limits of integer types. A number that is too large
    /// for its key is reported too.
    ///
    /// ## Why is this bad
    /// Readers refuse the file, take 0, or take the digits before the first odd character.
    ///
    /// ## Example
    /// ```eds
    /// [1018]
    /// ParameterName=Identity
    /// SubNumber=08
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1018]
    /// ParameterName=Identity
    /// SubNumber=8
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3.
    pub(crate) static INVALID_NUMBER = {
        code: "SYN017",
        name: "invalid-number",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [
            CanChkEds("21"), EdsDcfCheck("OBJ002"), EdsDcfCheck("OBJ009"), EdsDcfCheck("VAL001"),
            EdsDcfCheck("LST006"), Dcfchk("invalid value for"), Dcfchk("invalid object index for entry"),
            Dcfchk("invalid DataType"),
            Dcfchk("invalid DefaultValue, ParameterValue, LowLimit or HighLimit"),
        ],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for section in context.sheet.sections() {
        let kind = section.kind();
        if kind == SectionKind::Unknown {
            continue;
        }
        for entry in section.entries() {
            let shape = typed::shape_in(kind, entry.key().name);
            let bits = match shape {
                Shape::Unsigned(bits) => bits,
                Shape::Value => 64,
                _ => continue,
            };
            if is_small_number(entry.raw(), bits) {
                continue;
            }
            if shape == Shape::Value {
                value(context, section, entry, report);
            } else {
                unsigned(context, entry, bits, report);
            }
        }
    }
}

/// Whether the text is surely a number of so many bits. Most are, and this is faster than to read it.
#[inline]
fn is_small_number(raw: &[u8], bits: u8) -> bool {
    match raw {
        [b'0', b'x', digits @ ..] => {
            !digits.is_empty()
                && digits.len() <= usize::from(bits / 4)
                && digits.iter().all(u8::is_ascii_hexdigit)
        }
        [first @ b'0'..=b'9', rest @ ..] => {
            (*first != b'0' || rest.is_empty())
                && rest.len() < usize::from(bits / 4)
                && rest.iter().all(u8::is_ascii_digit)
        }
        _ => false,
    }
}

/// A value that is a number whatever the object: FIL003 owns those of the file's version.
fn unsigned(context: &Context<'_>, entry: Entry<'_>, bits: u8, report: &mut Report) {
    let raw = entry.raw();
    let name = entry.key().name;
    if matches!(name, KeyName::FileVersion | KeyName::FileRevision) || is_owned_elsewhere(context, entry) {
        return;
    }
    match Number::parse(raw) {
        Err(error) => not_a_number(context, entry, error, report),
        Ok(number) if number.to::<u64>().is_none_or(|value| value >> bits != 0) => {
            let maximum = (1u64 << bits) - 1;
            report.add(
                entry.value_span(),
                format!("`{}` is {number}, which is not in 0..{maximum}", entry.key_text()),
            );
        }
        Ok(_) => {}
    }
}

/// A value whose data type decides. What is a number outside its type is the matter of VAL002.
fn value(context: &Context<'_>, section: Section<'_>, entry: Entry<'_>, report: &mut Report) {
    let Err(error) = Number::parse(entry.raw()) else { return };
    let is_integer = || typed::data_type(section).is_some_and(DataType::is_integer);
    let is_sum = || entry.raw().contains(&b'+') && meant::formula(entry.raw()).is_some();
    if is_integer() && !is_owned_elsewhere(context, entry) && !is_sum() {
        not_a_number(context, entry, error, report);
    }
}

/// Empty values, values with a comment behind them, formulas, and values that swallowed a header.
fn is_owned_elsewhere(context: &Context<'_>, entry: Entry<'_>) -> bool {
    let raw = entry.raw();
    raw.is_empty()
        || value_length(raw).is_some()
        || (raw.contains(&b'$') && !meant::is_hexadecimal(raw))
        || (raw.ends_with(b"]") && lost_header::on_line(context, entry.line_number()).is_some())
}

fn not_a_number(context: &Context<'_>, entry: Entry<'_>, error: NumberError, report: &mut Report) {
    let value = entry.value_span();
    let raw = entry.raw();
    let rest = value.len() - error.offset as usize;
    let wrong = match error.kind {
        NumberErrorKind::Digit(_) | NumberErrorKind::OctalDigit(_) => value.sub(error.offset as usize, 1),
        _ if rest > 0 => value.sub(error.offset as usize, rest),
        _ => value,
    };
    let key = entry.key_text();
    let wanted = match entry.key().name {
        KeyName::DataType => Wanted::DataType,
        KeyName::Item => Wanted::Index,
        _ => Wanted::Number,
    };
    let slip = entry.slip(wanted);
    if wanted == Wanted::DataType
        && raw.first().is_some_and(u8::is_ascii_alphabetic)
        && let Some(Slip { text: number, certain: true, .. }) = &slip
    {
        report
            .add(
                value,
                format!("`{key}={}` is not a number: a data type is given by its index", entry.text()),
            )
            .help(format!("write `{key}={number}`"))
            .unsafe_fix(format!("Write `{number}`"), vec![Edit::replace(value, number.clone())]);
        return;
    }
    let finding = report.add(wrong, format!("`{key}={}` is not a number: {error}", entry.text()));
    if let Some(formula) = meant::formula(raw) {
        finding
            .help(format!("write `{key}={formula}` if the node-ID is meant"))
            .unsafe_fix(format!("Write `{formula}`"), vec![Edit::replace(value, formula.to_string())]);
        return;
    }
    if matches!(raw, [b'<', .., b'>'] | [b'$', b'{', .., b'}']) {
        finding.help("fill in the number: this is the blank of a form");
        return;
    }
    let Some(slip) = slip else {
        finding.help("write a decimal number, or a hexadecimal one such as `0x1A`");
        return;
    };
    let number = &slip.text;
    if raw.iter().all(u8::is_ascii_digit) {
        finding.help(format!("write `{number}`, or `0x{}` if that was meant", context.sheet.text(value)));
    } else if let Some(other) = &slip.other {
        finding.help(format!("write `{key}={number}`, or `{other}` if that was meant; {}", slip.reason));
    } else {
        finding.help(format!("write `{key}={number}`; {}", slip.reason));
    }
    if slip.certain {
        finding.unsafe_fix(format!("Write `{number}`"), vec![Edit::replace(value, slip.text)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed, lint};
    use edskit_model::Datasheet;

    #[test]
    fn keys_that_are_numbers() {
        let text = "[DeviceInfo]\nVendorNumber=1a\nProductNumber=0x123456789\nNrOfTXPDO=-1\nGranularity=\n\
                    [MandatoryObjects]\nSupportedObjects=1;\n1=1000h\n2=4096\n\
                    [FileInfo]\nFileVersion=1.0\n[x]\nDataType=y\n[1000]\nDataType=0x0x7\nObjectType=z\n";
        assert_eq!(
            findings(&INVALID_NUMBER, text),
            [
                "2:15 error: `VendorNumber=1a` is not a number: `a` is not a digit",
                "3:15 error: `ProductNumber` is 0x123456789, which is not in 0..4294967295",
                "4:11 error: `NrOfTXPDO` is -1, which is not in 0..65535",
                "7:19 error: `SupportedObjects=1;` is not a number: `;` is not a digit",
                "8:7 error: `1=1000h` is not a number: `h` is not a digit",
                "15:13 error: `DataType=0x0x7` is not a number: `x` is not a digit",
            ]
        );
        let mended = fixed(&INVALID_NUMBER, text);
        assert!(mended.contains("VendorNumber=0x1a\n"), "{mended}");
        assert!(mended.contains("SupportedObjects=1\n1=0x1000\n"), "{mended}");
        assert!(mended.contains("DataType=0x7\n"), "{mended}");
    }

    #[test]
    fn values_are_numbers_where_their_type_is_an_integer() {
        let value = |data_type: &str, value: &str| {
            findings(&INVALID_NUMBER, &format!("[2000]\nDataType={data_type}\nDefaultValue={value}\n"))
        };
        assert_eq!(
            value("0x5", "1,5"),
            ["3:15 error: `DefaultValue=1,5` is not a number: `,` is not a digit"]
        );
        assert_eq!(value("0x5", "0x"), ["3:14 error: `DefaultValue=0x` is not a number: digits are missing"]);
        for (data_type, fine) in [
            ("0x9", "abc"),
            ("0x8", "1.5"),
            ("0x1", "x"),
            ("", "abc"),
            ("0x2", "-5"),
            ("0x5", "300"),
            ("0x5", ""),
        ] {
            assert_eq!(value(data_type, fine), [""; 0], "{data_type} {fine}");
        }
    }

    #[test]
    fn numbers_of_other_languages_are_read_as_they_were_meant() {
        let help = |text: &str| {
            let findings = lint(&INVALID_NUMBER, "a.eds", &Datasheet::parse(text.as_bytes()));
            findings[0].help.clone().unwrap()
        };
        let value = |value: &str| format!("[2000]\nDataType=7\nDefaultValue={value}\n");
        assert_eq!(
            help(&value("1e3")),
            "write `DefaultValue=1000`, or `0x1e3` if that was meant; an integer has no exponent"
        );
        assert_eq!(fixed(&INVALID_NUMBER, &value("0o17")), value("15"));
        assert_eq!(fixed(&INVALID_NUMBER, &value("1e3")), value("1e3"), "nobody can be sure");
        let list = "[ManufacturerObjects]\n1=2E03\n";
        assert_eq!(fixed(&INVALID_NUMBER, list), list.replace("2E03", "0x2E03"));
    }

    #[test]
    fn blanks_of_a_form_are_named() {
        let text = "[2000]\nDataType=7\nParameterValue=<!speed>\n";
        let found = lint(&INVALID_NUMBER, "a.dcf", &Datasheet::parse(text.as_bytes()));
        assert_eq!(found[0].help.as_deref(), Some("fill in the number: this is the blank of a form"));
    }

    #[test]
    fn the_node_id_needs_its_dollar() {
        let text = "[1800sub1]\nDataType=7\nDefaultValue=NodeID\n";
        assert_eq!(
            findings(&INVALID_NUMBER, text),
            ["3:14 error: `DefaultValue=NodeID` is not a number: `N` is not a digit"]
        );
        assert_eq!(fixed(&INVALID_NUMBER, text), "[1800sub1]\nDataType=7\nDefaultValue=$NODEID\n");
    }

    #[test]
    fn data_types_may_be_named() {
        let text = "[1000]\nDataType=Unsigned32\n";
        assert_eq!(
            findings(&INVALID_NUMBER, text),
            ["2:10 error: `DataType=Unsigned32` is not a number: a data type is given by its index"]
        );
        assert_eq!(fixed(&INVALID_NUMBER, text), "[1000]\nDataType=0x0007\n");
    }

    #[test]
    fn what_other_rules_own() {
        for value in ["5 ; five", "$NODEID+", "NODEID+0x180", "0x180+$NODEID", "5[1001]"] {
            let text = format!("[2000]\nDataType=0x7\nDefaultValue={value}\nParameterName=a\n");
            assert_eq!(findings(&INVALID_NUMBER, &text), [""; 0]);
        }
        for value in ["5 ; five", "$NODEID", "5[1001]"] {
            assert_eq!(findings(&INVALID_NUMBER, &format!("[1002]\nSubNumber={value}\n")), [""; 0]);
        }
        assert_eq!(findings(&INVALID_NUMBER, "[1002]\nSubNumber=$5\n").len(), 1);
    }

    #[test]
    fn the_fast_path_accepts_only_numbers() {
        for (text, bits, small) in [
            ("0x00", 8, true),
            ("0x100", 8, false),
            ("9", 8, true),
            ("99", 8, true),
            ("100", 8, false),
            ("0", 8, true),
            ("00", 8, false),
            ("0x", 8, false),
            ("9999", 16, true),
            ("10000", 16, false),
            ("99999999", 32, true),
            ("9999999999999999", 64, true),
            ("0xG", 32, false),
            ("", 32, false),
        ] {
            assert_eq!(is_small_number(text.as_bytes(), bits), small, "{text} {bits}");
        }
    }
}
