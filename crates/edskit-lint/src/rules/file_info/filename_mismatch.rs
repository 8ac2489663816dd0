use crate::rule::rule;
use crate::{Context, Edit, Report};

rule! {
    /// FileName differs from the name of the file
    ///
    /// ## What it does
    /// Compares `FileName` with the name under which the file was opened. Case and folders do not count. The rule is
    /// off by default: more than half of the files in use were renamed at some time.
    ///
    /// ## Why is this bad
    /// The entry is there to name this very file. A name left over from a template sends a reader to another one.
    ///
    /// ## Example
    /// ```eds
    /// [FileInfo]
    /// FileName=old.eds
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// FileName=example.eds
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.4.
    pub(crate) static FILENAME_MISMATCH = {
        code: "FIL008",
        name: "filename-mismatch",
        group: FileInfo,
        severity: Info,
        enabled: false,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(actual) = context.file_name else { return };
    let Some(entry) = context.sheet.file_info().and_then(|info| info.file_name()) else { return };
    let written = entry.text();
    let name = written.rsplit(['/', '\\']).next().unwrap_or_default();
    if name.to_lowercase() == actual.to_lowercase() {
        return;
    }
    report
        .add(entry.value_span(), format!("FileName is `{written}`, but the file is called `{actual}`"))
        .help(format!("write `FileName={actual}`"))
        .unsafe_fix("Write the name of the file", vec![Edit::replace(entry.value_span(), actual)]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn case_and_folders_do_not_count() {
        for name in ["Test.EDS", "C:\\eds\\test.eds", "./test.eds", ""] {
            assert!(findings(&FILENAME_MISMATCH, &format!("[FileInfo]\nFileName={name}\n")).is_empty());
        }
        let text = "[FileInfo]\nFileName=tests.eds\n";
        assert_eq!(
            findings(&FILENAME_MISMATCH, text),
            ["2:10 info: FileName is `tests.eds`, but the file is called `test.eds`"]
        );
        assert_eq!(fixed(&FILENAME_MISMATCH, text), "[FileInfo]\nFileName=test.eds\n");
    }
}
