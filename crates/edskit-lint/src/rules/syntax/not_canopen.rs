use super::lost_header;
use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::SectionKind;
use edskit_model::nature::Nature;

rule! {
    /// The file is not a CANopen file at all
    ///
    /// ## What it does
    /// Recognises files that only end like an EDS, DCF or nodelist.cpj: archives, XML device descriptions, UTF-16
    /// text, data sheets of other networks, files of edskit itself, binaries, empty files, texts without a single section
    /// that CiA 306 knows.
    /// Such a file gets this one finding and no other.
    ///
    /// ## Why is this bad
    /// No CANopen tool can read the file. A list of a thousand syntax errors would hide the reason.
    ///
    /// ## Example
    /// ```eds
    /// [File]
    /// DescText = "EtherNet/IP device";
    /// [Device]
    /// VendCode = 1;
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// FileName=device.eds
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static NOT_CANOPEN = {
        code: "SYN000",
        name: "not-canopen",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [EdsDcfCheck("LIB002")],
        check: File(check),
    }
}

/// Whether the file is something else, so that no other rule makes sense.
pub(crate) fn is_foreign(context: &Context<'_>) -> bool {
    let has_header = || context.sheet.sections().any(|section| section.kind() != SectionKind::Unknown);
    Nature::of(context.source()) != Nature::Text || !(has_header() || lost_header::is_anywhere(context))
}

pub(crate) fn check(context: &Context<'_>, report: &mut Report) {
    if !is_foreign(context) {
        return;
    }
    let (message, help) = match Nature::of(context.source()) {
        Nature::Empty => ("the file is empty", "write the file again; the tool that made it may have failed"),
        Nature::Utf16 => (
            "the file is UTF-16 text, which no CANopen tool reads",
            "save it again as ASCII or UTF-8 without a byte order mark",
        ),
        Nature::Zip => ("the file is a zip archive", "unpack it and check the EDS inside"),
        Nature::Gzip => ("the file is gzip-compressed", "unpack it and check the EDS inside"),
        Nature::Pdf => ("the file is a PDF document", "ask the supplier for the EDS itself"),
        Nature::Xml { canopen: true } => (
            "the file is an XML device description (XDD or XDC, CiA 311)",
            "convert it to an EDS or DCF first; this tool reads the INI form of CiA 306",
        ),
        Nature::Xml { canopen: false } => ("the file is XML", "an EDS is an INI text; this is another file"),
        Nature::Html => {
            ("the file is an HTML page", "a download gave the web page instead of the EDS; load it again")
        }
        Nature::EthernetIp => (
            "the file is an EDS of EtherNet/IP, DeviceNet or another ODVA network, not of CANopen",
            "the two formats share only the name; use a tool for ODVA electronic data sheets",
        ),
        Nature::Own(own) => {
            report.add(context.start(), format!("the file is {}", own.name())).help(own.command());
            return;
        }
        Nature::Json => {
            ("the file is JSON", "an EDS is an INI text; a download may have given an error message instead")
        }
        Nature::Binary => {
            ("the file is binary", "an EDS is an INI text; this is another file, or it is damaged")
        }
        Nature::Text => (
            "the file has no section that CiA 306 knows",
            "an EDS begins with `[FileInfo]` and `[DeviceInfo]`; this is another file, or its headers are lost",
        ),
    };
    report.add(context.start(), message).help(help);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings_in;

    #[test]
    fn what_a_file_is_instead() {
        let first = |bytes: &[u8]| findings_in(&NOT_CANOPEN, "a.eds", bytes).join("|");
        assert_eq!(first(b""), "1:1 error: the file is empty");
        assert_eq!(first(b"PK\x03\x04...."), "1:1 error: the file is a zip archive");
        assert_eq!(
            first(b"\xFF\xFE[\0F\0"),
            "1:1 error: the file is UTF-16 text, which no CANopen tool reads"
        );
        assert_eq!(first(b"[[step]]\nat = 1\n"), "1:1 error: the file is a scenario of edskit");
        assert_eq!(
            first(b"int main() { return a = 1; }\n"),
            "1:1 error: the file has no section that CiA 306 knows"
        );
        assert_eq!(first(b"50[FileInfo]\nFileName=a.eds\n"), "");
        assert_eq!(first(b"[Topology]\nNodes=0\n"), "");
        assert_eq!(first(b"<<<<<<< HEAD\n[1000]\n"), "");
    }
}
