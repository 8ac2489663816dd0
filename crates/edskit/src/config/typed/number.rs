//! Values as people write them: hexadecimal digits without `0x`, decimal commas, units, remarks.

use edskit_devices::gateway::{Parameter, Quantity, Values};

/// What a written value can mean.
#[derive(Default, Debug)]
pub(crate) struct Typed {
    /// The most likely first; each is a value that the parameter can have.
    pub(crate) meanings: Vec<Meaning>,
    /// Where there is none: what it means beyond the range of the parameter.
    pub(crate) beyond: Option<i32>,
    /// What is unlike TOML in it, in words.
    pub(crate) reasons: Vec<&'static str>,
}

/// One meaning.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Meaning {
    /// As the parameter holds it.
    pub(crate) value: i32,
    is_hexadecimal: bool,
    /// When it is this one, where there are several.
    pub(crate) only_if: &'static str,
}

impl Meaning {
    fn decimal(value: i32) -> Self {
        Self { value, is_hexadecimal: false, only_if: "" }
    }

    fn hexadecimal(value: i32) -> Self {
        Self { is_hexadecimal: true, ..Self::decimal(value) }
    }

    /// The value in TOML.
    pub(crate) fn toml(self, parameter: Parameter) -> String {
        match parameter.quantity() {
            _ if self.is_hexadecimal && self.value >= 0 => format!("0x{:X}", self.value),
            Quantity::Seconds => parameter.amount(self.value).to_string().replace(" s", ""),
            _ => self.value.to_string(),
        }
    }
}

/// Reads a value of a parameter.
pub(crate) fn read(parameter: Parameter, text: &str) -> Typed {
    let mut typed = Typed::default();
    let body = tidied(text, &mut typed.reasons);
    let found = match parameter.quantity() {
        Quantity::Identifier => hexadecimal(&body).map(Meaning::hexadecimal).into_iter().collect(),
        _ => any_number(parameter, &body, &mut typed.reasons),
    };
    if parameter.quantity() == Quantity::Identifier && !found.is_empty() {
        typed.reasons.insert(0, "hexadecimal digits without `0x`");
    }
    let (inside, outside): (Vec<Meaning>, Vec<Meaning>) =
        found.into_iter().partition(|meaning| parameter.values().contain(meaning.value));
    typed.beyond = outside.first().map(|meaning| meaning.value).filter(|_| inside.is_empty());
    typed.meanings = inside;
    typed
}

/// The value without remarks, quotation marks and characters that only look like those of a keyboard.
fn tidied(text: &str, reasons: &mut Vec<&'static str>) -> String {
    const DASHES: [char; 4] = ['\u{2212}', '\u{2013}', '\u{2014}', '\u{2010}'];
    const QUOTES: [char; 9] =
        ['"', '\'', '\u{201C}', '\u{201D}', '\u{201E}', '\u{2018}', '\u{2019}', '\u{AB}', '\u{BB}'];
    let mut body = text.trim();
    for mark in ["#", ";", "//", " ("] {
        if let Some((before, _)) = body.split_once(mark).filter(|(before, _)| !before.trim().is_empty()) {
            body = before.trim();
            if mark != "#" {
                reasons.push("a remark that does not begin with `#`");
            }
        }
    }
    if body.contains(DASHES) {
        reasons.push("a dash instead of a minus");
    }
    let body: String = body
        .trim_matches(QUOTES)
        .chars()
        .map(|character| match character {
            _ if DASHES.contains(&character) => '-',
            // Letters of another alphabet, which a PDF may hold for those of `Hex`.
            '\u{41D}' => 'H',
            '\u{435}' => 'e',
            '\u{445}' => 'x',
            _ if character.is_whitespace() => ' ',
            _ => character,
        })
        .collect();
    body.trim().to_owned()
}

/// Hexadecimal digits, with what people put before or behind them.
fn hexadecimal(body: &str) -> Option<i32> {
    let lower = body.to_ascii_lowercase();
    let mut digits = lower.trim();
    digits = digits.strip_prefix("hex").unwrap_or(digits).trim();
    digits = digits.strip_suffix("hex").unwrap_or(digits).trim();
    digits = digits.strip_suffix('h').unwrap_or(digits).trim();
    digits = ["0x", "16#", "$"].iter().find_map(|prefix| digits.strip_prefix(prefix)).unwrap_or(digits);
    if digits.is_empty() || digits.len() > 8 || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    i32::from_str_radix(digits, 16).ok()
}

