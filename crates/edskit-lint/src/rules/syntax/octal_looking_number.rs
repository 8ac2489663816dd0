use super::typed;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::meant::value_length;
use edskit_model::{Entry, Number, Radix, Shape};
use edskit_types::DataType;

rule! {
    /// A leading zero makes a number octal
    ///
    /// ## What it does
    /// Reports numbers above 7 that begin with `0` and have only octal digits. By CiA 306 they are octal, which is
    /// hardly ever meant.
    ///
    /// ## Why is this bad
    /// Some readers take `0123` for 83, some for 123, and python-canopen refuses the file.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// VendorNumber=0123
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// VendorNumber=123
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.3.
    pub(crate) static OCTAL_LOOKING_NUMBER = {
        code: "SYN018",
        name: "octal-looking-number",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [CanChkEds("21"), EdsDcfCheck("VAL005")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for entry in context.odd_entries() {
        let raw = entry.raw();
        if !matches!(raw, [b'0', b'0'..=b'9', ..]) || !is_number(entry) {
            continue;
        }
        let length = value_length(raw).unwrap_or(raw.len());
        let Ok(number) = Number::parse(&raw[..length]) else { continue };
        if number.radix() == Radix::Octal && number.value() > 7 {
            let span = entry.value_span().sub(0, length);
            let text = context.sheet.text(span);
            let digits = text.trim_start_matches('0');
            let octal = number.value();
            report
                .add(
                    span,
                    format!("`{text}` is octal because of its leading zero: it is {octal}, not {digits}"),
                )
                .help(format!("write `{octal}` if that is right, `{digits}` or `0x{digits}` if not"));
        }
    }
}

/// Whether the value is a number and not a text of digits.
fn is_number(entry: Entry<'_>) -> bool {
    match typed::shape(entry) {
        Shape::Unsigned(_) | Shape::Flag | Shape::ObjectCode => true,
        Shape::Value => entry.section().and_then(typed::data_type).is_some_and(DataType::is_integer),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn only_numbers_with_another_value_are_reported() {
        let text = "[DeviceInfo]\nVendorNumber=000123\nProductNumber=007\nRevisionNumber= 010 ; x\nOrderCode=0123\n\
                    [FileInfo]\nCreationDate=01-02-2020\n[2000]\nDataType=0x9\nDefaultValue=0123\n\
                    [2001]\nDataType=0x7\nDefaultValue=0100\nHighLimit=0189\n[MandatoryObjects]\n1=010\n";
        assert_eq!(
            findings(&OCTAL_LOOKING_NUMBER, text),
            [
                "2:14 warning: `000123` is octal because of its leading zero: it is 83, not 123",
                "4:17 warning: `010` is octal because of its leading zero: it is 8, not 10",
                "13:14 warning: `0100` is octal because of its leading zero: it is 64, not 100",
                "16:3 warning: `010` is octal because of its leading zero: it is 8, not 10",
            ]
        );
    }
}
