//! Letters with accents and the like in ASCII, as people write them who have no other keys.

/// What stands for a character in an identifier, in small letters; `None` for what no ASCII stands for.
pub(crate) fn ascii(character: char) -> Option<&'static str> {
    let small = character.to_lowercase().next().unwrap_or(character);
    Some(match small {
        'ä' | 'æ' => "ae",
        'ö' | 'ø' | 'œ' => "oe",
        'ü' => "ue",
        'ß' => "ss",
        'þ' => "th",
        'ĳ' => "ij",
        'à'..='ã' | 'å' | 'ā' | 'ă' | 'ą' => "a",
        'ç' | 'ć' | 'ĉ' | 'ċ' | 'č' => "c",
        'ð' | 'ď' | 'đ' => "d",
        'è'..='ë' | 'ē' | 'ĕ' | 'ė' | 'ę' | 'ě' => "e",
        'ĝ' | 'ğ' | 'ġ' | 'ģ' => "g",
        'ĥ' | 'ħ' => "h",
        'ì'..='ï' | 'ĩ' | 'ī' | 'ĭ' | 'į' | 'ı' => "i",
        'ĵ' => "j",
        'ķ' => "k",
        'ĺ' | 'ļ' | 'ľ' | 'ŀ' | 'ł' => "l",
        'ñ' | 'ń' | 'ņ' | 'ň' => "n",
        'ò'..='õ' | 'ō' | 'ŏ' | 'ő' => "o",
        'ŕ' | 'ŗ' | 'ř' => "r",
        'ś' | 'ŝ' | 'ş' | 'š' | 'ș' => "s",
        'ţ' | 'ť' | 'ŧ' | 'ț' => "t",
        'ù'..='û' | 'ũ' | 'ū' | 'ŭ' | 'ů' | 'ű' | 'ų' => "u",
        'ŵ' => "w",
        'ý' | 'ÿ' | 'ŷ' => "y",
        'ź' | 'ż' | 'ž' => "z",
        // Micro, as a sign and as a letter; ohm is omega in small letters.
        '\u{B5}' | '\u{3BC}' => "u",
        '\u{3C9}' => "ohm",
        // Capital i with a dot, and kelvin.
        'i' if !character.is_ascii() => "i",
        'k' if !character.is_ascii() => "k",
        '¹' => "1",
        '²' => "2",
        '³' => "3",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn capitals_are_as_small_letters() {
        for (characters, text) in [
            ("äÄ", "ae"),
            ("öÖøØ", "oe"),
            ("üÜ", "ue"),
            ("ßẞ", "ss"),
            ("éÉèÈêÊ", "e"),
            ("İı", "i"),
            ("\u{B5}\u{3BC}", "u"),
            ("\u{2126}\u{3A9}", "ohm"),
        ] {
            for character in characters.chars() {
                assert_eq!(ascii(character), Some(text), "{character}");
            }
        }
        for character in ['a', '°', '速', 'д', ' ', '\0'] {
            assert_eq!(ascii(character), None);
        }
    }
}
