//! Replacements that look like the rest of the file.

use crate::Edit;
use edskit_model::{Number, Radix, Section};

/// `value` in the notation of the number `raw`: hexadecimal of the same width where that is hexadecimal, else decimal.
pub(crate) fn number_like(value: u64, raw: &[u8]) -> String {
    match Number::parse(raw) {
        Ok(number) if number.radix() == Radix::Hexadecimal => {
            format!("0x{value:0width$X}", width = usize::from(number.digits()))
        }
        _ => value.to_string(),
    }
}

/// Adds lines behind the last entry of a section, or behind its header.
pub(crate) fn add_lines(section: Section<'_>, lines: &[&str]) -> Edit {
    let ending = section.sheet().document().line_ending().as_str();
    let text: String = lines.iter().flat_map(|line| [ending, line]).collect();
    Edit::insert(section.end().start, text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Applicability, Fix};
    use edskit_model::Datasheet;

    #[test]
    fn the_notation_stays() {
        assert_eq!(number_like(1, b"8"), "1");
        assert_eq!(number_like(10, b"0x08"), "0x0A");
        assert_eq!(number_like(300, b"0X8"), "0x12C");
        assert_eq!(number_like(9, b"010"), "9");
        assert_eq!(number_like(9, b"?"), "9");
    }

    #[test]
    fn lines_are_added_with_the_ending_of_the_file() {
        let added = |text: &str| {
            let sheet = Datasheet::parse(text.as_bytes());
            let edits = vec![add_lines(sheet.sections().next().unwrap(), &["a=1", "b=2"])];
            let fix = Fix { title: String::new(), applicability: Applicability::Safe, edits };
            String::from_utf8(fix.apply(text.as_bytes())).unwrap()
        };
        assert_eq!(added("[1000]\r\nx=0\r\n\r\n[1001]\r\n"), "[1000]\r\nx=0\r\na=1\r\nb=2\r\n\r\n[1001]\r\n");
        assert_eq!(added("[1000]"), "[1000]\na=1\nb=2");
    }
}
