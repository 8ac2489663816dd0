//! Identifiers: the one place where names of an EDS become names of Rust.

use core::fmt::Write;
use edskit_types::{Index, SubIndex};
use std::collections::HashMap;

/// The most characters of an identifier that is made from a name.
const MOST_CHARACTERS: usize = 60;

/// What may not name a module, or would be in the way of the crates that generated code names.
const RESERVED: &[&str] = &[
    "_",
    "abstract",
    "as",
    "async",
    "await",
    "become",
    "box",
    "break",
    "const",
    "continue",
    "crate",
    "do",
    "dyn",
    "else",
    "enum",
    "extern",
    "false",
    "final",
    "fn",
    "for",
    "gen",
    "if",
    "impl",
    "in",
    "let",
    "loop",
    "macro",
    "match",
    "mod",
    "move",
    "mut",
    "override",
    "priv",
    "pub",
    "ref",
    "return",
    "self",
    "static",
    "struct",
    "super",
    "trait",
    "true",
    "try",
    "type",
    "typeof",
    "unsafe",
    "unsized",
    "use",
    "virtual",
    "where",
    "while",
    "yield",
    "alloc",
    "core",
    "std",
    "edskit_runtime",
];

/// The name of the module for an EDS: the file name without its ending, in lower case with underscores.
///
/// ```
/// use edskit_codegen::module_name;
/// assert_eq!(module_name("CANopenGateway"), "canopen_gateway");
/// assert_eq!(module_name("4-20 mA"), "eds_4_20_m_a");
/// assert_eq!(module_name("type"), "type_");
/// ```
#[must_use]
pub fn module_name(file_stem: &str) -> String {
    let mut name = words(file_stem).to_ascii_lowercase();
    if name.is_empty() || name.starts_with(|first: char| first.is_ascii_digit()) {
        name.insert_str(0, if name.is_empty() { "eds" } else { "eds_" });
    }
    if RESERVED.contains(&&*name) {
        name.push('_');
    }
    name
}

/// What a handle is named after.
pub(crate) struct Named<'a> {
    pub(crate) index: Index,
    pub(crate) sub_index: SubIndex,
    /// The name of the object, where the entry is a part of one.
    pub(crate) object: Option<&'a str>,
    pub(crate) name: &'a str,
}

