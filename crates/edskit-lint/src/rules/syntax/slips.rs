//! Which number a text was meant to be, where it is none.

use edskit_model::Number;

/// A text that is no number but was meant as one.
pub(super) struct Slip {
    /// The number as it should be written.
    pub(super) number: String,
    /// What is wrong with the text.
    pub(super) reason: &'static str,
    /// Whether no other number can have been meant.
    pub(super) certain: bool,
    /// What it may be as well, where that is possible but less likely.
    pub(super) other: Option<String>,
}

/// The number that `raw`, which is none, was meant to be, for spellings that are known from other languages and from
/// slips of the hand.
pub(super) fn of_number(raw: &[u8]) -> Option<Slip> {
    let mut slip = guess(raw)?;
    let digits = slip.number.trim_start_matches('0');
    if digits.len() < slip.number.len() && slip.number.len() > 1 && is_decimal(&slip.number) {
        // What is proposed must not be the next slip: a leading 0 makes a number octal.
        slip.number = if digits.is_empty() { "0".to_owned() } else { digits.to_owned() };
        slip.certain &= slip.number.len() == 1;
    }
    Some(slip)
}

fn guess(raw: &[u8]) -> Option<Slip> {
    let text = std::str::from_utf8(raw).ok()?;
    let slip = |number: String, reason, certain| Some(Slip { number, reason, certain, other: None });
    let either = |number: String, reason, other: String| {
        Some(Slip { number, reason, certain: false, other: Some(other) })
    };
    let lower = text.to_ascii_lowercase();
    if let Some(digits) = lower.strip_prefix("0x0x").filter(|digits| is_hex(digits)) {
        return slip(format!("0x{}", tail(text, digits)), "the prefix stands twice", true);
    }
    for prefix in ["&h", "16#", "$", "\\x", "x"] {
        if let Some(digits) = lower.strip_prefix(prefix).filter(|digits| is_hex(digits)) {
            return slip(format!("0x{}", tail(text, digits)), "hexadecimal numbers begin with `0x`", true);
        }
    }
    if let Some(digits) = lower.strip_suffix('h').map(|rest| rest.strip_prefix("0x").unwrap_or(rest))
        && is_hex(digits)
    {
        return slip(
            format!("0x{}", digits.to_ascii_uppercase()),
            "hexadecimal numbers begin with `0x`",
            true,
        );
    }
    if let Some(value) = lower.strip_prefix("0b").and_then(|digits| u64::from_str_radix(digits, 2).ok()) {
        return slip(format!("0x{value:X}"), "there are no binary numbers", true);
    }
    if let Some(value) = lower.strip_prefix("0o").and_then(|digits| u64::from_str_radix(digits, 8).ok()) {
        return slip(value.to_string(), "octal numbers of other languages are not known here", true);
    }
    if let Some(value) = with_exponent(&lower) {
        return match is_hex(text) {
            true => either(value, "integers have no exponent", format!("0x{text}")),
            false => slip(value, "integers have no exponent", true),
        };
    }
    if let Some(number) = cleaned(text) {
        return slip(number, "only digits belong to a number", true);
    }
    if let Some((whole, fraction)) = text.split_once(['.', ','])
        && is_number(whole)
        && !fraction.is_empty()
        && fraction.bytes().all(|byte| byte.is_ascii_digit())
    {
        // Three digits behind the mark are a group of thousands more often than a fraction.
        if fraction.len() == 3 && is_decimal(whole) && whole.len() <= 3 && !whole.starts_with('0') {
            return either(format!("{whole}{fraction}"), "only digits belong to a number", whole.to_owned());
        }
        let is_zero = fraction.bytes().all(|byte| byte == b'0');
        return slip(whole.to_owned(), "an integer has no fraction", is_zero);
    }
    if let Some(digits) = text.strip_prefix('0').filter(|rest| rest.bytes().all(|byte| byte.is_ascii_digit()))
    {
        let digits = digits.trim_start_matches('0');
        return slip(digits.to_owned(), "a leading 0 makes a number octal", digits.len() == 1);
    }
    if is_hex(text) {
        let usual_width = matches!(text.len(), 2 | 4 | 8);
        return slip(format!("0x{text}"), "hexadecimal numbers begin with `0x`", usual_width);
    }
    let (number, unit) = text.split_at(text.find([' ', '\t'])?);
    let is_unit = unit.trim().bytes().all(|byte| byte.is_ascii_alphabetic() || matches!(byte, b'/' | b'%'));
    if is_unit && is_number(number) {
        return slip(number.to_owned(), "only digits belong to a number", false);
    }
    None
}

/// The integer that a number with an exponent is: `1e3`, `2.5e3`.
fn with_exponent(text: &str) -> Option<String> {
    let (mantissa, exponent) = text.split_once('e')?;
    let exponent: usize = exponent.strip_prefix('+').unwrap_or(exponent).parse().ok()?;
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{whole}{fraction}");
    if whole.is_empty() || !is_decimal(&digits) || fraction.len() > exponent || exponent > 19 {
        return None;
    }
    let number = format!("{digits}{}", "0".repeat(exponent - fraction.len()));
    number.parse::<u64>().ok().map(|value| value.to_string())
}

fn is_decimal(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// The number without quotes, blanks, digit separators, a mark at its end, a C suffix; with digits for letters that
/// look like them.
fn cleaned(text: &str) -> Option<String> {
    let inner = text.trim_matches(['"', '\'']).trim_end_matches([';', ',']).trim();
    let inner = inner.trim_end_matches(['u', 'U', 'l', 'L']);
    let dense: String = inner.chars().filter(|c| !matches!(c, ' ' | '\t' | '_' | '\'')).collect();
    let is_sum = inner.contains(' ') && !dense.starts_with("0x") && !dense.starts_with("0X");
    if is_number(&dense) && !is_sum {
        return Some(dense);
    }
    let digit = |letter| match letter {
        'o' | 'O' => '0',
        'l' | 'I' | '|' => '1',
        _ => letter,
    };
    let digits: String = dense.chars().map(digit).collect();
    (digits != dense && is_number(&digits)).then_some(digits)
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
            ("1.0", "1", true),
            ("1,5", "1", false),
            ("1.000", "1000", false),
            ("12,500", "12500", false),
            ("0.500", "0", false),
            ("0o17", "15", true),
            ("0O777", "511", true),
            ("1e3", "1000", false),
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
        of_number(text.as_bytes()).map(|slip| (slip.number, slip.certain))
    }

    #[test]
    fn the_likelier_reading_comes_first() {
        let other = |text: &str| of_number(text.as_bytes()).and_then(|slip| slip.other);
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
            if let Some(slip) = of_number(text.as_bytes()).filter(|_| !is_number(&text)) {
                let number = &slip.number;
                assert!(is_number(number), "{number} for {text}");
                let looks_octal = number.len() > 1 && number.starts_with('0') && is_decimal(number);
                assert!(!looks_octal, "{number} for {text} would be the next slip");
            }
        }
    }
}
