//! From bytes to TOML, and what is wrong with a file that is none.

use super::problem::{self, Problem};
use super::reading::span;
use edskit_model::Span;
use toml::Spanned;
use toml::de::{DeTable, Error};

/// The most errors that are shown; who gives the wrong file need not see every line of it.
const MOST: usize = 20;

/// The text of a file.
pub(crate) fn text_of(bytes: &[u8]) -> Result<&str, Problem> {
    std::str::from_utf8(bytes).map_err(|error| {
        let start = error.valid_up_to();
        let end = (start + error.error_len().unwrap_or(1)).min(bytes.len());
        let message = "the file is not UTF-8, which TOML files must be";
        Problem::at(problem::TOML_SYNTAX, span(start..end), message)
            .help("save it as UTF-8, or write these characters in ASCII")
    })
}

/// The table that a text is; `None` where it is no TOML. What is wrong with it goes to `problems`.
pub(crate) fn table_of<'t>(text: &'t str, problems: &mut Vec<Problem>) -> Option<Spanned<DeTable<'t>>> {
    let (root, errors) = DeTable::parse_recoverable(text);
    let found = self::problems(&errors, text);
    let is_toml = found.iter().all(|problem| problem.kind.code != problem::TOML_SYNTAX.code);
    problems.extend(found);
    is_toml.then_some(root)
}

/// The errors of the parser, one for each line.
fn problems(errors: &[Error], text: &str) -> Vec<Problem> {
    let mut problems: Vec<Problem> = Vec::new();
    let mut last: Option<u32> = None;
    for error in errors {
        let place = error.span().map_or(Span::at(0), span);
        let between = last.and_then(|last| text.get(last as usize..place.start as usize));
        if between.is_some_and(|between| !between.contains('\n')) {
            continue;
        }
        last = Some(place.start);
        if problems.len() == MOST {
            if let Some(last) = problems.pop() {
                problems.push(last.help("this is not the last error; is this the right file?"));
            }
            break;
        }
        problems.push(problem(error.message(), place, text));
    }
    problems
}

fn problem(message: &str, place: Span, text: &str) -> Problem {
    let key = text.get(place.range()).unwrap_or_default();
    if message.starts_with("duplicate key") && !key.is_empty() {
        let problem = Problem::at(problem::DUPLICATE_KEY, place, format!("`{key}` stands twice"));
        let problem = match first_of(key, place, text) {
            Some(first) => problem.label(first, "the first time"),
            None => problem,
        };
        return problem.help("keep one of the two");
    }
    let message = message.trim().replace('\n', ", ");
    let problem = Problem::at(problem::TOML_SYNTAX, place, format!("this is no TOML: {message}"));
    match identifier_digits(place, text) {
        Some(digits) => problem.help(format!("write `0x{digits}`")),
        None => problem,
    }
}

/// The last line before that begins with this key, or the header of this name.
fn first_of(key: &str, place: Span, text: &str) -> Option<Span> {
    let before = text.get(..place.start as usize)?;
    let mut end = before.len();
    for line in before.split_inclusive('\n').rev() {
        end -= line.len();
        let header = line.trim().strip_prefix('[').and_then(|line| line.strip_suffix(']'));
        let is_entry =
            || line.trim_start().strip_prefix(key).is_some_and(|rest| rest.trim_start().starts_with('='));
        if header.is_some_and(|header| header.trim() == key) || is_entry() {
            let start = end + line.find(key)?;
            return Some(span(start..start + key.len()));
        }
    }
    None
}

/// The digits of a value like `282h`, as the manual writes identifiers.
fn identifier_digits(place: Span, text: &str) -> Option<&str> {
    let before = text.get(..place.start as usize)?;
    let start = before.rfind(['\n', '=']).map_or(0, |at| at + 1);
    let word = text.get(start..)?.split(['\r', '\n', '#']).next()?.trim();
    let digits = word.strip_suffix(['h', 'H'])?;
    i32::from_str_radix(digits, 16).is_ok().then_some(digits)
}
