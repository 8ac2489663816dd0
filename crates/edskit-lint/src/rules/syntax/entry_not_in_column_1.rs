use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::Entry;

rule! {
    /// Blanks stand before a key
    ///
    /// ## What it does
    /// Reports entries whose key is not at the beginning of the line.
    ///
    /// ## Why is this bad
    /// CiA 306 describes an entry as key, `=` and value, with white space only around the value. To python-canopen, and
    /// to whatever else reads with Python's INI reader, a line that is indented deeper than the entry above goes on
    /// with that entry's value: the indented entry is lost and the one above is wrong.
    ///
    /// ## Example
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    ///   DataType=0x0007
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// DataType=0x0007
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2. Engineering judgement: the standard names column 1 only for sections and comments, but
    /// readers need it for entries as well.
    pub(crate) static ENTRY_NOT_IN_COLUMN_1 = {
        code: "SYN026",
        name: "entry-not-in-column-1",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let source = context.source();
    for line in context.odd_entries().map(Entry::line) {
        let blanks = line.indentation(source);
        if !blanks.is_empty() {
            report
                .add(
                    blanks,
                    format!("the key `{}` does not begin in column 1", context.sheet.text(line.key(source))),
                )
                .help("delete the blanks before the key")
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
        let text = "[1000]\n\tDataType=7\n AccessType=ro\n\n  ;x=1\n";
        assert_eq!(
            findings(&ENTRY_NOT_IN_COLUMN_1, text),
            [
                "2:1 warning: the key `DataType` does not begin in column 1",
                "3:1 warning: the key `AccessType` does not begin in column 1"
            ]
        );
        assert_eq!(fixed(&ENTRY_NOT_IN_COLUMN_1, text), "[1000]\nDataType=7\nAccessType=ro\n\n  ;x=1\n");
    }
}
