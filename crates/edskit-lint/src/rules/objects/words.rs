//! Words that the messages of the group share.

use edskit_types::ObjectCode;

/// `is` after one thing, `are` after any other number.
pub(super) fn is_are(number: usize) -> &'static str {
    if number == 1 { "is" } else { "are" }
}

/// `a VAR`, `an ARRAY`.
pub(super) fn with_article(code: ObjectCode) -> String {
    let article = if code == ObjectCode::Array { "an" } else { "a" };
    format!("{article} {code}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_agree() {
        assert_eq!((is_are(1), is_are(0), is_are(2)), ("is", "are", "are"));
        assert_eq!(with_article(ObjectCode::Array), "an ARRAY");
        assert_eq!(with_article(ObjectCode::Record), "a RECORD");
    }
}
