//! Values that depend on the node-ID, or are meant to: `$NODEID+0x180`.

use super::{slips, typed};
use crate::Context;
use crate::inline_comment::value_length;
use crate::similar::nearest;
use edskit_model::{Entry, Formula, Number, Shape};

/// Where something that is meant as a formula stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Place {
    /// In a value or limit of an integer type, or of a type that is not known.
    Value,
    /// In a key that is always a number.
    Number,
}

/// The entries whose value is meant as a formula: it holds `$`, or it is a sum with the node-ID. Where a comment stands
/// behind the value, SYN012 comes first.
pub(super) fn entries<'a>(context: &Context<'a>) -> impl Iterator<Item = (Entry<'a>, Place)> {
    context.odd_entries().filter_map(|entry| place(entry).map(|place| (entry, place)))
}

/// The formulas that can be understood, however they are written.
pub(super) fn understood<'a>(context: &Context<'a>) -> impl Iterator<Item = (Entry<'a>, Formula)> {
    context.odd_entries().filter(|entry| entry.raw().contains(&b'$')).filter_map(|entry| {
        (place(entry) == Some(Place::Value)).then_some(())?;
        Some((entry, Formula::parse(entry.raw()).ok()?))
    })
}

fn place(entry: Entry<'_>) -> Option<Place> {
    let raw = entry.raw();
    let dollar = raw.contains(&b'$');
    let is_sum = raw.contains(&b'+');
    let is_text = matches!(entry.key().name.shape(), Shape::Text(_));
    if is_text || !(dollar || is_sum) || value_length(raw).is_some() || is_hexadecimal(raw) {
        return None;
    }
    match typed::shape(entry) {
        Shape::Unsigned(_) if dollar => Some(Place::Number),
        Shape::Value => {
            let is_integer = entry.section().and_then(typed::data_type).map(|known| known.is_integer());
            let is_meant = match is_integer {
                Some(is_integer) => is_integer && (dollar || meant(raw).is_some()),
                None => meant(raw).is_some(),
            };
            is_meant.then_some(Place::Value)
        }
        _ => None,
    }
}

/// Whether the text is a hexadecimal number as some assemblers write it: `$1A`. It is a number, not a formula.
pub(super) fn is_hexadecimal(raw: &[u8]) -> bool {
    matches!(raw, [b'$', digits @ ..] if !digits.is_empty() && digits.iter().all(u8::is_ascii_hexdigit))
}

/// The formula that a text is, or was meant to be where its variable or a number is misspelt.
pub(super) fn meant(raw: &[u8]) -> Option<Formula> {
    let text = std::str::from_utf8(raw).ok()?;
    let terms = text.split('+').map(|term| {
        let term = term.trim();
        if is_node_id(term) {
            Some("$NODEID".to_owned())
        } else if Number::parse(term.as_bytes()).is_ok() {
            Some(term.to_owned())
        } else {
            slips::of_number(term.as_bytes()).filter(|slip| slip.certain).map(|slip| slip.number)
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
    use crate::FileKind;
    use edskit_model::Datasheet;

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
        ] {
            assert_eq!(meant(text.as_bytes()).map(|formula| formula.offset()), Some(0x180), "{text}");
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
            assert_eq!(meant(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn places_depend_on_key_and_type() {
        let text = "[1400sub1]\nDataType=0x7\nDefaultValue=$NODEID+0x200\nHighLimit=node\n\
                    [1008]\nParameterName=Node $NODEID\nDataType=0x9\nDefaultValue=$NODEID\n\
                    [2000]\nDefaultValue=$5\nLowLimit=$NodeID ; x\nHighLimit=NODEID+1\nSubNumber=$NODEID\n\
                    [x]\na=$NODEID\n[DeviceComissioning]\nNodeID=5\nNodeName=$NODEID";
        let sheet = Datasheet::parse(text.as_bytes());
        let context = Context::new(&sheet, FileKind::Eds, None);
        let found: Vec<_> = entries(&context).map(|(entry, place)| (entry.line_number(), place)).collect();
        assert_eq!(found, [(2, Place::Value), (11, Place::Value), (12, Place::Number)]);
    }
}
