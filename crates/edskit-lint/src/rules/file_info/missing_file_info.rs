use crate::missing::lost_header;
use crate::rule::rule;
use crate::{Context, Report};

rule! {
    /// The file has no section `[FileInfo]`
    ///
    /// ## What it does
    /// Reports a file without `[FileInfo]`. If the header hides in the middle of another line, that line is shown.
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
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    if context.sheet.file_info().is_some() || lost_header(context, "[FileInfo]", report) {
        return;
    }
    report
        .add(context.start(), "the file has no section `[FileInfo]`")
        .help("begin the file with `[FileInfo]` and its entries `FileName`, `FileVersion`, `EDSVersion=4.0` and so on");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn a_header_may_hide_in_a_line() {
        let text = "50[FileInfo]\nFileName=a.eds\n[1000]\n";
        assert_eq!(
            findings(&MISSING_FILE_INFO, text),
            ["1:3 warning: the header `[FileInfo]` does not begin its line, so the section is missing"]
        );
        assert_eq!(fixed(&MISSING_FILE_INFO, text), "50\n[FileInfo]\nFileName=a.eds\n[1000]\n");
        assert_eq!(findings(&MISSING_FILE_INFO, "; [FileInfo]\n[1000]\n").len(), 1);
        assert!(findings(&MISSING_FILE_INFO, "[1000]\n[fileinfo]\n").is_empty());
    }
}
