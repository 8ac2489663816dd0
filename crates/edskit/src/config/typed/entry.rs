//! The answer to an entry that is no TOML: the line as it has to be.

use super::row::Row;
use super::{Bad, Part, number, range_in};
use crate::config::key::{self, Place};
use crate::config::problem::{self, Problem};
use crate::config::reading::{DEVICE, span};
use crate::config::signals::TYPES;
use crate::config::value;
use edskit_devices::gateway::{Owner, Parameter};
use edskit_model::Span;

/// Key and value of an entry, as they are written.
struct Written<'t> {
    key: String,
    key_text: &'t str,
    value: String,
    value_text: &'t str,
    form: Form,
}

/// What is wrong with an entry, and how to write it; `None` where nothing is understood of it.
pub(super) fn answer(text: &str, bad: &Bad, place: Place) -> Option<Problem> {
    let content = &text[bad.range.clone()];
    let written = written(content)?;
    let spans = |part: &str| span(range_in(text, part));
    match bad.part {
        Part::Parameters(owner) => parameter(owner, &written, spans, place),
        Part::Signals => signal(&written, spans(written.value_text)),
        Part::Head => device(&written, spans(written.value_text)),
        Part::Other => None,
    }
}

/// What an entry looks like.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    /// Key and value with `=` between them.
    Entry,
    /// A colon in its place.
    Colon,
    /// Cells of a table.
    Row,
}

/// Divides an entry at its `=`, or a row at its cells. A colon may stand for the `=`.
fn written(content: &str) -> Option<Written<'_>> {
    let content = content.trim_end_matches(',');
    let row = content.split(" #").next().unwrap_or(content);
    let entry = divided(content, '=').map(|sides| (Form::Entry, sides));
    let entry = entry.or_else(|| divided(content, ':').map(|sides| (Form::Colon, sides)));
    if let Some((form, (key, value))) = entry {
        // A second sign is one too many.
        let (form, value) = match value.strip_prefix('=') {
            Some(value) => (Form::Colon, value.trim()),
            None => (form, value),
        };
        let is_plausible = !key.is_empty()
            && key.chars().all(|c| c.is_alphanumeric() || " \t_-().[],;:\"'\\\u{A0}".contains(c));
        return is_plausible.then(|| Written {
            key: unquoted(key).to_owned(),
            key_text: key,
            value: without_remark(value).to_owned(),
            value_text: without_remark(value),
            form,
        });
    }
    let row = Row::of_cells(row).or_else(|| Row::of_words(row))?;
    let key_text = if row.number.is_empty() { row.name } else { row.number };
    Some(Written { key: row.key(), key_text, value: row.amount(), value_text: row.value, form: Form::Row })
}

/// The two sides of a sign that is not in quotation marks.
fn divided(content: &str, sign: char) -> Option<(&str, &str)> {
    let mut mark = None;
    for (at, character) in content.char_indices() {
        match (mark, character) {
            (None, '"' | '\'') => mark = Some(character),
            (Some(open), _) if open == character => mark = None,
            (None, '#') => return None,
            (None, _) if character == sign => {
                return Some((content[..at].trim(), content[at + sign.len_utf8()..].trim()));
            }
            _ => {}
        }
    }
    None
}

fn unquoted(key: &str) -> &str {
    key.trim_matches(['"', '\'']).trim()
}

fn without_remark(value: &str) -> &str {
    if value.starts_with(['"', '\'']) { value } else { value.split('#').next().unwrap_or_default().trim() }
}

