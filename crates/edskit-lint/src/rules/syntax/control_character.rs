use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::{Document, Line, LineKind, Span};

rule! {
    /// A control character stands in the text
    ///
    /// ## What it does
    /// Reports the bytes 00h to 1Fh, other than tabs and line ends, and 7Fh, once for each line. The mark `1Ah`
    /// (Ctrl-Z), with which DOS ended a file, is a warning at the end of the file.
    ///
    /// ## Why is this bad
    /// The file is a text. Readers stop at such a byte, take it for a part of the value, or refuse the file, and an
    /// editor does not show it.
    ///
    /// ## Example
    /// ```eds escaped
    /// [DeviceInfo]
    /// VendorName=Example\x00
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// VendorName=Example
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static CONTROL_CHARACTER = {
        code: "SYN025",
        name: "control-character",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

/// The mark for the end of a file in DOS.
const SUBSTITUTE: u8 = 0x1A;

fn is_control(byte: u8) -> bool {
    ((byte < 0x20) & (byte != b'\t') & (byte != b'\n') & (byte != b'\r')) | (byte == 0x7F)
}

/// Whether a line holds nothing but control characters and blanks, and at least one of the former.
pub(super) fn is_nothing_else(line: &[u8]) -> bool {
    line.iter().all(|&byte| is_control(byte) || matches!(byte, b' ' | b'\t'))
        && line.iter().any(|&b| is_control(b))
}

fn check(context: &Context<'_>, report: &mut Report) {
    let document = context.document();
    let lines = document.lines();
    for odd in context.odd_lines() {
        let line = &lines[odd.number];
        if !document.slice(line.span()).iter().any(|&byte| is_control(byte)) {
            continue;
        }
        let runs = runs(document, line);
        let Some(&first) = runs.first() else { continue };
        let byte = document.slice(first)[0];
        let alone = is_nothing_else(document.slice(line.span()));
        let last = || lines[odd.number + 1..].iter().all(|line| line.kind() == LineKind::Blank);
        if alone && byte == SUBSTITUTE && last() {
            report
                .add(first, "the end-of-file mark 1Ah (Ctrl-Z) of DOS stands at the end")
                .severity(Severity::Warning)
                .help("delete it; the end of a file needs no mark")
                .safe_fix("Delete the mark", runs.into_iter().map(Edit::delete).collect());
            continue;
        }
        let count: usize = runs.iter().map(|run| run.len()).sum();
        let message = match count {
            1 => format!("the control character {} stands in the text", shown(byte)),
            _ => format!("{count} control characters stand in the line, {} first", shown(byte)),
        };
        let edits = runs.into_iter().map(Edit::delete).collect();
        let finding = report.add(first, message).help("delete it, or write the character that was meant");
        if alone || line.kind() == LineKind::Comment {
            finding.safe_fix("Delete what is no text", edits);
        } else {
            finding.unsafe_fix("Delete what is no text", edits);
        }
    }
}

/// The places of control characters in a line.
fn runs(document: &Document, line: &Line) -> Vec<Span> {
    let mut runs: Vec<Span> = Vec::new();
    let start = line.span().start;
    for (offset, _) in document.slice(line.span()).iter().enumerate().filter(|(_, byte)| is_control(**byte)) {
        let place = start + offset as u32;
        match runs.last_mut() {
            Some(run) if run.end == place => run.end += 1,
            _ => runs.push(Span::new(place, place + 1)),
        }
    }
    runs
}

fn shown(byte: u8) -> String {
    let name = match byte {
        0x00 => " (NUL)",
        0x07 => " (bell)",
        0x08 => " (backspace)",
        0x0B => " (vertical tab)",
        0x0C => " (form feed)",
        SUBSTITUTE => " (Ctrl-Z)",
        0x1B => " (escape)",
        0x7F => " (delete)",
        _ => "",
    };
    format!("{byte:02X}h{name}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn each_line_is_reported_once() {
        assert_eq!(
            findings(&CONTROL_CHARACTER, "[1000]\n\x0C\nParameterName=a\0\0b\x07\n\tDataType=7\r\n"),
            [
                "2:1 error: the control character 0Ch (form feed) stands in the text",
                "3:16 error: 3 control characters stand in the line, 00h (NUL) first",
            ]
        );
        assert_eq!(
            fixed(&CONTROL_CHARACTER, "[1000]\n\x0C\nParameterName=Device\0\0 type\x07\n"),
            "[1000]\n\nParameterName=Device type\n"
        );
    }

    #[test]
    fn the_end_mark_of_dos_is_less_bad_but_only_at_the_end() {
        assert_eq!(
            findings(&CONTROL_CHARACTER, "[1000]\r\n\x1A\x1A\r\n\r\n"),
            ["2:1 warning: the end-of-file mark 1Ah (Ctrl-Z) of DOS stands at the end"]
        );
        assert_eq!(
            findings(&CONTROL_CHARACTER, "[1000]\n\x1A\nDataType=7\n"),
            ["2:1 error: the control character 1Ah (Ctrl-Z) stands in the text"]
        );
        assert_eq!(fixed(&CONTROL_CHARACTER, "[1000]\n\x1A"), "[1000]\n");
    }
}
