use super::lost_header;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Key, KeyGroup, KeyName, SectionKind};

rule! {
    /// Entries stand before the first section
    ///
    /// ## What it does
    /// Reports entries above the first section header, once for the file.
    ///
    /// ## Why is this bad
    /// Every entry belongs to a section. Some readers refuse the file, others skip the entries. Often a header was
    /// lost together with a line break, or spelt so that it is none.
    ///
    /// ## Example
    /// ```eds
    /// FileName=example.eds
    /// FileVersion=1
    /// [DeviceInfo]
    /// VendorName=Example
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// FileName=example.eds
    /// FileVersion=1
    /// [DeviceInfo]
    /// VendorName=Example
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static ENTRY_OUTSIDE_SECTION = {
        code: "SYN007",
        name: "entry-outside-section",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [EdsDcfCheck("INI004")],
        check: File(check),
    }
}

/// Sections that a file may begin with, and whose header may be lost.
const FIRST: [(SectionKind, &str); 3] = [
    (SectionKind::FileInfo, "[FileInfo]"),
    (SectionKind::DeviceInfo, "[DeviceInfo]"),
    (SectionKind::Topology(1), "[Topology]"),
];

fn check(context: &Context<'_>, report: &mut Report) {
    let mut entries = context.sheet.entries_outside_sections();
    let Some(first) = entries.next() else { return };
    // A header that is only hidden in another line is reported there.
    if (0..first.line_number()).any(|number| lost_header::on_line(context, number).is_some()) {
        return;
    }
    let message = match entries.len() {
        0 => format!("the entry `{}` stands before the first section", first.key_text()),
        more => format!("{} entries stand before the first section", more + 1),
    };
    let finding = report.add(first.span(), message);
    let belongs_to = |kind: SectionKind| {
        let group = KeyGroup::of(kind);
        let known = |key: &[u8]| Key::of(group, key).name != KeyName::Unknown;
        context.sheet.section(kind).is_none()
            && context.sheet.entries_outside_sections().all(|e| known(e.key_span().slice(context.source())))
    };
    match FIRST.iter().find(|(kind, _)| belongs_to(*kind)) {
        Some((_, header)) => {
            let start = first.line().span().start;
            let line_break = context.document().line_ending().as_str();
            finding
                .help(format!("write `{header}` above"))
                .unsafe_fix("Write the header", vec![Edit::insert(start, format!("{header}{line_break}"))]);
        }
        None => {
            finding.help("write the header of their section above, or delete them");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_header_is_proposed_where_the_keys_tell() {
        assert_eq!(
            findings(&ENTRY_OUTSIDE_SECTION, "; c\nx=1\ny=2\n[1000]\n"),
            ["2:1 error: 2 entries stand before the first section"]
        );
        assert_eq!(
            fixed(&ENTRY_OUTSIDE_SECTION, "; c\r\nVendorName=a\r\n[FileInfo]\r\n"),
            "; c\r\n[DeviceInfo]\r\nVendorName=a\r\n[FileInfo]\r\n"
        );
        assert_eq!(fixed(&ENTRY_OUTSIDE_SECTION, "FileName=a\n[FileInfo]\n"), "FileName=a\n[FileInfo]\n");
    }

    #[test]
    fn a_hidden_header_is_reported_elsewhere() {
        assert_eq!(findings(&ENTRY_OUTSIDE_SECTION, "50[FileInfo]\nFileName=a\n[1000]\n"), [""; 0]);
    }
}
