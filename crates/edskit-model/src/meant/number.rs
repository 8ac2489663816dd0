//! Which number a text was meant to be, where it is none.

use super::Slip;
use crate::value::Number;

/// A number, and what else can have been meant.
enum Guess {
    /// Nothing else.
    Certain(String),
    /// Something that nobody can name.
    Likely(String),
    /// This, which is less likely.
    Either(String, String),
}

use Guess::{Certain, Either, Likely};

/// What is wrong, and how the number is found.
type Spelling = (&'static str, fn(&str) -> Option<Guess>);

const PREFIX: &str = "hexadecimal numbers begin with `0x`";
const DIGITS: &str = "only digits belong to a number";

/// Spellings that are known from other languages and from slips of the hand, in the order in which they are tried.
const SPELLINGS: &[Spelling] = &[
    ("the prefix stands twice", doubled_prefix),
    (PREFIX, other_prefix),
    (PREFIX, suffix_h),
    ("there are no binary numbers", binary),
    ("an octal number begins with `0`", octal),
    (DIGITS, cleaned),
    ("an integer has no exponent", exponent),
    ("an integer has no fraction", fraction),
    ("a leading 0 makes a number octal", leading_zero),
    (PREFIX, no_prefix),
    (DIGITS, unit),
];

/// The number that `text`, which is none, was meant to be.
pub fn number(text: &str) -> Option<Slip> {
    SPELLINGS.iter().find_map(|(reason, read)| {
        let (text, certain, other) = match read(text)? {
            Certain(text) => (text, true, None),
            Likely(text) => (text, false, None),
            Either(text, other) => (text, false, Some(other)),
        };
        // What is proposed must not be the next slip: a leading 0 makes a number octal.
        let digits = text.trim_start_matches('0');
        if text.len() > 1 && digits.len() < text.len() && is_decimal(&text) {
            let text = if digits.is_empty() { "0".to_owned() } else { digits.to_owned() };
            let certain = certain && text.len() == 1;
            return Some(Slip { text, reason, certain, other });
        }
        Some(Slip { text, reason, certain, other })
    })
}

/// The same for an index, which is hexadecimal whatever else its digits may look like.
pub(super) fn index(text: &str) -> Option<Slip> {
    let mut slip = number(text)?;
    if let Some(other) = slip.other.take_if(|other| other.starts_with("0x")) {
        return Some(Slip { text: other, reason: PREFIX, certain: text.len() == 4, other: None });
    }
    Some(slip)
}

/// The index that a text is as hexadecimal digits, where `0x` does not stand before them: `1018`, `1A00`.
pub fn without_prefix(text: &[u8]) -> Option<u16> {
    if text.len() > 4 || matches!(text, [b'0', b'x' | b'X', ..]) {
        return None;
    }
    u16::from_str_radix(core::str::from_utf8(text).ok()?, 16).ok()
}

/// `0x0x1A`, `0xx1A`
fn doubled_prefix(text: &str) -> Option<Guess> {
    let lower = text.to_ascii_lowercase();
    let digits = lower.strip_prefix("0x0x").or_else(|| lower.strip_prefix("0xx"))?;
    is_hex(digits).then(|| Certain(format!("0x{}", tail(text, digits))))
}

/// `$1A`, `16#1A`, `&H1A`, `x1A`
fn other_prefix(text: &str) -> Option<Guess> {
    let lower = text.to_ascii_lowercase();
    let prefixes = ["&h", "16#", "$", "\\x", "x"];
    let mut digits = prefixes.into_iter().filter_map(|prefix| lower.strip_prefix(prefix));
    let digits = digits.find(|digits| is_hex(digits))?;
    Some(Certain(format!("0x{}", tail(text, digits))))
}

/// `1Ah`, `0x1Ah`
fn suffix_h(text: &str) -> Option<Guess> {
    let lower = text.to_ascii_lowercase();
    let digits = lower.strip_suffix('h')?.trim_end();
    let digits = digits.strip_prefix("0x").unwrap_or(digits);
    is_hex(digits).then(|| Certain(format!("0x{}", digits.to_ascii_uppercase())))
}

/// `0b101`
fn binary(text: &str) -> Option<Guess> {
    let digits = text.strip_prefix("0b").or_else(|| text.strip_prefix("0B"))?;
    let value = u64::from_str_radix(digits, 2).ok()?;
    Some(Certain(format!("0x{value:X}")))
}

/// `0o17`
fn octal(text: &str) -> Option<Guess> {
    let digits = text.strip_prefix("0o").or_else(|| text.strip_prefix("0O"))?;
    let value = u64::from_str_radix(digits, 8).ok()?;
    Some(Certain(value.to_string()))
}

/// `2.5e3`; and `1e3`, which may be the digits of a hexadecimal number too.
fn exponent(text: &str) -> Option<Guess> {
    let (mantissa, exponent) = text.split_once(['e', 'E'])?;
    let exponent: usize = exponent.strip_prefix('+').unwrap_or(exponent).parse().ok()?;
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{whole}{fraction}");
    if whole.is_empty() || !is_decimal(&digits) || fraction.len() > exponent || exponent > 19 {
        return None;
    }
    let number = format!("{digits}{}", "0".repeat(exponent - fraction.len()));
    let number = number.parse::<u64>().ok()?.to_string();
    Some(if is_hex(text) { Either(number, format!("0x{text}")) } else { Certain(number) })
}

/// `1.0`; and `12,500`, where three digits behind the mark are a group of thousands more often than a fraction.
fn fraction(text: &str) -> Option<Guess> {
    let (whole, fraction) = text.split_once(['.', ','])?;
    if !is_number(whole) || !is_decimal(fraction) {
        return None;
    }
    if fraction.len() == 3 && is_decimal(whole) && whole.len() <= 3 && !whole.starts_with('0') {
        return Some(Either(format!("{whole}{fraction}"), whole.to_owned()));
    }
    let is_zero = fraction.bytes().all(|byte| byte == b'0');
    Some(if is_zero { Certain(whole.to_owned()) } else { Likely(whole.to_owned()) })
}

/// `08`
fn leading_zero(text: &str) -> Option<Guess> {
    let digits = text.strip_prefix('0').filter(|rest| is_decimal(rest))?.trim_start_matches('0');
    let is_certain = digits.len() == 1;
    is_number(digits).then(|| if is_certain { Certain(digits.to_owned()) } else { Likely(digits.to_owned()) })
}

/// `1A00`
fn no_prefix(text: &str) -> Option<Guess> {
    let usual_width = matches!(text.len(), 2 | 4 | 8);
    let number = format!("0x{text}");
    is_hex(text).then_some(if usual_width { Certain(number) } else { Likely(number) })
}

/// `100 ms`
fn unit(text: &str) -> Option<Guess> {
    let (number, unit) = text.split_at(text.find([' ', '\t'])?);
    let is_unit = unit.trim().bytes().all(|byte| byte.is_ascii_alphabetic() || matches!(byte, b'/' | b'%'));
    (is_unit && is_number(number)).then(|| Likely(number.to_owned()))
}

fn is_decimal(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// The real number that was meant: with a point in the place of its only comma, without the suffix of a C literal.
pub(super) fn real(text: &str) -> Option<String> {
    let text = text.replacen(',', ".", 1);
    let number = text.strip_suffix(['f', 'F']).unwrap_or(&text);
    number.parse::<f64>().is_ok().then(|| number.to_owned())
}

/// The octets that were meant, if a `0x` or blanks between them is all that is wrong.
pub(super) fn octets(text: &str) -> Option<String> {
    let parts = text.split_ascii_whitespace();
    let digits = |part: &str| {
        let digits = part.strip_prefix("0x").or_else(|| part.strip_prefix("0X")).unwrap_or(part);
        (!digits.is_empty()
            && digits.len().is_multiple_of(2)
            && digits.bytes().all(|byte| byte.is_ascii_hexdigit()))
        .then(|| digits.to_owned())
    };
    parts.map(digits).collect::<Option<String>>().filter(|text| !text.is_empty())
}

/// The number without quotes, blanks, digit separators, a mark at its end, a C suffix; with digits for letters that
/// look like them.
fn cleaned(text: &str) -> Option<Guess> {
    let inner = text.trim_matches(['"', '\'']).trim_end_matches([';', ',']).trim();
    let inner = inner.trim_end_matches(['u', 'U', 'l', 'L']);
    let dense: String = inner.chars().filter(|c| !matches!(c, ' ' | '\t' | '_' | '\'')).collect();
    let is_hex = dense.starts_with("0x") || dense.starts_with("0X");
    let is_one = is_hex || !inner.contains([' ', '\t']) || is_grouped(inner);
    if is_number(&dense) && is_one {
        return Some(Certain(dense));
    }
    let has_digit = dense.len() == 1 || dense.bytes().any(|byte| byte.is_ascii_digit());
    let digits: String = dense.chars().map(digit_like).collect();
    (has_digit && digits != dense && is_number(&digits)).then_some(Certain(digits))
}

/// The digit that a letter looks like.
fn digit_like(letter: char) -> char {
    match letter {
        'o' | 'O' => '0',
        'l' | 'I' | '|' => '1',
        other => other,
    }
}

/// Whether the blanks of a decimal number divide its thousands: `10 000`; or stand behind its sign.
fn is_grouped(text: &str) -> bool {
    let unsigned = text.trim_start_matches(['-', '+']).trim_start();
    let mut groups = unsigned.split_ascii_whitespace();
    let first = groups.next().unwrap_or_default();
    (1..=3).contains(&first.len()) && !first.starts_with('0') && groups.all(|group| group.len() == 3)
        || !unsigned.contains([' ', '\t'])
}

/// The last part of `text`, as long as `part`: the same text in its own case.
fn tail<'a>(text: &'a str, part: &str) -> &'a str {
    &text[text.len() - part.len()..]
}

