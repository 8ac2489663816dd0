use crate::rule::rule;
use crate::{Context, Edit, Report};

rule! {
    /// The file begins with a byte order mark
    ///
    /// ## What it does
    /// Reports the bytes EF BB BF, with which some editors begin a UTF-8 file.
    ///
    /// ## Why is this bad
    /// Most readers take the mark for a part of the first line. Then the first section is not found, and its entries
    /// belong to nothing.
    ///
    /// ## Example
    /// ```eds escaped
    /// \xEF\xBB\xBF[FileInfo]
    /// FileName=example.eds
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// FileName=example.eds
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static BYTE_ORDER_MARK = {
        code: "SYN002",
        name: "byte-order-mark",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(mark) = context.document().byte_order_mark() else { return };
    report
        .add(mark, "the file begins with a UTF-8 byte order mark (EF BB BF)")
        .help("save the file as ASCII, or as UTF-8 without a byte order mark")
        .safe_fix("Delete the byte order mark", vec![Edit::delete(mark)]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn only_a_mark_at_the_start_counts() {
        assert_eq!(fixed(&BYTE_ORDER_MARK, "\u{FEFF}[1000]\n"), "[1000]\n");
        assert_eq!(findings(&BYTE_ORDER_MARK, "[1000]\nParameterName=\u{FEFF}a\n"), [""; 0]);
    }
}