/// Whether a value says itself that its digits are hexadecimal.
fn says_hexadecimal(body: &str) -> bool {
    let lower = body.to_ascii_lowercase();
    let is_marked = ["0x", "$", "16#", "hex"].iter().any(|mark| lower.starts_with(mark));
    is_marked || lower.ends_with('h') || lower.ends_with("hex")
}

fn any_number(parameter: Parameter, body: &str, reasons: &mut Vec<&'static str>) -> Vec<Meaning> {
    if says_hexadecimal(body)
        && let Some(value) = hexadecimal(body)
    {
        reasons.push("hexadecimal digits without `0x`");
        let value = value.checked_mul(parameter.quantity().per_unit());
        return value.map(Meaning::hexadecimal).into_iter().collect();
    }
    if let (Values::Between(0, 1), Some(value)) = (parameter.values(), switch(body)) {
        reasons.push("a word");
        return vec![Meaning::decimal(value)];
    }
    let end = body.find(|character: char| !"+-.,0123456789eE".contains(character)).unwrap_or(body.len());
    let (digits, unit) = body.split_at(end);
    // The `e` of a unit is none of an exponent.
    let digits = digits.trim().trim_end_matches(['e', 'E']);
    let unit = unit.trim().to_lowercase();
    let Some(factor) = factor(parameter.quantity(), &unit) else {
        // Letters behind a number are digits too, or a remark.
        let value = hexadecimal(body).filter(|_| !digits.is_empty());
        if value.is_some() {
            reasons.push("hexadecimal digits without `0x`");
        } else {
            reasons.push("a remark that does not begin with `#`");
        }
        let numbers = decimals(digits).into_iter().filter_map(|number| meaning(parameter, number, 1.0));
        let hexadecimal = value.map(Meaning::hexadecimal);
        return hexadecimal.into_iter().chain(numbers.filter(|_| value.is_none())).collect();
    };
    if !unit.is_empty() {
        reasons.push("a unit");
    }
    if digits.contains(',') {
        reasons.push("a decimal comma");
    }
    let is_padded = digits.len() > 1 && digits.starts_with('0') && !digits.contains(['.', ',']);
    if is_padded {
        reasons.push("leading zeros");
    }
    decimals(digits).into_iter().filter_map(|number| meaning(parameter, number, factor)).collect()
}

