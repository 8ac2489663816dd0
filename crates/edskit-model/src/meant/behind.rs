//! What stands around a value: comments, marks, quotes.

/// The length of the value before a blank and the mark of a comment.
///
/// Only values that are no free text are asked: in a text, both characters are allowed.
pub fn value_length(raw: &[u8]) -> Option<usize> {
    let start = raw.windows(2).position(|pair| matches!(pair, [b' ' | b'\t', b';' | b'#']))?;
    Some(raw[..start].trim_ascii_end().len())
}

/// A value of octets without the comment and the mark behind it.
pub(crate) fn before_comment(raw: &[u8]) -> &[u8] {
    let end =
        raw.iter().position(|byte| matches!(byte, b';' | b'#' | b'/' | b',' | b'(')).unwrap_or(raw.len());
    raw[..end].trim_ascii_end()
}

/// What is wrong, and the text without it.
type Layer = (&'static str, fn(&str) -> Option<&str>);

/// What is taken away around a value, in the order in which it is tried.
pub(super) const LAYERS: &[Layer] = &[
    ("a comment stands behind the value", comment),
    ("a mark stands behind the value", mark),
    ("the value stands in quotes", quotes),
    ("a remark stands behind the value", remark),
];

/// Behind `;`, `#`, `//`, `/*` and `--`; CiA 306 knows no comment at the end of a line.
fn comment(text: &str) -> Option<&str> {
    let starts = [" ;", "\t;", " #", "\t#", ";", "#", "//", "/*", " --"];
    let first = starts.into_iter().find_map(|start| text.find(start))?;
    Some(text[..first].trim_end())
}

/// `5;`, `5,`, `5.`
fn mark(text: &str) -> Option<&str> {
    Some(text.trim_end_matches([';', ',', '.']).trim_end())
}

/// `"5"`, `'5'`
fn quotes(text: &str) -> Option<&str> {
    let quote = text.chars().next().filter(|first| matches!(first, '"' | '\''))?;
    Some(text.strip_prefix(quote)?.strip_suffix(quote)?.trim())
}

/// `5 (five)`
fn remark(text: &str) -> Option<&str> {
    let (value, rest) = text.split_at(text.find([' ', '\t'])?);
    let rest = rest.trim();
    (rest.starts_with('(') && rest.ends_with(')')).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blank_must_stand_before_the_mark() {
        assert_eq!(value_length(b"0x0005 ; U8"), Some(6));
        assert_eq!(value_length(b"5 \t# five"), Some(1));
        assert_eq!(value_length(b"0;2"), None);
        assert_eq!(value_length(b"rw"), None);
    }
}
