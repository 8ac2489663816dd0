use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::{LineKind, Span};

rule! {
    /// A line begins with `#`
    ///
    /// ## What it does
    /// Reports lines that begin with `#`, which many tools write and skip as comments. With a `=` in it the line is a
    /// warning: readers that do not know such comments take it for an entry of their own kind.
    ///
    /// ## Why is this bad
    /// CiA 306 knows only `;` for comments. To other readers `#Key=value` is an entry with an odd key, and a line
    /// without `=` is an error.
    ///
    /// ## Example
    /// ```dcf
    /// [6060]
    /// ParameterName=Modes of operation
    /// #ParameterValue=6
    /// ```
    ///
    /// ## Use instead
    /// ```dcf
    /// [6060]
    /// ParameterName=Modes of operation
    /// ;ParameterValue=6
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static HASH_COMMENT = {
        code: "SYN011",
        name: "hash-comment",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let source = context.source();
    for odd in context.odd_lines() {
        let line = &context.document().lines()[odd.number];
        let start = line.indentation(source).end;
        if line.kind() != LineKind::Comment || source.get(start as usize) != Some(&b'#') {
            continue;
        }
        // Blanks before the mark go too, since a comment begins in column 1.
        let edit = Edit::replace(Span::new(line.span().start, start + 1), ";");
        let finding = report.add(Span::new(start, start + 1), "`#` does not begin a comment");
        finding.help("write `;` instead").safe_fix("Begin the comment with `;`", vec![edit]);
        if line.trimmed(source).slice(source).contains(&b'=') {
            finding.severity(Severity::Warning);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn a_hash_elsewhere_is_text() {
        let text = "[1000]\n# a\n  #b=1\nParameterName=#1\n; # c\n";
        assert_eq!(
            findings(&HASH_COMMENT, text),
            ["2:1 error: `#` does not begin a comment", "3:3 warning: `#` does not begin a comment"]
        );
        assert_eq!(fixed(&HASH_COMMENT, text), "[1000]\n; a\n;b=1\nParameterName=#1\n; # c\n");
    }
}
