use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::LineKind;

rule! {
    /// Blanks stand before a comment
    ///
    /// ## What it does
    /// Reports comments whose `;` is not the first character of the line.
    ///
    /// ## Why is this bad
    /// A comment begins in column 1. Readers that keep to it see a line that is neither section, entry nor comment, or
    /// an entry where the comment holds a `=`.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    ///   ; the type of the device
    /// ParameterName=Device type
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ; the type of the device
    /// ParameterName=Device type
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static COMMENT_NOT_IN_COLUMN_1 = {
        code: "SYN010",
        name: "comment-not-in-column-1",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let source = context.source();
    for odd in context.odd_lines() {
        let line = &context.document().lines()[odd.number];
        let blanks = line.indentation(source);
        if line.kind() == LineKind::Comment
            && !blanks.is_empty()
            && source.get(blanks.end as usize) == Some(&b';')
        {
            report
                .add(blanks, "the comment does not begin in column 1")
                .help("delete the blanks before `;`")
                .safe_fix("Delete the blanks", vec![Edit::delete(blanks)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn only_comments_with_a_semicolon_are_meant() {
        let text = "[1000]\n;a\n \t;b\n #c\n  DataType=7\n";
        assert_eq!(
            findings(&COMMENT_NOT_IN_COLUMN_1, text),
            ["3:1 warning: the comment does not begin in column 1"]
        );
        assert_eq!(fixed(&COMMENT_NOT_IN_COLUMN_1, text), "[1000]\n;a\n;b\n #c\n  DataType=7\n");
    }
}
