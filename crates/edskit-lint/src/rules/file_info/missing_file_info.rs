use crate::rule::rule;
use crate::rules::syntax::lost_header;
use crate::{Context, Report};
use edskit_model::SectionKind;

rule! {
    /// The file has no section `[FileInfo]`
    ///
    /// ## What it does
    /// Reports a file without `[FileInfo]`. One whose header stands behind other text,
    /// because a line break was lost, is the matter of SYN008.
    ///
    /// ## Why is this bad
    /// The section is mandatory. It tells which edition of the format and which version of the file this is, so
    /// nobody can say whether two files differ on purpose.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// VendorName=Nordlicht
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// FileName=pump.eds
    /// FileVersion=1
    /// EDSVersion=4.0
    ///
    /// [DeviceInfo]
    /// VendorName=Nordlicht
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.4.
    pub(crate) static MISSING_FILE_INFO = {
        code: "FIL001",
        name: "missing-file-info",
        group: FileInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("1"), EdsDcfCheck("MND001")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    if context.sheet.file_info().is_some() || lost_header::hides(context, SectionKind::FileInfo) {
        return;
    }
    report
        .add(context.start(), "the file has no section `[FileInfo]`")
        .help("begin the file with `[FileInfo]` and its entries `FileName`, `FileVersion`, `EDSVersion=4.0` and so on");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn a_header_may_hide_in_a_line() {
        assert!(findings(&MISSING_FILE_INFO, "50[FileInfo]\nFileName=a.eds\n[1000]\n").is_empty());
        assert_eq!(findings(&MISSING_FILE_INFO, "; [FileInfo]\n[1000]\n").len(), 1);
        assert!(findings(&MISSING_FILE_INFO, "[1000]\n[fileinfo]\n").is_empty());
    }
}
