//! Small words of messages.

use crate::profile::Expected;
use core::ops::RangeInclusive;
use edskit_types::ObjectCode;

/// `a VAR`, `an ARRAY`.
pub(super) fn with_article(code: ObjectCode) -> String {
    let article = if code == ObjectCode::Array { "an" } else { "a" };
    format!("{article} {code}")
}

/// `5`, `2 to 240`.
pub(super) fn range(range: &RangeInclusive<Expected>) -> String {
    if range.start() == range.end() {
        range.start().to_string()
    } else {
        format!("{} to {}", range.start(), range.end())
    }
}
