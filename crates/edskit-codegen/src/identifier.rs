//! Words: the one place where names of an EDS become parts of identifiers.

use crate::transliteration::ascii;

/// How many characters of a name are looked at.
const MOST_READ: usize = 200;

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

/// The words of a text with underscores between them, of ASCII letters and digits; for other letters the ASCII that stands
/// for them.
pub(crate) fn words(text: &str) -> String {
    let mut words = String::new();
    let mut before = ' ';
    for character in text.chars().filter(|character| is_used(*character)) {
        let is_ascii = character.is_ascii_alphanumeric();
        if is_ascii || !character.is_ascii() {
            let begins = before.is_lowercase() && character.is_uppercase();
            if !words.is_empty() && (begins || !before.is_alphanumeric()) {
                words.push('_');
            }
            match if is_ascii { None } else { ascii(character) } {
                Some(letters) => words.push_str(letters),
                None => words.push(character),
            }
        }
        before = character;
        if words.len() > MOST_READ {
            break;
        }
    }
    words
}

/// Whether there are letters or digits in a text that no ASCII stands for: a name loses them.
pub(crate) fn loses(text: &str) -> bool {
    text.chars().any(|character| character.is_alphanumeric() && !is_used(character))
}

fn is_used(character: char) -> bool {
    character.is_ascii() || ascii(character).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

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
            ("Größe", "groesse"),
            ("Überdruck-Ventil", "ueberdruck_ventil"),
        ] {
            assert_eq!(module_name(file), module);
        }
    }

    #[test]
    fn words_are_told_apart_by_case_and_signs() {
        for (text, wanted) in [
            ("ErrorRegister", "Error_Register"),
            ("  Ramp3 [%] ", "Ramp3"),
            ("GrößeMax", "Groesse_Max"),
            ("ÄNDERUNG", "aeNDERUNG"),
            ("Température d'entrée", "Temperature_d_entree"),
            ("10 µs", "10_us"),
            ("速度 A", "A"),
        ] {
            assert_eq!(words(text), wanted);
        }
        assert!(loses("速度 A") && loses("Дa") && !loses("Größe 5° µm²"));
    }
}
