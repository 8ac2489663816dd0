//! Text of a file that goes to a terminal or into a log.

use edskit_lint::Finding;

/// What stands for a character that a terminal would obey or hide, so that a file cannot steer it: the picture of a
/// control character, or U+FFFD.
pub(crate) fn character(character: char) -> char {
    match character {
        '\0'..='\u{1F}' => char::from_u32(0x2400 + u32::from(character)).unwrap_or('\u{FFFD}'),
        '\u{7F}' => '\u{2421}',
        _ if character.is_control() || is_invisible(character) => '\u{FFFD}',
        _ => character,
    }
}

/// A text of one line.
pub(crate) fn line(text: &str) -> String {
    text.chars().map(character).collect()
}

/// Everything that a finding says, which may quote the file.
pub(crate) fn finding(finding: &mut Finding) {
    let clean = |text: &mut String| {
        if text.chars().any(|c| character(c) != c) {
            *text = line(text);
        }
    };
    clean(&mut finding.message);
    finding.help.iter_mut().for_each(clean);
    finding.labels.iter_mut().for_each(|label| clean(&mut label.text));
}

/// Characters that have no width or change the direction of text, which make it look different from what it is.
fn is_invisible(character: char) -> bool {
    matches!(character, '\u{200B}'..='\u{200F}' | '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}' | '\u{FEFF}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_to_obey() {
        assert_eq!(line("a\u{1b}[31m\0\u{7f}\u{85}\u{202e}ü"), "a␛[31m␀␡\u{FFFD}\u{FFFD}ü");
    }
}
