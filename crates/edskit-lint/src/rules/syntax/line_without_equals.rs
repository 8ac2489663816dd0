use super::{control_character, lost_header};
use crate::conflicts::Conflicts;
use crate::rule::rule;
use crate::{Context, Edit, Finding, Report};
use edskit_model::{Document, Key, KeyGroup, KeyName, Line, LineKind, Section, Span};
use std::collections::HashSet;

rule! {
    /// A line is neither section, entry nor comment
    ///
    /// ## What it does
    /// Reports text without `=`, a `=` without a key, and what is easily explained: a conflict of a version control
    /// system, and a section header that stands behind other text because a line break was lost. A conflict is one
    /// finding: what stands between its markers is not judged, and of the rest only what is wrong whichever text is
    /// kept.
    ///
    /// ## Why is this bad
    /// Some readers refuse such a file, others skip the line with whatever it was meant to say. In a conflict both
    /// texts stand in the file, and readers take them for one. The entries of a lost header belong to the section
    /// before.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// PDOMapping=0[1001]
    /// ParameterName=Error register
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// PDOMapping=0
    /// [1001]
    /// ParameterName=Error register
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static LINE_WITHOUT_EQUALS = {
        code: "SYN008",
        name: "line-without-equals",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [EdsDcfCheck("INI001")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let mut sections = context.sheet.sections().peekable();
    let mut section = None;
    for (number, line) in context.document().lines().iter().enumerate() {
        if line.kind() == LineKind::Other {
            while let Some(above) = sections.next_if(|next| next.line_number() < number) {
                section = Some(above);
            }
            other(context, number, line, section, report);
        }
    }
    for entry in context.odd_entries() {
        if entry.raw().ends_with(b"]")
            && let Some(header) = lost_header::on_line(context, entry.line_number())
        {
            lost(context, header, report);
        }
    }
}

fn lost(context: &Context<'_>, header: Span, report: &mut Report) {
    let name = context.sheet.text(header);
    let line_break = context.document().line_ending().as_str();
    report
        .add(header, format!("the header `{name}` stands behind other text; a line break was lost"))
        .help(format!("write `{name}` in a line of its own"))
        .unsafe_fix("Begin a new line", vec![Edit::insert(header.start, line_break)]);
}

/// Where this rule found a header behind a value, the value is not what anybody wrote: other findings on the line go.
pub(crate) fn take_over_lost_headers(context: &Context<'_>, findings: &mut Vec<Finding>) {
    let line = |finding: &Finding| context.document().line_at(finding.span().start);
    let is_lost = |finding: &&Finding| {
        finding.rule == &LINE_WITHOUT_EQUALS && finding.span().slice(context.source()).starts_with(b"[")
    };
    let lines: HashSet<usize> = findings.iter().filter(is_lost).map(line).collect();
    if lines.is_empty() {
        return;
    }
    // What is missing in the file as a whole is told at the start of its first line, which may be such a line.
    let is_in_value = |finding: &Finding| {
        let start = finding.span().start;
        start > context.document().lines()[context.document().line_at(start)].trimmed(context.source()).start
    };
    findings.retain(|finding| {
        finding.rule == &LINE_WITHOUT_EQUALS || !lines.contains(&line(finding)) || !is_in_value(finding)
    });
}

fn other(
    context: &Context<'_>,
    number: usize,
    line: &Line,
    section: Option<Section<'_>>,
    report: &mut Report,
) {
    let content = line.trimmed(context.source());
    let raw = content.slice(context.source());
    let text = context.sheet.text(content);
    if control_character::is_nothing_else(raw) {
        return;
    }
    if let Some(header) = lost_header::on_line(context, number) {
        lost(context, header, report);
    } else if raw.first() == Some(&b'=') {
        report.add(content, format!("the key is missing in `{text}`")).help("write the key before `=`");
    } else if let Some((key, separator)) = key_without_equals(context, content, section) {
        let end = if separator.end == content.end { "" } else { " and the value" };
        report
            .add(separator, format!("`=` is missing behind the key `{}`", context.sheet.text(key)))
            .help(format!("write `=`{end} directly behind the key"))
            .unsafe_fix("Write `=`", vec![Edit::replace(separator, "=")]);
    } else {
        let help = match raw {
            [b'/', b'/' | b'*', ..] | [b'-', b'-', ..] => "a comment begins with `;` in column 1",
            _ => {
                "write `;` before it if it is a comment, or join it with the line above if it belongs to the text there"
            }
        };
        report.add(content, format!("`{text}` is neither section, entry nor comment")).help(help);
    }
}

/// Reports each conflict once, whatever stands in it, and each marker that belongs to none.
pub(crate) fn report_conflicts(document: &Document, conflicts: &Conflicts, report: &mut Report) {
    let place = |number: usize| document.lines()[number].trimmed(document.to_bytes());
    for conflict in conflicts.whole() {
        let mut markers = conflict.markers().map(place);
        let Some(first) = markers.next() else { continue };
        let finding = report
            .add(first, "a version control system left a conflict here: two texts stand in the place of one");
        finding.here("one text begins here");
        let mut rest: Vec<Span> = markers.collect();
        let end = rest.pop();
        if let [.., separator] = rest[..] {
            finding.label(separator, "the other one");
        }
        if let Some(end) = end {
            finding.label(end, "the conflict ends");
        }
        finding.help("keep the text that is right, and delete the other one with the markers; until then no fix changes anything here");
    }
    for &number in conflicts.stray() {
        let span = place(number);
        report
            .add(span, format!("`{}` is a conflict marker of a version control system", document.text(span)))
            .help("decide which text is right, and delete the marker with the other one; until then no fix changes this file");
    }
}

/// A known key at the start of a line, and the blanks or the colon in the place of its `=`.
fn key_without_equals(
    context: &Context<'_>,
    content: Span,
    section: Option<Section<'_>>,
) -> Option<(Span, Span)> {
    let raw = content.slice(context.source());
    let is_separator = |byte: u8| matches!(byte, b' ' | b'\t' | b':');
    let length = raw.iter().position(|&byte| is_separator(byte)).unwrap_or(raw.len());
    let separator = raw[length..].iter().position(|&byte| !is_separator(byte)).unwrap_or(raw.len() - length);
    let key = Key::of(KeyGroup::of(section?.kind()), &raw[..length]).name;
    let known = !matches!(key, KeyName::Unknown | KeyName::Item);
    known.then(|| (content.sub(0, length), content.sub(length, separator)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn stray_lines_are_named() {
        assert_eq!(
            findings(&LINE_WITHOUT_EQUALS, "[1000]\nhello there\n=5\n// note\n\x1A\n\n[1001\n"),
            [
                "2:1 error: `hello there` is neither section, entry nor comment",
                "3:1 error: the key is missing in `=5`",
                "4:1 error: `// note` is neither section, entry nor comment",
            ]
        );
    }

    #[test]
    fn a_conflict_is_one_finding() {
        for base in ["", "||||||| base\n[1002]\nhello\n"] {
            let text = format!(
                "[FileInfo]\n<<<<<<< HEAD\n[1000]\nhello\n{base}=======\n[1001]\n=5\n>>>>>>> a=b\nthere\n"
            );
            let found = findings(&LINE_WITHOUT_EQUALS, &text);
            assert_eq!(found.len(), 2, "{found:?}");
            assert_eq!(
                found[0],
                "2:1 error: a version control system left a conflict here: two texts stand in the place of one"
            );
            assert!(found[1].ends_with("error: `there` is neither section, entry nor comment"));
        }
    }

    #[test]
    fn a_stray_marker_is_named() {
        assert_eq!(
            findings(&LINE_WITHOUT_EQUALS, "[1000]\nx=1\n=======\ny=1\n>>>>>>> other\n"),
            [
                "3:1 error: `=======` is a conflict marker of a version control system",
                "5:1 error: `>>>>>>> other` is a conflict marker of a version control system",
            ]
        );
    }

    #[test]
    fn lost_line_breaks_are_named_and_mended() {
        assert_eq!(
            findings(&LINE_WITHOUT_EQUALS, "50[FileInfo]\nFileName=a\n[1000]\n"),
            ["1:3 error: the header `[FileInfo]` stands behind other text; a line break was lost"]
        );
        assert_eq!(
            fixed(&LINE_WITHOUT_EQUALS, "[1000]\r\nPDOMapping=0[1001]\r\n"),
            "[1000]\r\nPDOMapping=0\r\n[1001]\r\n"
        );
    }

    #[test]
    fn a_known_key_lacks_only_its_equals() {
        let text = "[1000]\nDataType: 0x7\nAccessType ro\nObjFlags\nProductName x\n";
        assert_eq!(
            findings(&LINE_WITHOUT_EQUALS, text),
            [
                "2:9 error: `=` is missing behind the key `DataType`",
                "3:11 error: `=` is missing behind the key `AccessType`",
                "4:9 error: `=` is missing behind the key `ObjFlags`",
                "5:1 error: `ProductName x` is neither section, entry nor comment",
            ]
        );
        assert_eq!(
            fixed(&LINE_WITHOUT_EQUALS, text),
            "[1000]\nDataType=0x7\nAccessType=ro\nObjFlags=\nProductName x\n"
        );
    }
}