fn parameter(
    owner: Owner,
    written: &Written<'_>,
    spans: impl Fn(&str) -> Span,
    place: Place,
) -> Option<Problem> {
    // Brackets stand for parentheses where somebody thinks of a list.
    let name = written.key.replace('[', "(").replace(']', ")");
    let parameter = match key::parameter(owner, &name, spans(written.key_text), place) {
        Ok(parameter) => parameter,
        // What is not known of a governor needs no better notation. Prose is no row.
        Err(problem) => return (written.form != Form::Row || key::has_number(&name)).then_some(problem),
    };
    let typed = number::read(parameter, &written.value);
    let at = spans(if written.value_text.is_empty() { written.key_text } else { written.value_text });
    if typed.meanings.is_empty() {
        return Some(match typed.beyond {
            Some(beyond) => value::out_of_range(parameter, Some(beyond), at),
            None => {
                let message = match written.value.as_str() {
                    "" => format!("{parameter} has no value"),
                    value => format!("`{value}` is no value of {parameter}"),
                };
                Problem::at(problem::WRONG_TYPE, at, message).help(value::allowed(parameter))
            }
        });
    }
    let key = key_in_toml(&name, parameter);
    let lines: Vec<String> = typed
        .meanings
        .iter()
        .map(|meaning| {
            let line = format!("`{key} = {}`", meaning.toml(parameter));
            if meaning.only_if.is_empty() { line } else { format!("{line} if {}", meaning.only_if) }
        })
        .collect();
    let reasons = typed.reasons.join(" and ");
    let value_is_bad = !super::is_toml(&format!("a = {}", written.value));
    let (at, message) = match (written.form, value_is_bad) {
        (Form::Row, _) => (spans(written.key_text), "this is a row of a table, and no entry".to_owned()),
        (Form::Colon, _) => {
            (spans(written.key_text), "an entry has `=` between its key and its value".to_owned())
        }
        (Form::Entry, true) if reasons.is_empty() => {
            (at, format!("`{}` is no number of TOML", written.value))
        }
        (Form::Entry, true) => (at, format!("`{}` is written with {reasons}", written.value)),
        (Form::Entry, false) if key == written.key => (at, "an entry ends behind its value".to_owned()),
        (Form::Entry, false) => (
            spans(written.key_text),
            format!("`{}` is no key: with blanks or parentheses it stands in quotation marks", written.key),
        ),
    };
    let problem = Problem::at(problem::MANUAL_NOTATION, at, message);
    Some(problem.help(format!("write {}", lines.join(", or "))))
}

/// The key of an entry as TOML has it, with what was written in it.
fn key_in_toml(written: &str, parameter: Parameter) -> String {
    let is_bare = |key: &str| {
        !key.is_empty() && key.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-".contains(&byte))
    };
    if is_bare(written) {
        return written.to_owned();
    }
    let number = parameter.number();
    let has_number = written.trim_start_matches(['P', 'p', ' ']).starts_with(|c: char| c.is_ascii_digit());
    let has_name = written.trim_start_matches(['P', 'p', ' ']).chars().any(|c| c.is_alphabetic());
    match parameter.name().map(|name| name.to_string()) {
        Some(name) if has_number && has_name => format!("\"{number} {name}\""),
        Some(name) if !has_number && is_bare(&name) => name,
        Some(name) if !has_number => format!("\"{name}\""),
        _ => number.to_string(),
    }
}

fn signal(written: &Written<'_>, at: Span) -> Option<Problem> {
    let number = key::signal(&written.key)?;
    let word = written.value.trim_matches(['"', '\'']).to_ascii_lowercase();
    let (known, _) = TYPES.iter().find(|(known, _)| *known == word)?;
    let line = match key::name_of_signal(&written.key) {
        Some(name) => format!("{number} = {{ name = \"{name}\", type = \"{known}\" }}"),
        None => format!("{number} = \"{known}\""),
    };
    let message = format!("parameter {number} is described, but not in TOML");
    Some(Problem::at(problem::MANUAL_NOTATION, at, message).help(format!("write `{line}`")))
}

fn device(written: &Written<'_>, at: Span) -> Option<Problem> {
    let is_known = written.key == "device" && written.value.trim_matches(['"', '\'', ';', ' ']) == DEVICE;
    let message = "the name of the device is a text, which stands in quotation marks";
    let problem = Problem::at(problem::MANUAL_NOTATION, at, message);
    is_known.then(|| problem.help(format!("write `device = \"{DEVICE}\"`")))
}
