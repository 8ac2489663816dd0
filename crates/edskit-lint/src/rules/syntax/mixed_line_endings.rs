use crate::rule::rule;
use crate::wording::series;
use crate::{Context, Edit, Report};
use edskit_model::{Line, LineEnding};

rule! {
    /// Lines end in different ways
    ///
    /// ## What it does
    /// Reports a file whose lines end with LF and with CR LF, and a file with a lone CR. There is one finding, at the
    /// first line that ends unlike most of them.
    ///
    /// ## Why is this bad
    /// CiA 306 knows LF and CR LF. Most readers do not end a line at a lone CR, so two lines become one. A mixture
    /// of LF and CR LF is the trace of an edit by a tool that did not know the file's form, and version control shows
    /// changes where there are none.
    ///
    /// ## Example
    /// ```eds escaped
    /// [FileInfo]
    /// FileName=example.eds
    /// FileVersion=1\r
    /// FileRevision=0
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// FileName=example.eds
    /// FileVersion=1
    /// FileRevision=0
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static MIXED_LINE_ENDINGS = {
        code: "SYN004",
        name: "mixed-line-endings",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let document = context.document();
    let [lf, crlf, cr] =
        [LineEnding::Lf, LineEnding::CrLf, LineEnding::Cr].map(|kind| document.count_of(kind));
    if cr == 0 && (lf == 0 || crlf == 0) {
        return;
    }
    // A lone CR is never what the others should become.
    let wanted = if crlf > lf { LineEnding::CrLf } else { LineEnding::Lf };
    let differs = |line: &Line| !matches!(line.ending(), LineEnding::None) && line.ending() != wanted;
    let Some(first) = document.lines().iter().find(|line| differs(line)) else { return };
    let others = [(LineEnding::Lf, lf), (LineEnding::CrLf, crlf), (LineEnding::Cr, cr)];
    let other = |&(ending, count): &(LineEnding, u32)| {
        (ending != wanted && count > 0).then(|| format!("{count} with {}", ending.name()))
    };
    let listed = series(&others.iter().filter_map(other).collect::<Vec<_>>(), "and");
    let total = lf + crlf + cr;
    let message = match document.count_of(wanted) {
        0 => format!("of {total} lines none ends with LF or CR LF, but {listed}"),
        usual => format!("of {total} lines {usual} end with {}, but {listed}", wanted.name()),
    };
    let finding = report.add(first.ending_span(), message);
    finding.here(format!("the first {}", first.ending().name()));
    finding.help(format!("end every line with {}", wanted.name()));
    let title = "End every line in the same way";
    let edits = edits(document.lines(), wanted);
    if cr == 0 {
        finding.safe_fix(title, edits);
    } else {
        finding.unsafe_fix(title, edits);
    }
}

fn edits(lines: &[Line], wanted: LineEnding) -> Vec<Edit> {
    let mut edits = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let ending = line.ending();
        if ending == LineEnding::None || ending == wanted {
            continue;
        }
        // CR CR LF comes from a CR LF that was converted once too often.
        let next = lines.get(number + 1);
        let twice = ending == LineEnding::Cr
            && next.is_some_and(|next| next.span().is_empty() && next.ending() == LineEnding::CrLf);
        let replacement = if twice { "" } else { wanted.as_str() };
        edits.push(Edit::replace(line.ending_span(), replacement));
    }
    edits
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn the_majority_wins() {
        assert_eq!(
            findings(&MIXED_LINE_ENDINGS, "[1000]\r\nDataType=7\nAccessType=ro\r\n"),
            ["2:11 warning: of 3 lines 2 end with CR LF, but 1 with LF"]
        );
        assert_eq!(
            fixed(&MIXED_LINE_ENDINGS, "[1000]\r\nDataType=7\nAccessType=ro\r\n"),
            "[1000]\r\nDataType=7\r\nAccessType=ro\r\n"
        );
        assert_eq!(findings(&MIXED_LINE_ENDINGS, "[1000]\r\nDataType=7\r\nAccessType=ro"), [""; 0]);
    }

    #[test]
    fn a_lone_cr_is_never_right() {
        assert_eq!(
            findings(&MIXED_LINE_ENDINGS, "[1000]\rDataType=7\r"),
            ["1:7 warning: of 2 lines none ends with LF or CR LF, but 2 with CR"]
        );
        assert_eq!(fixed(&MIXED_LINE_ENDINGS, "[1000]\rDataType=7\r"), "[1000]\nDataType=7\n");
        assert_eq!(fixed(&MIXED_LINE_ENDINGS, "[1000]\r\r\nDataType=7\r\r\n"), "[1000]\r\nDataType=7\r\n");
    }
}
