use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// Granularity is above 64
    ///
    /// ## What it does
    /// Reports a `Granularity` of more than 64 bits.
    ///
    /// ## Why is this bad
    /// The entry gives the smallest unit that can be mapped into a PDO, 0 if the mapping is fixed. A PDO has 64 bits,
    /// so nothing at all could be mapped.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// Granularity=128
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// Granularity=8
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5.
    pub(crate) static GRANULARITY_RANGE = {
        code: "DEV008",
        name: "granularity-range",
        group: DeviceInfo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("MND003")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let granularity = context.sheet.device_info().and_then(|info| info.granularity());
    let Some((field, bits @ 65..)) = granularity.and_then(|field| Some((field, field.known()?))) else {
        return;
    };
    report
        .add(field.span(), format!("Granularity is {bits} bits, but a PDO has 64"))
        .help("write `Granularity=8` if whole bytes are mapped, 1 for single bits, 0 for a fixed mapping");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn up_to_64_bits_are_possible() {
        for value in ["0", "64", "", "0x40", "300", "x"] {
            assert!(findings(&GRANULARITY_RANGE, &format!("[DeviceInfo]\nGranularity={value}\n")).is_empty());
        }
        assert_eq!(
            findings(&GRANULARITY_RANGE, "[DeviceInfo]\nGranularity=0x41\n"),
            ["2:13 error: Granularity is 65 bits, but a PDO has 64"]
        );
    }
}
