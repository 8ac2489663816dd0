use super::identity::{number, value};
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::KeyName;
use edskit_types::SubIndex;

rule! {
    /// The vendor-ID is 0
    ///
    /// ## What it does
    /// Reports a `VendorNumber` of 0, or a 1018h sub-index 01h of 0, if the other one gives no vendor-ID either.
    ///
    /// ## Why is this bad
    /// 0 is no vendor-ID; CiA assigns one to each manufacturer. Tools cannot tell devices apart that have none. Files
    /// made from a template have it until the numbers are filled in.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// VendorNumber=0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// VendorNumber=0x000003F5
    /// ```
    ///
    /// ## References
    /// CiA 301 v4.2, 7.5.2.21; CiA 306 v1.3, 4.5.
    pub(crate) static VENDOR_NUMBER_ZERO = {
        code: "DEV007",
        name: "vendor-number-zero",
        group: DeviceInfo,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let claimed = number(context.sheet, KeyName::VendorNumber);
    let actual = value(context.sheet, SubIndex(1));
    // If only one of them is 0 they contradict each other, which is the matter of DEV006.
    let numbers: Vec<_> = claimed.into_iter().chain(actual).collect();
    if numbers.iter().any(|&(number, _)| number != 0) {
        return;
    }
    let Some(&(_, entry)) = numbers.first() else { return };
    let finding = report.add(entry.value_span(), "the vendor-ID is 0, which no manufacturer has");
    if let Some((_, object)) = numbers.get(1) {
        finding.label(object.value_span(), "1018h sub-index 01h is 0, too");
    }
    finding.help("write the vendor-ID that CiA assigned, in `VendorNumber` and in 1018h sub-index 01h");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    fn found(vendor: &str, object: &str) -> Vec<String> {
        let text =
            format!("[DeviceInfo]\nVendorNumber={vendor}\n[1018sub1]\nDataType=7\nDefaultValue={object}\n");
        findings(&VENDOR_NUMBER_ZERO, &text)
    }

    #[test]
    fn one_vendor_id_is_enough() {
        assert_eq!(found("0", "0x0"), ["2:14 info: the vendor-ID is 0, which no manufacturer has"]);
        assert_eq!(found("", "0"), ["5:14 info: the vendor-ID is 0, which no manufacturer has"]);
        for (vendor, object) in [("0", "1"), ("1", "0"), ("", ""), ("x", "")] {
            assert!(found(vendor, object).is_empty(), "{vendor} {object}");
        }
    }
}
