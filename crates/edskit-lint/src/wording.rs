//! Small words of messages.

use edskit_types::ObjectCode;

/// `1 sub-object`, `2 sub-objects`.
pub(crate) fn counted(count: usize, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

/// `is` after one thing, `are` after any other number.
pub(crate) fn is_are(count: usize) -> &'static str {
    if count == 1 { "is" } else { "are" }
}

/// `a VAR`, `an ARRAY`.
pub(crate) fn with_article(code: ObjectCode) -> String {
    let article = if code == ObjectCode::Array { "an" } else { "a" };
    format!("{article} {code}")
}

/// `a`, `a and b`, `a, b and c`.
pub(crate) fn list(words: &[&str]) -> String {
    match words {
        [] => String::new(),
        [word] => (*word).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_articles_agree_with_their_nouns() {
        assert_eq!(counted(1, "link"), "1 link");
        assert_eq!(counted(0, "link"), "0 links");
        assert_eq!((is_are(1), is_are(0), is_are(2)), ("is", "are", "are"));
        assert_eq!(with_article(ObjectCode::Array), "an ARRAY");
        assert_eq!(with_article(ObjectCode::Record), "a RECORD");
    }

    #[test]
    fn lists_end_with_and() {
        assert_eq!(list(&[]), "");
        assert_eq!(list(&["a"]), "a");
        assert_eq!(list(&["a", "b"]), "a and b");
        assert_eq!(list(&["a", "b", "c"]), "a, b and c");
    }
}
