use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::{Line, SectionKind, Span};

rule! {
    /// A section header is not well formed
    ///
    /// ## What it does
    /// Reports headers without `]`, without a name, or with text behind the `]`; and, as a warning, blanks inside the
    /// brackets.
    ///
    /// ## Why is this bad
    /// Readers differ: some refuse the file, some take the header for an entry, some take the blanks for a part of
    /// the name. Then the section is not found, and its entries belong to the section before.
    ///
    /// ## Example
    /// ```eds
    /// [1018sub1
    /// ParameterName=Vendor-ID
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1018sub1]
    /// ParameterName=Vendor-ID
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static MALFORMED_SECTION = {
        code: "SYN006",
        name: "malformed-section",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [CanChkEds("2"), EdsDcfCheck("INI001")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for section in context.sheet.sections() {
        let line = section.line();
        if !is_well_formed(line, context.source()) {
            check_line(context, line, report);
        }
    }
}

/// Whether a header is a name in brackets without any blanks; they are so nearly always.
#[inline]
fn is_well_formed(line: &Line, source: &[u8]) -> bool {
    let is_blank = |byte: &u8| matches!(byte, b' ' | b'\t');
    let name = line.section_name(source);
    line.closing_bracket().is_some_and(|bracket| bracket.end == line.span().end)
        && matches!(name.slice(source), [first, ..] if !is_blank(first))
        && matches!(name.slice(source), [.., last] if !is_blank(last))
}

fn check_line(context: &Context<'_>, line: &Line, report: &mut Report) {
    let source = context.source();
    let header = line.trimmed(source);
    let inside = line.section_name(source);
    let name = inside.slice(source);
    let trimmed = name.trim_ascii();
    let text = || context.sheet.text(header);
    if trimmed.is_empty() {
        report
            .add(header, format!("the header `{}` has no name", text()))
            .help("write the name between the brackets, or delete the line");
        return;
    }
    let Some(bracket) = line.closing_bracket() else {
        report
            .add(header, format!("the header `{}` has no `]`", text()))
            .help(format!("write `{}]`", text()))
            .unsafe_fix("Write `]`", vec![Edit::insert(header.end, "]")]);
        return;
    };
    if bracket.end < header.end {
        behind(context, line, bracket, report);
    }
    if trimmed.len() < name.len() {
        let lead = name.len() - name.trim_ascii_start().len();
        let after = inside.sub(lead + trimmed.len(), name.len());
        let edits =
            [inside.sub(0, lead), after].into_iter().filter(|span| !span.is_empty()).map(Edit::delete);
        report
            .add(inside, "blanks stand inside the brackets")
            .severity(Severity::Warning)
            .help(format!("write `[{}]`", context.sheet.text(inside.sub(lead, trimmed.len()))))
            .safe_fix("Delete the blanks", edits.collect());
    }
}

/// Text behind the `]`: a comment, a second `]`, or what belongs into the next line.
fn behind(context: &Context<'_>, line: &Line, bracket: Span, report: &mut Report) {
    let source = context.source();
    let rest = line.after_header(source);
    let header = context.sheet.text(Span::new(line.trimmed(source).start, bracket.end));
    let line_break = context.document().line_ending().as_str();
    let gap = Span::new(bracket.end, rest.start);
    let finding = report.add(rest, format!("text stands behind the header `{header}`"));
    let raw = rest.slice(source);
    match raw.first() {
        Some(b';' | b'#') => {
            let comment = context.sheet.text(rest.sub(1, rest.len()));
            let edits = vec![
                Edit::insert(line.span().start, format!(";{comment}{line_break}")),
                Edit::delete(Span::new(bracket.end, rest.end)),
            ];
            finding
                .help("a comment stands in a line of its own and begins with `;`")
                .unsafe_fix("Write the comment above", edits);
        }
        Some(b']') if rest.len() == 1 => {
            finding.help("delete the second `]`").unsafe_fix("Delete it", vec![Edit::delete(rest)]);
        }
        _ if raw.contains(&b'=') || is_header(raw) => {
            finding
                .help("a line break was lost; begin a new line behind the `]`")
                .unsafe_fix("Begin a new line", vec![Edit::replace(gap, line_break)]);
        }
        _ => {
            finding.help("delete it, or write it in a line of its own");
        }
    }
}

fn is_header(text: &[u8]) -> bool {
    let name = text.strip_prefix(b"[").and_then(|text| text.strip_suffix(b"]"));
    name.is_some_and(|name| SectionKind::of(name) != SectionKind::Unknown)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn what_is_wrong_is_told() {
        assert_eq!(
            findings(&MALFORMED_SECTION, "[1000]\n[]\n[\n[ 1001\t]\n[1002 \n[1003]x\n  [1004]\n"),
            [
                "2:1 error: the header `[]` has no name",
                "3:1 error: the header `[` has no name",
                "4:2 warning: blanks stand inside the brackets",
                "5:1 error: the header `[1002` has no `]`",
                "6:7 error: text stands behind the header `[1003]`",
            ]
        );
    }

    #[test]
    fn headers_are_mended() {
        for (wrong, right) in [
            ("[ 1000 ]\n", "[1000]\n"),
            ("[1000 \n", "[1000] \n"),
            ("[1000]]\n", "[1000]\n"),
            ("[1000]DataType=7\n", "[1000]\nDataType=7\n"),
            ("[1000] [1001]\n", "[1000]\n[1001]\n"),
            ("[1000] ; type\n", "; type\n[1000]\n"),
            ("[1000] note\n", "[1000] note\n"),
        ] {
            assert_eq!(fixed(&MALFORMED_SECTION, wrong), right);
        }
    }
}
