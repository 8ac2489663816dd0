use crate::rule::rule;
use crate::{Context, Edit, FileKind, Report};
use edskit_model::KeyName;

rule! {
    /// LastEDS is missing in a DCF, or stands in an EDS
    ///
    /// ## What it does
    /// Reports a DCF whose `[FileInfo]` does not name the EDS that it was made from, and an EDS that does.
    ///
    /// ## Why is this bad
    /// `LastEDS` is mandatory in a DCF: it leads back to the description that the configuration belongs to. In an EDS
    /// it has no meaning; it hints at a DCF that was saved under the wrong ending. Most tools leave the entry out, so
    /// both are only infos.
    ///
    /// ## Example
    /// ```dcf
    /// [FileInfo]
    /// FileName=pump-5.dcf
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [FileInfo]
    /// FileName=pump-5.dcf
    /// LastEDS=pump.eds
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 5.2.
    pub(crate) static LAST_EDS = {
        code: "FIL010",
        name: "last-eds",
        group: FileInfo,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(info) = context.sheet.file_info() else { return };
    match (context.kind, info.last_eds()) {
        (FileKind::Dcf, None) => {
            let message = "the DCF does not name the EDS that it was made from";
            match info.entry(KeyName::LastEds) {
                Some(empty) => report.add(empty.span(), message).here("an empty entry counts as missing"),
                None => report.add(info.span(), message),
            }
            .help("write the file name of the EDS, such as `LastEDS=device.eds`");
        }
        (FileKind::Eds, Some(entry)) => {
            report
                .add(entry.span(), format!("LastEDS is `{}`, but only a DCF has this entry", entry.text()))
                .help("take the entry out, or call the file a DCF if it is one")
                .unsafe_fix("Take the entry out", vec![Edit::delete(entry.line().full_span())]);
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in, fixed};

    #[test]
    fn an_eds_has_no_predecessor() {
        let text = "[FileInfo]\nLastEDS=a.eds\nFileVersion=1\n";
        assert_eq!(
            findings(&LAST_EDS, text),
            ["2:1 info: LastEDS is `a.eds`, but only a DCF has this entry"]
        );
        assert_eq!(fixed(&LAST_EDS, text), "[FileInfo]\nFileVersion=1\n");
        assert!(findings(&LAST_EDS, "[FileInfo]\nLastEDS=\n").is_empty());
    }

    #[test]
    fn a_dcf_has_one() {
        assert_eq!(
            findings_in(&LAST_EDS, "a.dcf", b"[FileInfo]\nLastEDS=\n"),
            ["2:1 info: the DCF does not name the EDS that it was made from"]
        );
        assert!(findings_in(&LAST_EDS, "a.dcf", b"[DeviceInfo]\n").is_empty());
    }
}
