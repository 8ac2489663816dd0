//! Text of files inside generated code: in comments, and in literals.

/// The most characters of a name in a comment.
const MOST_CHARACTERS: usize = 120;

/// A text for a comment of one line: without characters that end the line, are invisible, or turn the direction of
/// reading, and not longer than a line should be.
pub(crate) fn for_comment(text: &str) -> String {
    let visible = text.trim().chars().filter(|character| is_visible(*character));
    let mut short: String = visible.clone().take(MOST_CHARACTERS).collect();
    if visible.count() > MOST_CHARACTERS {
        short.push('\u{2026}');
    }
    short
}

/// A text as a code span of a documentation comment, in which nothing has a meaning but the backtick that ends it.
pub(crate) fn for_docs(text: &str) -> Option<String> {
    let text = for_comment(text).replace('`', "'");
    let text = text.trim();
    (!text.is_empty()).then(|| format!("`{text}`"))
}

/// A text as the inside of a string literal that is a format string.
pub(crate) fn for_message(text: &str) -> String {
    text.chars().fold(String::new(), |mut escaped, character| {
        match character {
            '{' => escaped.push_str("{{"),
            '}' => escaped.push_str("}}"),
            _ => escaped.extend(character.escape_default()),
        }
        escaped
    })
}

/// Neither a control character nor one of Unicode's format characters, separators and private tags.
fn is_visible(character: char) -> bool {
    !character.is_control()
        && !matches!(
            character,
            '\u{AD}'
                | '\u{61C}'
                | '\u{180E}'
                | '\u{200B}'..='\u{200F}'
                | '\u{2028}'..='\u{202E}'
                | '\u{2060}'..='\u{206F}'
                | '\u{FEFF}'
                | '\u{FFF0}'..='\u{FFFF}'
                | '\u{E0000}'..='\u{E0FFF}'
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_stays_on_its_line() {
        assert_eq!(for_comment(" a\nb\r\0c\u{202E}d\u{2028}e \u{1F600} "), "abcde \u{1F600}");
        assert_eq!(for_comment(&"x".repeat(1000)).chars().count(), MOST_CHARACTERS + 1);
    }

    #[test]
    fn a_code_span_stays_closed() {
        assert_eq!(for_docs("a`b` [c](d) \\").as_deref(), Some("`a'b' [c](d) \\`"));
        assert_eq!(for_docs(" \n "), None);
    }

    #[test]
    fn a_message_stays_in_its_literal() {
        assert_eq!(for_message("a\"b\\c{d}\n\u{e4}"), "a\\\"b\\\\c{{d}}\\n\\u{e4}");
    }
}
