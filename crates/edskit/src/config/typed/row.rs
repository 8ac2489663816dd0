//! Rows of a table as the manual prints it and the PC tool exports it: number, name, value, unit.

/// One row, whose cells are parts of the text that it was read from.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Row<'t> {
    /// Empty where the row gives none.
    pub(crate) number: &'t str,
    /// Likewise.
    pub(crate) name: &'t str,
    pub(crate) value: &'t str,
    /// Likewise.
    pub(crate) unit: &'t str,
}

impl<'t> Row<'t> {
    /// A row whose cells are divided by semicolons, tabs or bars.
    pub(crate) fn of_cells(line: &'t str) -> Option<Self> {
        Self::of_list(&cells(line)?)
    }

    fn of_list(cells: &[&'t str]) -> Option<Self> {
        let (number, rest) = match cells {
            [first, rest @ ..] if is_number(first) => (*first, rest),
            all => ("", all),
        };
        let (name, rest) = match rest {
            [value] => ("", &[*value][..]),
            [first, rest @ ..] if !is_value(first) => (*first, rest),
            all => ("", all),
        };
        let (value, unit) = (rest.first().copied()?, rest.get(1).copied().unwrap_or_default());
        let row = Self { number, name, value, unit };
        (!(number.is_empty() && name.is_empty())).then_some(row)
    }

    /// A row whose cells are divided by blanks. A name may have blanks of its own.
    pub(crate) fn of_words(line: &'t str) -> Option<Self> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let (number, rest) = match &words[..] {
            [first, rest @ ..] if is_number(first) && !rest.is_empty() => (*first, rest),
            all => ("", all),
        };
        let place = rest.iter().rposition(|word| is_value(word))?;
        let unit = match &rest[place + 1..] {
            [] => "",
            [first, .., last] => between(line, first, last),
            [only] => only,
        };
        let name = match &rest[..place] {
            [] => "",
            [only] => only,
            [first, .., last] => between(line, first, last),
        };
        let row = Self { number, name, value: rest[place], unit };
        (!(number.is_empty() && name.is_empty())).then_some(row)
    }

    /// Number and name as a key has them.
    pub(crate) fn key(&self) -> String {
        format!("{} {}", self.number, self.name).trim().to_owned()
    }

    /// The value with its unit.
    pub(crate) fn amount(&self) -> String {
        format!("{} {}", self.value, self.unit).trim().to_owned()
    }
}

/// The cells of a line that has dividers: semicolons, tabs or bars, outside of quotation marks.
pub(crate) fn cells(line: &str) -> Option<Vec<&str>> {
    let divider = [';', '\t', '|'].into_iter().find(|divider| line.contains(*divider))?;
    let mut is_quoted = false;
    let cells = line.split(|character: char| {
        is_quoted ^= character == '"';
        character == divider && !is_quoted
    });
    Some(cells.map(unquoted).collect())
}

/// From the start of one part of a line to the end of another.
fn between<'t>(line: &'t str, first: &str, last: &str) -> &'t str {
    let start = super::range_in(line, first).start;
    let end = super::range_in(line, last).end;
    line.get(start..end).unwrap_or_default()
}

/// A cell without blanks and quotation marks around it.
fn unquoted(cell: &str) -> &str {
    let cell = cell.trim();
    cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"')).unwrap_or(cell).trim()
}

/// Whether a cell is the number of a parameter.
pub(crate) fn is_number(cell: &str) -> bool {
    let digits = cell.strip_prefix(['P', 'p']).unwrap_or(cell);
    !digits.is_empty() && digits.len() <= 5 && digits.bytes().all(|byte| byte.is_ascii_digit())
}

/// Whether a cell is a value: it begins like a number, or consists of hexadecimal digits in upper case.
fn is_value(cell: &str) -> bool {
    let digits = cell.trim_start_matches(['+', '-', '\u{2212}', '\u{2013}', '$']);
    let is_hexadecimal = |byte: u8| byte.is_ascii_digit() || (b'A'..=b'F').contains(&byte);
    digits.starts_with(|character: char| character.is_ascii_digit())
        || (!digits.is_empty() && digits.len() <= 4 && digits.bytes().all(is_hexadecimal))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_the_manual_and_of_the_pc_tool() {
        let row = |number, name, value, unit| Some(Row { number, name, value, unit });
        for (line, expected) in [
            ("427;CanOpenMyNodeID;1;", row("427", "CanOpenMyNodeID", "1", "")),
            (
                "\"400\"\t\"CanStartTimeOutDelay\"\t\"1,0\"\t\"s\"",
                row("400", "CanStartTimeOutDelay", "1,0", "s"),
            ),
            ("16404 | CanOpTPDO5-16ID(0) | 57F | Hex", row("16404", "CanOpTPDO5-16ID(0)", "57F", "Hex")),
            ("835;-5", row("835", "", "-5", "")),
            ("7;\"a;b\";3;", row("7", "a;b", "3", "")),
            ("812;;3;", row("812", "", "3", "")),
            ("CanOpenMyNodeID;7", row("", "CanOpenMyNodeID", "7", "")),
            ("427;CanOpenMyNodeID;;", row("427", "CanOpenMyNodeID", "", "")),
            ("3;4", row("3", "", "4", "")),
        ] {
            assert_eq!(Row::of_cells(line), expected, "{line}");
        }
        for (line, expected) in [
            ("427 CanOpenMyNodeID 1", row("427", "CanOpenMyNodeID", "1", "")),
            ("400   CanStartTimeOutDelay   1,0   s", row("400", "CanStartTimeOutDelay", "1,0", "s")),
            ("16471 CanOpTPDO4-16Cyc (11) 0 ms", row("16471", "CanOpTPDO4-16Cyc (11)", "0", "ms")),
            ("CanOpRPDO1-4Cyc (1) 100 ms", row("", "CanOpRPDO1-4Cyc (1)", "100", "ms")),
            ("16404 CanOpTPDO5-16ID(0) C5 Hex", row("16404", "CanOpTPDO5-16ID(0)", "C5", "Hex")),
            ("835 FunctLoadEnable \u{2212}5", row("835", "FunctLoadEnable", "\u{2212}5", "")),
            ("427 1", row("427", "", "1", "")),
        ] {
            assert_eq!(Row::of_words(line), expected, "{line}");
        }
        assert_eq!(Row::of_cells("427 CanOpenMyNodeID 1"), None);
        assert_eq!(
            (Row::of_words("== x"), Row::of_words("Parametrierbeispiel:"), Row::of_words("")),
            (None, None, None)
        );
    }
}
