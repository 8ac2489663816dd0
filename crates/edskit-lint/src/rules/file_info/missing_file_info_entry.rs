use crate::missing::Missing;
use crate::rule::rule;
use crate::{Context, Report, Severity};
use edskit_model::KeyName;

rule! {
    /// A mandatory entry of `[FileInfo]` is missing
    ///
    /// ## What it does
    /// Reports which of the mandatory entries of `[FileInfo]` are absent or empty, all in one finding. If only the
    /// free texts `Description`, `CreatedBy` and `ModifiedBy` are, the finding is an info. `EDSVersion` and `LastEDS`
    /// have rules of their own.
    ///
    /// ## Why is this bad
    /// Name, version and dates tell which of two files for a device is the right one. An empty entry equals a missing
    /// one. The free texts are read by people only, and a third of the files in use lack one.
    ///
    /// ## Example
    /// ```eds
    /// [FileInfo]
    /// FileName=example.eds
    /// FileVersion=1
    /// Description=
    /// CreationTime=09:45AM
    /// CreationDate=03-25-2016
    /// CreatedBy=H. Olsen
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// FileName=example.eds
    /// FileVersion=1
    /// FileRevision=0
    /// Description=Pump controller
    /// CreationTime=09:45AM
    /// CreationDate=03-25-2016
    /// CreatedBy=H. Olsen
    /// ModificationTime=01:10PM
    /// ModificationDate=04-02-2016
    /// ModifiedBy=H. Olsen
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2 and 4.4. The severity is engineering judgement: it follows what files in use lack.
    pub(crate) static MISSING_FILE_INFO_ENTRY = {
        code: "FIL002",
        name: "missing-file-info-entry",
        group: FileInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("26"), CanChkEds("recommended key missing"), EdsDcfCheck("MND002")],
        check: File(check),
    }
}

const MANDATORY: [KeyName; 10] = [
    KeyName::FileName,
    KeyName::FileVersion,
    KeyName::FileRevision,
    KeyName::Description,
    KeyName::CreationTime,
    KeyName::CreationDate,
    KeyName::CreatedBy,
    KeyName::ModificationTime,
    KeyName::ModificationDate,
    KeyName::ModifiedBy,
];

const FREE_TEXTS: [KeyName; 3] = [KeyName::Description, KeyName::CreatedBy, KeyName::ModifiedBy];

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(info) = context.sheet.file_info() else { return };
    let Some(missing) = Missing::of(*info, &MANDATORY) else { return };
    let computed = |key| context.file_name.filter(|_| key == KeyName::FileName).map(str::to_owned);
    let finding = missing.report(context, computed, report);
    if missing.keys().all(|key| FREE_TEXTS.contains(&key)) {
        finding.severity(Severity::Info);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    const COMPLETE: &str = "[FileInfo]\nFileName=a\nFileVersion=1\nFileRevision=1\nDescription=d\nCreationTime=01:00AM\nCreationDate=01-01-2020\nCreatedBy=x\nModificationTime=01:00AM\nModificationDate=01-01-2020\nModifiedBy=x\n";

    #[test]
    fn free_texts_alone_are_an_info() {
        assert!(findings(&MISSING_FILE_INFO_ENTRY, COMPLETE).is_empty());
        let text = COMPLETE.replace("CreatedBy=x\n", "").replace("Description=d", "Description=");
        assert_eq!(
            findings(&MISSING_FILE_INFO_ENTRY, &text),
            ["1:1 info: `[FileInfo]` has no `CreatedBy`; `Description` is empty"]
        );
        let text = COMPLETE.replace("CreatedBy=x", "CreatedBy=").replace("Description=d", "Description=");
        assert_eq!(
            findings(&MISSING_FILE_INFO_ENTRY, &text),
            ["5:1 info: `Description` and `CreatedBy` of `[FileInfo]` are empty"]
        );
    }

    #[test]
    fn other_entries_are_a_warning_and_the_name_is_known() {
        let text = COMPLETE.replace("FileName=a\n", "").replace("FileVersion=1\n", "");
        assert_eq!(
            findings(&MISSING_FILE_INFO_ENTRY, &text),
            ["1:1 warning: `[FileInfo]` has no `FileName` or `FileVersion`"]
        );
        assert!(fixed(&MISSING_FILE_INFO_ENTRY, &text).ends_with("ModifiedBy=x\nFileName=test.eds\n"));
        let text = COMPLETE.replace("FileName=a", "FileName = ");
        assert!(fixed(&MISSING_FILE_INFO_ENTRY, &text).contains("FileName = test.eds\n"));
        assert!(findings(&MISSING_FILE_INFO_ENTRY, "[DeviceInfo]\n").is_empty());
    }
}
