//! Formulas in other spellings.

use super::number::number;
use crate::similar::nearest;
use crate::value::{Formula, Number};

/// Whether the text is a hexadecimal number as some assemblers write it: `$1A`. It is a number, not a formula.
pub fn is_hexadecimal(raw: &[u8]) -> bool {
    matches!(raw, [b'$', digits @ ..] if !digits.is_empty() && digits.iter().all(u8::is_ascii_hexdigit))
}

/// The formula that a text is, or was meant to be where its variable or a number is misspelt.
pub fn formula(raw: &[u8]) -> Option<Formula> {
    let text = core::str::from_utf8(raw).ok()?.trim();
    let text = text.strip_prefix('(').and_then(|text| text.strip_suffix(')')).unwrap_or(text);
    let terms = text.split('+').map(|term| {
        let term = term.trim();
        if is_node_id(term) {
            Some("$NODEID".to_owned())
        } else if Number::parse(term.as_bytes()).is_ok() {
            Some(term.to_owned())
        } else {
            number(term).filter(|slip| slip.certain).map(|slip| slip.text)
        }
    });
    Formula::parse(terms.collect::<Option<Vec<_>>>()?.join("+").as_bytes()).ok()
}

/// Whether a term is the variable, or the variable misspelt: `{NodeID}`, `NODE_ID`, `$NODE`.
fn is_node_id(term: &str) -> bool {
    // Longer words are something else, and this bounds the work.
    if term.len() > 16 {
        return false;
    }
    let is_decoration =
        |c: char| matches!(c, '$' | '{' | '}' | '<' | '>' | '(' | ')' | '[' | ']' | '%' | '_' | ' ');
    let bare = term.trim_matches(is_decoration);
    let word: String = bare.chars().filter(|c| !matches!(c, '_' | '-' | ' ')).collect();
    if word.eq_ignore_ascii_case("NODEID") {
        return !bare.starts_with('-') && !bare.ends_with('-');
    }
    let marked = term.starts_with('$') || (term.starts_with('{') && term.ends_with('}'));
    let is_like_it = || word.eq_ignore_ascii_case("NODE") || nearest(&word, ["NODEID"]).is_some();
    marked && word.bytes().all(|byte| byte.is_ascii_alphabetic()) && is_like_it()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misspelt_formulas_are_understood() {
        for text in [
            "$NODEID+0x180",
            "NODEID+0x180",
            "{NODEID}+0x180",
            "$NODE_ID+0x180",
            "$NODE+0x180",
            "$NODIED + 180h",
            "Node-ID+0x180",
            "0x180+<NodeId>",
            "${NODEID}+$180",
            "(0x180 + $NODEID)",
            "$ NODEID + 0x0x180",
        ] {
            assert_eq!(formula(text.as_bytes()).map(|formula| formula.offset()), Some(0x180), "{text}");
        }
        for text in [
            "",
            "$",
            "0x180",
            "NODE+0x180",
            "$NODEID*2",
            "$NODEID-1",
            "-NODEID",
            "$NODEID1",
            "Node 5",
            "$5",
            "$DCF",
        ] {
            assert_eq!(formula(text.as_bytes()), None, "{text}");
        }
    }
}
