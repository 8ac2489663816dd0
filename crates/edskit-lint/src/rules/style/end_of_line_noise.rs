use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{LineEnding, LineKind, Span};

rule! {
    /// Blanks at the ends of lines, or no line break at the end of the file
    ///
    /// ## What it does
    /// Reports blanks and tabs at the ends of lines, all of them in one finding, and a last line without a line break.
    ///
    /// ## Why is this bad
    /// Nobody sees the blanks, but comparisons of two versions show them. Some tools lose a last line that has no
    /// line break.
    ///
    /// ## Example
    /// ```eds escaped
    /// [1000]\x20\x20
    /// ParameterName=Device type
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1000]
    /// ParameterName=Device type
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2: blanks around a value do not belong to it.
    pub(crate) static END_OF_LINE_NOISE = {
        code: "STY003",
        name: "end-of-line-noise",
        group: Style,
        severity: Info,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let document = context.document();
    let source = context.source();
    let mut blanks: Vec<Span> = Vec::new();
    for line in document.lines() {
        // A line of nothing else is the matter of nobody: an editor's indentation.
        if let [.., b' ' | b'\t'] = line.span().slice(source)
            && line.kind() != LineKind::Blank
        {
            blanks.push(line.trailing_blanks(source));
        }
    }
    if let [first, ..] = blanks[..] {
        let message = match blanks.len() {
            1 => "1 line ends with blanks".to_owned(),
            count => format!("{count} lines end with blanks"),
        };
        report
            .add(first, message)
            .help("take the blanks out")
            .safe_fix("Take the blanks out", blanks.iter().map(|span| Edit::delete(*span)).collect());
    }
    let Some(last) = document.lines().last() else { return };
    // A control character at the end is the matter of SYN025.
    if last.ending() == LineEnding::None && !last.span().is_empty() && last.kind() != LineKind::Other {
        report
            .add(last.trimmed(source), "the last line has no line break")
            .help("end the file with a line break")
            .safe_fix(
                "End the file with a line break",
                vec![Edit::insert(last.span().end, document.line_ending().as_str())],
            );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn blanks_are_counted_once() {
        let text = "[1000] \nParameterName=a\t \n \n;c \nDataType=7\n";
        assert_eq!(findings(&END_OF_LINE_NOISE, text), ["1:7 info: 3 lines end with blanks"]);
        assert_eq!(fixed(&END_OF_LINE_NOISE, text), "[1000]\nParameterName=a\n \n;c\nDataType=7\n");
    }

    #[test]
    fn the_last_line_ends_too() {
        let text = "[1000]\r\nDataType=7";
        assert_eq!(findings(&END_OF_LINE_NOISE, text), ["2:1 info: the last line has no line break"]);
        assert_eq!(fixed(&END_OF_LINE_NOISE, text), "[1000]\r\nDataType=7\r\n");
        assert!(findings(&END_OF_LINE_NOISE, "[1000]\n\u{1a}").is_empty());
    }
}
