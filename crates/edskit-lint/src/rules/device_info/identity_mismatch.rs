use super::identity::{NUMBERS, number, value, values};
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_types::Index;

rule! {
    /// `[DeviceInfo]` and the identity object 1018h contradict each other
    ///
    /// ## What it does
    /// Compares `VendorNumber`, `ProductNumber` and `RevisionNumber` with the values of 1018h sub-index 01h, 02h and
    /// 03h, the default or the one of a DCF. It is an info where one of the two is 0, as in templates.
    ///
    /// ## Why is this bad
    /// Tools find the file for a device on the bus by these numbers, some by the section and some by the object. A
    /// master that checks the identity at boot-up rejects the device if the file names the wrong one.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// ProductNumber=0x2
    ///
    /// [1018sub2]
    /// ParameterName=Product code
    /// DataType=0x0007
    /// AccessType=ro
    /// DefaultValue=0x3
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// ProductNumber=0x3
    ///
    /// [1018sub2]
    /// ParameterName=Product code
    /// DataType=0x0007
    /// AccessType=ro
    /// DefaultValue=0x3
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5; CiA 301 v4.2, 7.5.2.21.
    pub(crate) static IDENTITY_MISMATCH = {
        code: "DEV006",
        name: "identity-mismatch",
        group: DeviceInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [
            CanChkEds("130"), EdsDcfCheck("MND005"), Dcfchk("VendorNumber differs"),
            Dcfchk("ProductNumber differs"), Dcfchk("RevisionNumber differs"),
        ],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for (name, sub_index) in NUMBERS {
        let Some((claimed, entry)) = number(context.sheet, name) else { continue };
        let Some((actual, object)) = value(context.sheet, sub_index) else { continue };
        // In a DCF the default may be the one of a whole family, and the value the one of this device.
        if values(context.sheet, sub_index).any(|(value, _)| value == claimed) {
            continue;
        }
        let (name, place) = (name.spelling(), format!("{} sub-index {sub_index}", Index::IDENTITY));
        let message = format!("{name} is `{}`, but {place} is `{}`", entry.text(), object.text());
        let finding = report.add(entry.value_span(), message);
        finding.label(object.value_span(), place);
        let replacement = object.text();
        let help = format!("write `{name}={replacement}`");
        if claimed == 0 {
            finding
                .severity(Severity::Info)
                .help(help)
                .unsafe_fix("Take the object's value", vec![Edit::replace(entry.value_span(), replacement)]);
        } else if actual == 0 {
            let key = object.key_text();
            finding.severity(Severity::Info).help(format!("give the object `{key}={}`", entry.text()));
        } else {
            finding.help(format!("{help} if the object is right"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn text(vendor: &str, object: &str) -> String {
        format!("[DeviceInfo]\nVendorNumber={vendor}\n[1018sub1]\nDataType=0x7\nDefaultValue={object}\n")
    }

    #[test]
    fn the_same_number_in_another_notation_is_the_same() {
        for (vendor, object) in
            [("0x3F5", "1013"), ("", "5"), ("5", ""), ("5", "$NODEID+5"), ("x", "5"), ("5", "x")]
        {
            assert!(findings(&IDENTITY_MISMATCH, &text(vendor, object)).is_empty(), "{vendor} {object}");
        }
        assert_eq!(
            findings(&IDENTITY_MISMATCH, &text("0x2", "0x3F5")),
            ["2:14 warning: VendorNumber is `0x2`, but 1018h sub-index 01h is `0x3F5`"]
        );
    }

    #[test]
    fn a_zero_makes_it_an_info() {
        assert_eq!(findings(&IDENTITY_MISMATCH, &text("2", "0"))[0][..9], *"2:14 info");
        assert_eq!(fixed(&IDENTITY_MISMATCH, &text("2", "0")), text("2", "0"));
        assert_eq!(findings(&IDENTITY_MISMATCH, &text("0", "0x2"))[0][..9], *"2:14 info");
        assert_eq!(fixed(&IDENTITY_MISMATCH, &text("0", "0x2")), text("0x2", "0x2"));
    }

    #[test]
    fn the_value_of_a_dcf_stands_in_for_a_default() {
        let text = "[DeviceInfo]\nRevisionNumber=1\n[1018sub3]\nDataType=7\nParameterValue=2\n";
        assert_eq!(
            findings(&IDENTITY_MISMATCH, text),
            ["2:16 warning: RevisionNumber is `1`, but 1018h sub-index 03h is `2`"]
        );
        let text = format!("{text}DefaultValue=1\n");
        assert!(findings(&IDENTITY_MISMATCH, &text).is_empty());
    }
}
