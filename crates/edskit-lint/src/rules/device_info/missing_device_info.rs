use crate::rule::rule;
use crate::rules::syntax::lost_header;
use crate::{Context, Report};
use edskit_model::SectionKind;

rule! {
    /// The file has no section `[DeviceInfo]`
    ///
    /// ## What it does
    /// Reports a file without `[DeviceInfo]`. One whose header stands behind other text,
    /// because a line break was lost, is the matter of SYN008.
    ///
    /// ## Why is this bad
    /// The section is mandatory. Without it no tool knows who made the device, which bit rates it has, and how many
    /// PDOs; many refuse the file.
    ///
    /// ## Example
    /// ```eds
    /// [FileInfo]
    /// FileName=pump.eds
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// FileName=pump.eds
    ///
    /// [DeviceInfo]
    /// VendorName=Nordlicht
    /// VendorNumber=0x000003F5
    /// BaudRate_250=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.5.
    pub(crate) static MISSING_DEVICE_INFO = {
        code: "DEV001",
        name: "missing-device-info",
        group: DeviceInfo,
        severity: Error,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("1"), EdsDcfCheck("MND001")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    if context.sheet.device_info().is_some() || lost_header::hides(context, SectionKind::DeviceInfo) {
        return;
    }
    report
        .add(context.start(), "the file has no section `[DeviceInfo]`")
        .help("add `[DeviceInfo]` with `VendorName`, `VendorNumber`, `ProductName`, the bit rates and so on");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn the_section_may_stand_anywhere() {
        assert!(findings(&MISSING_DEVICE_INFO, "[1000]\n[DEVICEINFO]\n").is_empty());
        assert!(findings(&MISSING_DEVICE_INFO, "[FileInfo]\nFileVersion=1[DeviceInfo]\n").is_empty());
        assert_eq!(
            findings(&MISSING_DEVICE_INFO, "; [DeviceInfo]\n[1000]\n"),
            ["1:1 error: the file has no section `[DeviceInfo]`"]
        );
    }
}
