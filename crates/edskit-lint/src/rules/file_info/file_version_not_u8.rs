use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::meant::value_length;
use edskit_model::{Entry, KeyName, ValueErrorKind};

rule! {
    /// The file's version or revision is no integer from 0 to 255
    ///
    /// ## What it does
    /// Reports a `FileVersion` or `FileRevision` that cannot be read as an integer of 8 bits.
    ///
    /// ## Why is this bad
    /// Both are UNSIGNED8. Tools that keep them as numbers refuse `1.0` or take it for another version. The number
    /// before the dot is what `FileVersion` wants, the one behind it is what `FileRevision` is for.
    ///
    /// ## Example
    /// ```eds
    /// [FileInfo]
    /// FileVersion=1.0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// FileVersion=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.4.
    pub(crate) static FILE_VERSION_NOT_U8 = {
        code: "FIL003",
        name: "file-version-not-u8",
        group: FileInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("MND003")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(info) = context.sheet.file_info() else { return };
    for name in [KeyName::FileVersion, KeyName::FileRevision] {
        if let Some(entry) = info.filled(name) {
            check_entry(entry, report);
        }
    }
}

fn check_entry(entry: Entry<'_>, report: &mut Report) {
    let field = entry.unsigned::<u8>();
    let Err(error) = field.value else { return };
    if value_length(entry.raw()).is_some() {
        return;
    }
    let name = entry.key().name.spelling();
    let span = field.error_span().filter(|span| !span.is_empty()).unwrap_or(field.span());
    let finding =
        report.add(span, format!("{name} is `{}`, which is no integer from 0 to 255", field.text()));
    if !matches!(error.kind, ValueErrorKind::AboveMaximum(_)) {
        finding.here(error.to_string());
    }
    match main_number(entry.raw()) {
        Some(number) => finding
            .help(format!("write `{name}={number}`"))
            .unsafe_fix(format!("Write {number}"), vec![Edit::replace(field.span(), number.to_string())]),
        None => finding.help(format!("write a number from 0 to 255, such as `{name}=1`")),
    };
}

/// The number before the first dot of `1.0`, `V1.2.3` and the like.
fn main_number(text: &[u8]) -> Option<u8> {
    let text = text.strip_prefix(b"v").or(text.strip_prefix(b"V")).unwrap_or(text);
    let digits = text.iter().take_while(|byte| byte.is_ascii_digit()).count();
    matches!(text.get(digits), None | Some(b'.' | b',' | b'_')).then_some(())?;
    std::str::from_utf8(&text[..digits]).ok()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_number_before_the_dot_is_meant() {
        let text = "[FileInfo]\nFileVersion=V1.2.3\nFileRevision=08\n";
        assert_eq!(
            findings(&FILE_VERSION_NOT_U8, text),
            [
                "2:13 warning: FileVersion is `V1.2.3`, which is no integer from 0 to 255",
                "3:15 warning: FileRevision is `08`, which is no integer from 0 to 255"
            ]
        );
        assert_eq!(fixed(&FILE_VERSION_NOT_U8, text), "[FileInfo]\nFileVersion=1\nFileRevision=8\n");
    }

    #[test]
    fn other_texts_are_left_to_the_author() {
        for value in ["-", "2019", "300.1", "1-2", "0x1G", "-1"] {
            let text = format!("[FileInfo]\nFileVersion={value}\n");
            assert_eq!(findings(&FILE_VERSION_NOT_U8, &text).len(), 1, "{value}");
            assert_eq!(fixed(&FILE_VERSION_NOT_U8, &text), text);
        }
        for value in ["0x01", "255", "002", "", "1 ; first"] {
            let text = format!("[FileInfo]\nFileVersion={value}\n");
            assert!(findings(&FILE_VERSION_NOT_U8, &text).is_empty(), "{value}");
        }
    }
}
