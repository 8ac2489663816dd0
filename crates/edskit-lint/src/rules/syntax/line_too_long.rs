use crate::rule::rule;
use crate::{Context, Report};
use edskit_model::{Encoding, Entry, LineKind, Shape, Span};

rule! {
    /// A line is longer than 255 characters
    ///
    /// ## What it does
    /// Reports lines of more than 255 characters, counted without the line ending; key, `=` and value count together,
    /// and comments count too. A text that is longer than its key allows is the matter of string-too-long.
    ///
    /// ## Why is this bad
    /// CiA 306 ends a line there, so readers with a buffer of that size cut it or take the rest for a new line.
    ///
    /// ## Example
    /// ```eds
    /// [1F20sub1]
    /// DefaultValue=010203040506070801020304050607080102030405060708010203040506070801020304050607080102030405060708010203040506070801020304050607080102030405060708010203040506070801020304050607080102030405060708010203040506070801020304050607080102030405060708010203040506
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1F20sub1]
    /// DefaultValue=0102030405060708
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static LINE_TOO_LONG = {
        code: "SYN003",
        name: "line-too-long",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [CanChkEds("23")],
        check: File(check),
    }
}

const LIMIT: usize = 255;

fn check(context: &Context<'_>, report: &mut Report) {
    for (number, line) in context.document().lines().iter().enumerate() {
        if line.span().len() <= LIMIT {
            continue;
        }
        let length = length(context, line.span());
        if length <= LIMIT || is_long_text(context, number) {
            continue;
        }
        let beyond = line.span().sub(start_of(context, line.span(), LIMIT), line.span().len());
        let noun = if line.kind() == LineKind::Comment { "the comment" } else { "the line" };
        report
            .add(beyond, format!("{noun} has {length} characters, {} more than {LIMIT}", length - LIMIT))
            .here("from here on");
    }
}

/// How many characters `span` has.
fn length(context: &Context<'_>, span: Span) -> usize {
    match context.document().encoding() {
        Encoding::Ascii | Encoding::Windows1252 => span.len(),
        Encoding::Utf8 => context.sheet.text(span).chars().count(),
    }
}

/// How many bytes the first `characters` of `span` have.
fn start_of(context: &Context<'_>, span: Span, characters: usize) -> usize {
    match context.document().encoding() {
        Encoding::Ascii | Encoding::Windows1252 => characters,
        Encoding::Utf8 => context.sheet.text(span).chars().take(characters).map(char::len_utf8).sum(),
    }
}

/// Whether the line is an entry whose text alone is longer than the key allows: FIL009 owns that.
fn is_long_text(context: &Context<'_>, line: usize) -> bool {
    let limit = |entry: Entry<'_>| match entry.key().name.shape() {
        Shape::Text(limit) if limit > 0 => Some(usize::from(limit)),
        _ => None,
    };
    context
        .sheet
        .entry_on_line(line)
        .is_some_and(|entry| limit(entry).is_some_and(|limit| length(context, entry.value_span()) > limit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::findings;

    #[test]
    fn characters_are_counted_not_bytes() {
        let text = |line: &str| format!("[1000]\n{line}\n");
        assert_eq!(findings(&LINE_TOO_LONG, &text(&format!(";{}", "x".repeat(254)))), [""; 0]);
        assert_eq!(
            findings(&LINE_TOO_LONG, &text(&format!(";{}", "x".repeat(255)))),
            ["2:256 warning: the comment has 256 characters, 1 more than 255"]
        );
        assert_eq!(findings(&LINE_TOO_LONG, &text(&format!(";{}", "ü".repeat(254)))), [""; 0]);
        assert_eq!(
            findings(&LINE_TOO_LONG, &text(&format!("DefaultValue={}", "ü".repeat(245)))),
            ["2:256 warning: the line has 258 characters, 3 more than 255"]
        );
    }

    #[test]
    fn long_texts_are_left_to_their_own_rule() {
        assert_eq!(
            findings(&LINE_TOO_LONG, &format!("[1000]\nParameterName={}\n", "x".repeat(242))),
            [""; 0]
        );
        assert_eq!(
            findings(&LINE_TOO_LONG, &format!("[1000]\n ParameterName={}\n", "x".repeat(241))).len(),
            1
        );
    }
}