fn is_number(text: &str) -> bool {
    Number::parse(text.as_bytes()).is_ok()
}

/// Whether the text is hexadecimal digits, as many as fit 64 bits.
fn is_hex(text: &str) -> bool {
    (1..=16).contains(&text.len()) && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings_of_other_languages_and_slips() {
        for (text, number, certain) in [
            ("0x0x1B59", "0x1B59", true),
            ("0X0x1b59", "0x1b59", true),
            ("10h", "0x10", true),
            ("0x1aH", "0x1A", true),
            ("$10", "0x10", true),
            ("&H10", "0x10", true),
            ("16#FF", "0xFF", true),
            ("x1A", "0x1A", true),
            ("1A00", "0x1A00", true),
            ("1A0", "0x1A0", false),
            ("0b101", "0x5", true),
            ("\"5\"", "5", true),
            ("0x10;", "0x10", true),
            ("10UL", "10", true),
            ("0x1234 5678", "0x12345678", true),
            ("1_000", "1000", true),
            ("Ox1O", "0x10", true),
            ("0xx10", "0x10", true),
            ("0o17", "15", true),
            ("1e3", "1000", false),
            ("10 000", "10000", true),
            ("- 5", "-5", true),
            ("0x 10", "0x10", true),
            ("0xI0", "0x10", true),
            ("1.0", "1", true),
            ("1,5", "1", false),
            ("1.000", "1000", false),
            ("12,500", "12500", false),
            ("0.500", "0", false),
            ("0O777", "511", true),
            ("2.5E3", "2500", true),
            ("1e+3", "1000", true),
            ("\"010\"", "10", false),
            ("O17", "17", false),
            ("0xlA00", "0x1A00", true),
            ("08", "8", true),
            ("0189", "189", false),
            ("100 ms", "100", false),
        ] {
            assert_eq!(number_of(text), Some((number.to_owned(), certain)), "{text}");
        }
    }

    #[test]
    fn what_nobody_can_know() {
        for text in ["", "0x", "-", "abc xyz", "UNKNOWN", "1 2", "0x1G", "1.2.3", "<value>", "#", "5 of 6"] {
            assert_eq!(number_of(text), None, "{text}");
        }
    }

    fn number_of(text: &str) -> Option<(String, bool)> {
        number(text).map(|slip| (slip.text, slip.certain))
    }

    #[test]
    fn the_likelier_reading_comes_first() {
        let other = |text: &str| number(text).and_then(|slip| slip.other);
        assert_eq!(other("1e3").as_deref(), Some("0x1e3"));
        assert_eq!(other("1.000").as_deref(), Some("1"));
        assert_eq!((other("2.5e3"), other("1_000"), other("1A00")), (None, None, None));
    }

    #[test]
    fn what_is_proposed_is_a_number() {
        let letters = ["", "0", "8", "a", "h", "x", "b", "O", "$", "#", ".", ",", ";", " ", "\"", "u", "-"];
        for place in 0..letters.len().pow(4) {
            let letter = |position| letters[place / letters.len().pow(position) % letters.len()];
            let text: String = (0..4).map(letter).collect();
            if let Some(slip) = number(&text).filter(|_| !is_number(&text)) {
                let number = &slip.text;
                assert!(is_number(number), "{number} for {text}");
                let looks_octal = number.len() > 1 && number.starts_with('0') && is_decimal(number);
                assert!(!looks_octal, "{number} for {text} would be the next slip");
            }
        }
    }
}