/// The names of handles, in capitals. Names that several entries would share get the index, all of them, so that a name
/// does not depend on the order; where even that is taken, and where a name holds nothing usable, it is `OBJECT_2001_01`.
pub(crate) fn handle_names(entries: &[Named<'_>]) -> Vec<String> {
    let bases: Vec<String> = entries.iter().map(base_name).collect();
    let shared = count(&bases);
    let candidates: Vec<String> = bases
        .iter()
        .zip(entries)
        .map(|(base, entry)| match shared[&**base] {
            1 => base.clone(),
            _ => format!("{base}_{}", suffix(entry)),
        })
        .collect();
    let taken = count(&candidates);
    candidates
        .iter()
        .zip(entries)
        .map(|(candidate, entry)| match taken[&**candidate] {
            1 => candidate.clone(),
            _ => place_name(entry),
        })
        .collect()
}

fn count(names: &[String]) -> HashMap<&str, u32> {
    let mut counts = HashMap::with_capacity(names.len());
    for name in names {
        *counts.entry(&**name).or_insert(0) += 1;
    }
    counts
}

fn base_name(entry: &Named<'_>) -> String {
    let mut name = entry.object.map_or_else(String::new, words);
    let own = words(entry.name);
    if !name.is_empty() && !own.is_empty() {
        name.push('_');
    }
    // Names of compact sub-objects begin with that of the object.
    if entry.object.is_some_and(|object| !object.is_empty() && entry.name.starts_with(object)) {
        name.clear();
    }
    name.push_str(&own);
    name.truncate(MOST_CHARACTERS);
    let mut name = name.trim_end_matches('_').to_ascii_uppercase();
    if name.starts_with(|first: char| first.is_ascii_digit()) {
        name.insert_str(0, "OBJECT_");
    }
    if name.is_empty() || is_place_name(&name) { place_name(entry) } else { name }
}

/// The words of a text with underscores between them; only ASCII letters and digits are left.
fn words(text: &str) -> String {
    let mut words = String::new();
    let mut before = ' ';
    for character in text.chars().filter(char::is_ascii) {
        if character.is_ascii_alphanumeric() {
            let begins = before.is_ascii_lowercase() && character.is_ascii_uppercase();
            if !words.is_empty() && (begins || !before.is_ascii_alphanumeric()) {
                words.push('_');
            }
            words.push(character);
        }
        before = character;
        if words.len() > 2 * MOST_CHARACTERS {
            break;
        }
    }
    words
}

/// `2001`, `2001_01`.
fn suffix(entry: &Named<'_>) -> String {
    let mut suffix = format!("{:04X}", entry.index.0);
    if entry.object.is_some() || entry.sub_index.0 > 0 {
        // Writing to a string does not fail.
        let _ = write!(suffix, "_{:02X}", entry.sub_index.0);
    }
    suffix
}

/// `OBJECT_2001`, `OBJECT_2001_01`.
fn place_name(entry: &Named<'_>) -> String {
    format!("OBJECT_{}", suffix(entry))
}

/// Whether a name looks like one that is made from a place.
fn is_place_name(name: &str) -> bool {
    let is_hex =
        |text: &str, digits| text.len() == digits && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    name.strip_prefix("OBJECT_").is_some_and(|place| match place.split_once('_') {
        Some((index, sub_index)) => is_hex(index, 4) && is_hex(sub_index, 2),
        None => is_hex(place, 4),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(names: &[(u16, u8, Option<&str>, &str)]) -> Vec<String> {
        let named = |&(index, sub_index, object, name)| Named {
            index: Index(index),
            sub_index: SubIndex(sub_index),
            object,
            name,
        };
        handle_names(&names.iter().map(named).collect::<Vec<_>>())
    }

    fn name(text: &str) -> String {
        names(&[(0x2001, 0, None, text)]).remove(0)
    }

    #[test]
    fn names_become_capitals() {
        assert_eq!(name("Producer Heartbeat Time"), "PRODUCER_HEARTBEAT_TIME");
        assert_eq!(name("COB-ID SYNC"), "COB_ID_SYNC");
        assert_eq!(name("ErrorRegister"), "ERROR_REGISTER");
        assert_eq!(name("  Ramp3 [%] "), "RAMP3");
        assert_eq!(name("Gr\u{f6}\u{df}e"), "GRE");
        assert_eq!(name("2nd value"), "OBJECT_2ND_VALUE");
        assert_eq!(name("self"), "SELF");
        for nothing in ["", "\u{1F600}", "*/ //", "___"] {
            assert_eq!(name(nothing), "OBJECT_2001", "{nothing}");
        }
        assert_eq!(name(&"ab ".repeat(100)).len(), 59);
    }

    #[test]
    fn sub_objects_begin_with_their_object() {
        let object = Some("Identity Object");
        let all = names(&[
            (0x1018, 0, object, "NrOfObjects"),
            (0x1018, 1, object, "Vendor ID"),
            (0x1018, 2, object, ""),
            (0x2100, 1, Some("Ramp"), "Ramp1"),
            (0x2200, 1, Some(""), "Level"),
        ]);
        let wanted = [
            "IDENTITY_OBJECT_NR_OF_OBJECTS",
            "IDENTITY_OBJECT_VENDOR_ID",
            "IDENTITY_OBJECT",
            "RAMP1",
            "LEVEL",
        ];
        assert_eq!(all, wanted);
    }

    #[test]
    fn shared_names_get_their_place_whatever_the_order() {
        let all = names(&[
            (0x2001, 0, None, "Speed"),
            (0x2002, 0, None, "speed"),
            (0x2003, 1, Some("x"), "Y"),
            (0x2003, 2, Some("x"), "y"),
            (0x2004, 0, None, "Speed 2001"),
            (0x2005, 0, None, "Object 2001"),
        ]);
        let wanted =
            ["OBJECT_2001", "SPEED_2002", "X_Y_2003_01", "X_Y_2003_02", "OBJECT_2004", "OBJECT_2005"];
        assert_eq!(all, wanted);
    }

    #[test]
    fn modules_are_named_after_files() {
        for (file, module) in [
            ("Device", "device"),
            ("khc_eds", "khc_eds"),
            ("ME-0913 v1.2", "me_0913_v1_2"),
            ("", "eds"),
            ("r#fn", "r_fn"),
            ("Self", "self_"),
            ("core", "core_"),
        ] {
            assert_eq!(module_name(file), module);
        }
    }
}
