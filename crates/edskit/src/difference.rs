//! Differences as people read them.

use edskit_model::Document;
use similar::TextDiff;

/// A unified diff of a file and what would become of it; `done` says by what.
pub(crate) fn unified(name: &str, before: &Document, after: &[u8], done: &str) -> String {
    let encoding = before.encoding();
    let (before, after) = (encoding.decode(before.to_bytes()), encoding.decode(after));
    TextDiff::from_lines(before.as_ref(), after.as_ref())
        .unified_diff()
        .context_radius(3)
        .header(name, &format!("{name} ({done})"))
        .to_string()
}
