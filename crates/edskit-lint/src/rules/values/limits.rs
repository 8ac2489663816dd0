//! What the rules share that want limits to be left out.

use crate::{Edit, Variable};
use edskit_model::{Field, KeyName, Value};

/// The limits that a variable has, in the order of the file.
pub(super) fn present<'a>(variable: &Variable<'a>) -> Vec<Field<'a, Value<'a>>> {
    let mut limits: Vec<_> = [variable.low_limit, variable.high_limit].into_iter().flatten().collect();
    limits.sort_by_key(|limit| limit.entry.id());
    limits
}

/// What messages call them: "`LowLimit` and `HighLimit`".
pub(super) fn names(limits: &[Field<'_, Value<'_>>]) -> String {
    let names: Vec<_> =
        limits.iter().map(|limit| format!("`{}`", limit.entry.key().name.spelling())).collect();
    names.join(" and ")
}

/// Edits that take out the lines of the limits; `None` where a limit stands twice, because the second one would count
/// then.
pub(super) fn deletion(variable: &Variable<'_>, limits: &[Field<'_, Value<'_>>]) -> Option<Vec<Edit>> {
    let is_limit = |name| matches!(name, KeyName::LowLimit | KeyName::HighLimit);
    let written = variable.description.entries().filter(|entry| is_limit(entry.key().name)).count();
    let empty = [KeyName::LowLimit, KeyName::HighLimit]
        .into_iter()
        .filter(|&name| variable.description.entry(name).is_some_and(|entry| entry.is_empty()))
        .count();
    (written == limits.len() + empty)
        .then(|| limits.iter().map(|limit| Edit::delete(limit.entry.line().full_span())).collect())
}