/// A number and when it is this one.
type Number = (f64, &'static str);

fn meaning(parameter: Parameter, (number, only_if): Number, factor: f64) -> Option<Meaning> {
    let value = number * factor * f64::from(parameter.quantity().per_unit());
    let is_whole = (value - value.round()).abs() < 1e-6 && value.abs() < f64::from(i32::MAX);
    is_whole.then(|| Meaning { only_if, ..Meaning::decimal(value.round() as i32) })
}

/// What digits can mean: a point or comma divides decimals, or thousands where three digits follow.
fn decimals(digits: &str) -> Vec<Number> {
    let number = |text: &str, only_if| text.parse::<f64>().ok().map(|number| (number, only_if));
    let separators = digits.matches(['.', ',']).count();
    let Some(last) = digits.rfind(['.', ',']) else { return number(digits, "").into_iter().collect() };
    let without = |text: &str| text.replace(['.', ','], "");
    let (whole, decimals) = (without(&digits[..last]), &digits[last + 1..]);
    let is_mixed = digits.contains('.') && digits.contains(',');
    let may_divide_thousands = decimals.len() == 3 && whole.trim_start_matches('0').len() == whole.len();
    let as_decimals = number(&format!("{whole}.{decimals}"), "");
    let as_thousands = number(&format!("{whole}{decimals}"), "it divides thousands");
    match (separators, is_mixed, may_divide_thousands) {
        (1, _, true) => as_decimals.into_iter().chain(as_thousands).collect(),
        (1, _, false) | (_, true, _) => as_decimals.into_iter().collect(),
        _ => as_thousands.map(|(number, _)| (number, "")).into_iter().collect(),
    }
}

/// By what a number with a unit is multiplied, to be one in the unit of the manual; `None` for other units.
fn factor(quantity: Quantity, unit: &str) -> Option<f64> {
    let unit = unit.trim_end_matches('.');
    Some(match (quantity, unit) {
        (_, "") => 1.0,
        (Quantity::Seconds, "s" | "sec" | "sek" | "sekunden" | "seconds") => 1.0,
        (Quantity::Seconds, "ms") => 1e-3,
        (Quantity::Milliseconds, "ms" | "msec" | "millisekunden" | "milliseconds") => 1.0,
        (Quantity::Milliseconds, "s" | "sec" | "sek") => 1e3,
        (
            Quantity::KbitPerSecond,
            "k" | "kbit/s" | "kbits/s" | "kbaud" | "kbd" | "kbps" | "kb/s" | "kbit",
        ) => 1.0,
        (
            Quantity::KbitPerSecond,
            "m" | "mbit/s" | "mbits/s" | "mbaud" | "mbd" | "mbps" | "mb/s" | "mbit",
        ) => 1e3,
        (Quantity::KbitPerSecond, "bit/s" | "bits/s" | "baud" | "bd" | "bps") => 1e-3,
        _ => return None,
    })
}

/// A word for a switch that is on or off.
fn switch(body: &str) -> Option<i32> {
    match body.to_lowercase().as_str() {
        "on" | "yes" | "true" | "ein" | "an" | "ja" | "gesetzt" => Some(1),
        "off" | "no" | "false" | "aus" | "nein" => Some(0),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_devices::gateway::Owner;

    /// What a value of a parameter of the gateway is in TOML.
    fn toml(number: u16, text: &str) -> Vec<String> {
        let parameter = Parameter::find(Owner::Gateway, number).unwrap();
        read(parameter, text).meanings.iter().map(|meaning| meaning.toml(parameter)).collect()
    }

    #[test]
    fn identifiers_are_hexadecimal_however_they_are_marked() {
        for text in [
            "57F",
            "57f",
            "57Fh",
            "57F h",
            "57F Hex",
            "57F \u{41D}\u{435}\u{445}",
            "0x57F",
            "0X57F",
            "057F",
            "$57F",
            "Hex 57F",
            "\"57F\"",
            "57F # TPDO16",
            "57F ; TPDO16",
            "57F (TPDO16)",
        ] {
            assert_eq!(toml(16404, text), ["0x57F"], "{text}");
        }
        assert_eq!(
            [toml(16404, "5E2"), toml(16404, "1e3"), toml(16404, "0b1")],
            [["0x5E2"], ["0x1E3"], ["0xB1"]]
        );
        let parameter = Parameter::find(Owner::Gateway, 16404).unwrap();
        assert_eq!((toml(16404, "FFFF"), read(parameter, "FFFF").beyond), (vec![], Some(0xFFFF)));
        assert_eq!((toml(16404, "xyz"), read(parameter, "xyz").beyond), (vec![], None));
    }

    #[test]
    fn numbers_with_commas_units_and_remarks() {
        for (number, text, expected) in [
            (400, "1,0", &["1.0"][..]),
            (400, "1,5 s", &["1.5"]),
            (400, "1.25s", &["1.25"]),
            (400, "500 ms", &["0.5"]),
            (400, "1,250", &["1.25"]),
            (429, "1000 ms", &["1000"]),
            (429, "1000ms", &["1000"]),
            (429, "1 s", &["1000"]),
            (429, "0,5 s", &["500"]),
            (429, "1.000", &["1", "1000"]),
            (429, "1,000 ms", &["1", "1000"]),
            (429, "1000,0", &["1000"]),
            (429, "1e3", &["1000"]),
            (429, "0200", &["200"]),
            (429, "1.5", &[]),
            (426, "125 kBit/s", &["125"]),
            (426, "250kbits/s", &["250"]),
            (426, "1 MBit/s", &["1000"]),
            (426, "500k", &["500"]),
            (426, "125000 bit/s", &["125"]),
            (427, "1 ; node-ID", &["1"]),
            (427, "05", &["5"]),
            (427, "7Fh", &["0x7F"]),
            (427, "7F", &["0x7F"]),
            (427, "0X7F", &["0x7F"]),
            (427, "5.0", &["5"]),
            (427, "5 Stück", &["5"]),
            (427, "abc", &[]),
            (427, "", &[]),
            (4426, "ein", &["1"]),
            (4426, "Off", &["0"]),
        ] {
            assert_eq!(toml(number, text), expected, "{number} = {text}");
        }
        let function = Parameter::find(Owner::Governor, 835).unwrap();
        for text in ["-5", "\u{2212}5", "\u{2013} 5"] {
            let typed = read(function, &text.replace(' ', ""));
            assert_eq!(typed.meanings.first().map(|meaning| meaning.value), Some(-5), "{text}");
        }
        let node_id = Parameter::find(Owner::Gateway, 427).unwrap();
        assert_eq!(read(node_id, "200 ms").beyond, Some(200));
    }
}
