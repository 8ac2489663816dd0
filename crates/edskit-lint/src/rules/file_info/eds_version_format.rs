use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::KeyName;
use edskit_model::meant::value_length;

rule! {
    /// EDSVersion is missing, old, or not of the form `x.y`
    ///
    /// ## What it does
    /// Reports an `EDSVersion` that is not one digit, a dot and one digit. A missing one, which means 3.0, and one
    /// below 4.0 are an info.
    ///
    /// ## Why is this bad
    /// The edition tells how the file is to be read. Files that follow CiA 306 v1.3 or later have 4.0; a reader that
    /// finds an older edition may ignore what is new since then.
    ///
    /// ## Example
    /// ```eds
    /// [FileInfo]
    /// EDSVersion=404
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// EDSVersion=4.0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.4.
    pub(crate) static EDS_VERSION_FORMAT = {
        code: "FIL004",
        name: "eds-version-format",
        group: FileInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [CanChkEds("41"), EdsDcfCheck("MND003")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(info) = context.sheet.file_info() else { return };
    let Some(entry) = info.eds_version() else {
        let (span, edit) = match info.entry(KeyName::EdsVersion) {
            Some(empty) => (empty.span(), Edit::insert(empty.value_span().start, "4.0")),
            None => {
                let line = format!("{}EDSVersion=4.0", context.document().line_ending().as_str());
                (info.span(), Edit::insert(info.end().start, line))
            }
        };
        report
            .add(span, "without `EDSVersion` the file counts as edition 3.0")
            .severity(Severity::Info)
            .help("write `EDSVersion=4.0` for a file that follows CiA 306 v1.3 or later")
            .unsafe_fix("Write 4.0", vec![edit]);
        return;
    };
    let raw = entry.raw();
    let span = entry.value_span();
    match *raw {
        [b'0'..=b'3', b'.', b'0'..=b'9'] => {
            report
                .add(span, format!("EDSVersion is `{}`, an edition before 4.0", entry.text()))
                .severity(Severity::Info)
                .help("write `EDSVersion=4.0` if the file follows CiA 306 v1.3 or later");
        }
        [b'0'..=b'9', b'.', b'0'..=b'9'] => {}
        _ if value_length(raw).is_some() => {}
        _ => {
            let message = format!("EDSVersion is `{}`, which is not of the form `x.y`", entry.text());
            let finding = report.add(span, message);
            match meant(raw) {
                Some(version) => finding
                    .help(format!("write `EDSVersion={version}`"))
                    .unsafe_fix(format!("Write {version}"), vec![Edit::replace(span, version)]),
                None => finding.help("write `EDSVersion=4.0` for a file that follows CiA 306 v1.3 or later"),
            };
        }
    }
}

/// The edition that `4`, `404`, `4.04`, `V4.0` and the like stand for.
fn meant(text: &[u8]) -> Option<&'static str> {
    let text = text.strip_prefix(b"v").or(text.strip_prefix(b"V")).unwrap_or(text);
    let (version, rest) = match text {
        [b'3', rest @ ..] => ("3.0", rest),
        [b'4', rest @ ..] => ("4.0", rest),
        _ => return None,
    };
    let minor = rest.strip_prefix(b".").or(rest.strip_prefix(b",")).unwrap_or(rest);
    (minor.is_empty() || minor.starts_with(b"0")).then_some(version)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn with(version: &str) -> String {
        format!("[FileInfo]\nEDSVersion={version}\n")
    }

    #[test]
    fn the_edition_that_was_meant_is_offered() {
        for version in ["4", "404", "402", "4.04", "40", "4,0", "V4.0", "4.0.0"] {
            assert_eq!(
                findings(&EDS_VERSION_FORMAT, &with(version)),
                [format!("2:12 warning: EDSVersion is `{version}`, which is not of the form `x.y`")]
            );
            assert_eq!(fixed(&EDS_VERSION_FORMAT, &with(version)), with("4.0"));
        }
        for version in ["5", "4.12", "abc", "DS306"] {
            assert_eq!(findings(&EDS_VERSION_FORMAT, &with(version)).len(), 1);
            assert_eq!(fixed(&EDS_VERSION_FORMAT, &with(version)), with(version));
        }
    }

    #[test]
    fn a_missing_or_old_one_is_an_info() {
        assert_eq!(
            findings(&EDS_VERSION_FORMAT, &with("")),
            ["2:1 info: without `EDSVersion` the file counts as edition 3.0"]
        );
        assert_eq!(fixed(&EDS_VERSION_FORMAT, &with("")), with("4.0"));
        assert_eq!(
            fixed(&EDS_VERSION_FORMAT, "[FileInfo]\r\n[1000]\r\n"),
            "[FileInfo]\r\nEDSVersion=4.0\r\n[1000]\r\n"
        );
        assert_eq!(
            findings(&EDS_VERSION_FORMAT, &with("2.0")),
            ["2:12 info: EDSVersion is `2.0`, an edition before 4.0"]
        );
        for version in ["4.0", "4.2", "5.0", "4.0 ; new"] {
            assert!(findings(&EDS_VERSION_FORMAT, &with(version)).is_empty(), "{version}");
        }
    }
}
