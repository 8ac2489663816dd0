//! Words where a number, or one of six other words, belongs.

use crate::similar::nearest;
use crate::value::Number;
use edskit_types::{AccessType, DataType, ObjectCode};

/// The access type that a word in use elsewhere, or a slip, stands for.
pub fn access(word: &str) -> Option<AccessType> {
    let letters: String = word.chars().filter(char::is_ascii_alphabetic).collect();
    match letters.to_ascii_lowercase().as_str() {
        "r" | "read" | "readonly" => Some(AccessType::Ro),
        "w" | "write" | "writeonly" => Some(AccessType::Wo),
        "wr" | "readwrite" | "writeread" => Some(AccessType::Rw),
        "readwriter" | "readwriteread" => Some(AccessType::Rwr),
        "readwritew" | "readwritewrite" => Some(AccessType::Rww),
        "constant" => Some(AccessType::Const),
        known if AccessType::parse(known.as_bytes()).is_some() => AccessType::parse(known.as_bytes()),
        // The other words are too short and too much alike for a guess.
        slip => nearest(slip, [AccessType::Const.as_str()]).map(|_| AccessType::Const),
    }
}

const YES: [&str; 4] = ["yes", "true", "on", "y"];
const NO: [&str; 4] = ["no", "false", "off", "n"];
/// Words of XDD files for what may be mapped, and for what may not.
const MAPPED: [&str; 5] = ["optional", "default", "tpdo", "rpdo", "both"];
const NOT_MAPPED: [&str; 1] = ["none"];

fn is_one_of(word: &str, words: &[&str]) -> bool {
    words.iter().any(|known| word.eq_ignore_ascii_case(known))
}

/// The flag that a word stands for.
pub fn flag(word: &str) -> Option<&'static str> {
    if is_one_of(word, &MAPPED) {
        Some("1")
    } else if is_one_of(word, &NOT_MAPPED) {
        Some("0")
    } else {
        boolean(word)
    }
}

/// The BOOLEAN that a word stands for.
pub(super) fn boolean(word: &str) -> Option<&'static str> {
    if is_one_of(word, &YES) {
        Some("1")
    } else if is_one_of(word, &NO) {
        Some("0")
    } else {
        None
    }
}

/// The number of the object code with this name.
pub(super) fn object_code(word: &str) -> Option<String> {
    let code = ObjectCode::ALL.iter().find(|code| word.eq_ignore_ascii_case(code.name()))?;
    Some(format!("0x{}", code.code()))
}

/// Prefixes of names that other languages have for types of so many bits, and what CiA 301 calls them.
const PREFIXES: [(&str, &str); 7] = [
    ("unsigned", "UNSIGNED"),
    ("uint", "UNSIGNED"),
    ("u", "UNSIGNED"),
    ("integer", "INTEGER"),
    ("int", "INTEGER"),
    ("i", "INTEGER"),
    ("real", "REAL"),
];

/// The index of the data type with this name, as CiA 301 spells it or as a language does: `UNSIGNED8`, `uint8_t`, `U8`.
pub(super) fn data_type(word: &str) -> Option<String> {
    let dense: String = word.chars().filter(|c| !matches!(c, '_' | ' ' | '-')).collect();
    let dense = dense.to_ascii_lowercase();
    let letters = |name: &str| name.replace('_', "").to_ascii_lowercase();
    let named =
        |wanted: &str| DataType::ALL.iter().copied().find(|known| letters(known.name()) == letters(wanted));
    let sized = || {
        let bits = dense.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        let bits = bits.strip_suffix('t').unwrap_or(bits);
        let (_, name) = PREFIXES.iter().find(|(prefix, _)| dense.starts_with(&format!("{prefix}{bits}")))?;
        named(&format!("{name}{bits}")).filter(|_| !bits.is_empty())
    };
    let known = named(&dense).or_else(sized).or_else(|| match &*dense {
        "bool" => Some(DataType::Boolean),
        // Those of IEC 61131-3; its INT and UINT are other types in C.
        "byte" | "usint" => Some(DataType::Unsigned8),
        "word" => Some(DataType::Unsigned16),
        "dword" | "udint" => Some(DataType::Unsigned32),
        "lword" | "ulint" => Some(DataType::Unsigned64),
        "sint" => Some(DataType::Integer8),
        "dint" => Some(DataType::Integer32),
        "lint" => Some(DataType::Integer64),
        "string" => Some(DataType::VisibleString),
        "float" => Some(DataType::Real32),
        "double" => Some(DataType::Real64),
        _ => None,
    })?;
    Some(format!("0x{:04X}", known.index().0))
}

/// The index of a data type that is given by its index and by its name, where both agree: `0x0006 - UNSIGNED16`,
/// `UNSIGNED16 0x0006`.
pub(super) fn data_type_twice(text: &str) -> Option<String> {
    let is_between = |c: char| matches!(c, ' ' | '\t' | '-' | ':' | '=' | ',');
    let number = |text: &str| Number::parse(text.as_bytes()).ok()?.to::<u16>();
    let agree = |index: &str, name: &str| {
        let named = data_type(name).and_then(|named| number(&named));
        named.is_some() && named == number(index)
    };
    let (first, rest) = text.split_once(is_between)?;
    if agree(first, rest.trim_start_matches(is_between)) {
        return Some(first.to_owned());
    }
    let (rest, last) = text.rsplit_once(is_between)?;
    agree(last, rest.trim_end_matches(is_between)).then(|| last.to_owned())
}
