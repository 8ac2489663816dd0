use crate::rule::rule;
use crate::{Context, FileKind, Report};

rule! {
    /// A DCF lacks `[DeviceComissioning]`, or an EDS has it
    ///
    /// ## What it does
    /// Reports a device configuration file without the section `[DeviceComissioning]`, and an electronic data sheet
    /// with it.
    ///
    /// ## Why is this bad
    /// The section makes the difference between the two: it gives one device its node-ID and bit rate. Without it
    /// nobody knows for which node the values of a DCF are; in an EDS readers ignore it, or take the file for a DCF.
    ///
    /// ## Example
    /// ```dcf
    /// [FileInfo]
    /// FileName=drive.dcf
    /// LastEDS=drive.eds
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [FileInfo]
    /// FileName=drive.dcf
    /// LastEDS=drive.eds
    ///
    /// [DeviceComissioning]
    /// NodeID=5
    /// NodeName=Drive left
    /// Baudrate=500
    /// NetNumber=1
    /// NetworkName=Line 1
    /// LSS_SerialNumber=0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 5; CiA 306-1 v1.4, 7.3.5.
    pub(crate) static COMMISSIONING_MISSING = {
        code: "DCF001",
        name: "commissioning-missing",
        group: Configuration,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("MND001"), EdsDcfCheck("DCF001")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    match (context.kind, context.sheet.commissioning()) {
        (FileKind::Dcf, None) => {
            report
                .add(context.start(), "the DCF has no section `[DeviceComissioning]`")
                .help("add the section with `NodeID` and `Baudrate`, or name the file .eds");
        }
        (FileKind::Eds, Some(section)) => {
            let name = section.name();
            report
                .add(section.span(), format!("the EDS has a section `[{name}]`, which belongs into a DCF"))
                .help("name the file .dcf, or take the section out");
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings_in;

    #[test]
    fn only_a_dcf_has_the_section() {
        let with: &[u8] = b"[FileInfo]\n[DeviceCommissioning]\n";
        let without: &[u8] = b";x\n[FileInfo]\n";
        let found = |name: &str, text| findings_in(&COMMISSIONING_MISSING, name, text);
        assert!(found("a.dcf", with).is_empty() && found("a.eds", without).is_empty());
        assert_eq!(found("a.dcf", without), ["1:1 warning: the DCF has no section `[DeviceComissioning]`"]);
        assert_eq!(
            found("a.eds", with),
            ["2:1 warning: the EDS has a section `[DeviceCommissioning]`, which belongs into a DCF"]
        );
    }
}
