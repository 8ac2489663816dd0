use crate::rule::rule;
use crate::{Context, Edit, Report};

rule! {
    /// Blanks stand before a section header
    ///
    /// ## What it does
    /// Reports section headers whose `[` is not the first character of the line.
    ///
    /// ## Why is this bad
    /// CiA 306 wants the `[` in column 1. Readers that keep to it miss the header and count its entries to the section
    /// before; python-canopen takes the line for a continuation of the value above.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    ///   [1001]
    /// ParameterName=Error register
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// [1001]
    /// ParameterName=Error register
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static SECTION_NOT_IN_COLUMN_1 = {
        code: "SYN005",
        name: "section-not-in-column-1",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [CanChkEds("3")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let source = context.source();
    for section in context.sheet.sections() {
        let line = section.line();
        let blanks = line.indentation(source);
        if !blanks.is_empty() {
            let header = context.sheet.text(line.trimmed(source));
            report
                .add(blanks, format!("the header `{header}` does not begin in column 1"))
                .help("delete the blanks before `[`")
                .safe_fix("Delete the blanks", vec![Edit::delete(blanks)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn tabs_and_blanks_are_both_reported() {
        let text = "[1000]\n\t[1001]\n  [1002\nDataType=7\n";
        assert_eq!(
            findings(&SECTION_NOT_IN_COLUMN_1, text),
            [
                "2:1 error: the header `[1001]` does not begin in column 1",
                "3:1 error: the header `[1002` does not begin in column 1"
            ]
        );
        assert_eq!(fixed(&SECTION_NOT_IN_COLUMN_1, text), "[1000]\n[1001]\n[1002\nDataType=7\n");
    }
}
