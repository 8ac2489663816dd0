use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Encoding, Line, Span};

rule! {
    /// The file holds characters beyond ASCII
    ///
    /// ## What it does
    /// Reports bytes above 7Fh, once for the file: the first place, what the character is, how it was read, and up to
    /// three other lines.
    ///
    /// ## Why is this bad
    /// CiA 306 allows 7-bit ISO/IEC 646 (ASCII) only. Nothing in the file says which encoding was used, so readers show
    /// other characters or refuse the file, and that also where the byte stands in a comment.
    ///
    /// ## Example
    /// ```eds
    /// [DeviceInfo]
    /// VendorName=Müller
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DeviceInfo]
    /// VendorName=Mueller
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static NON_ASCII = {
        code: "SYN001",
        name: "non-ascii",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [EdsDcfCheck("LIB001")],
        check: File(check),
    }
}

/// How many lines are shown besides the first one.
const SHOWN: usize = 3;

/// What stands for a character in ASCII, for those that data sheets use.
const REPLACEMENTS: &[(char, &str)] = &[
    ('ä', "ae"),
    ('ö', "oe"),
    ('ü', "ue"),
    ('Ä', "Ae"),
    ('Ö', "Oe"),
    ('Ü', "Ue"),
    ('ß', "ss"),
    ('à', "a"),
    ('á', "a"),
    ('â', "a"),
    ('ç', "c"),
    ('è', "e"),
    ('é', "e"),
    ('É', "E"),
    ('ê', "e"),
    ('í', "i"),
    ('î', "i"),
    ('ñ', "n"),
    ('ó', "o"),
    ('ô', "o"),
    ('ú', "u"),
    ('å', "a"),
    ('ø', "o"),
    ('æ', "ae"),
    ('\u{A0}', " "),
    ('®', "(R)"),
    ('©', "(C)"),
    ('™', "(TM)"),
    ('°', "deg"),
    ('±', "+/-"),
    ('²', "^2"),
    ('³', "^3"),
    ('µ', "u"),
    ('μ', "u"),
    ('α', "alpha"),
    ('β', "beta"),
    ('Δ', "Delta"),
    ('Ω', "Ohm"),
    ('€', "EUR"),
    ('·', "*"),
    ('×', "x"),
    ('–', "-"),
    ('—', "-"),
    ('‘', "'"),
    ('’', "'"),
    ('“', "\""),
    ('”', "\""),
    ('„', "\""),
    ('…', "..."),
];

fn check(context: &Context<'_>, report: &mut Report) {
    let document = context.document();
    let encoding = document.encoding();
    if encoding == Encoding::Ascii {
        return;
    }
    let mut lines = document.lines().iter().filter(|line| !document.slice(line.span()).is_ascii());
    let Some(line) = lines.next() else { return };
    let Some((span, first)) = character(context, line) else { return };
    let others: Vec<&Line> = lines.collect();
    let read = match encoding {
        Encoding::Windows1252 => format!(
            "the byte {:02X}h, `{first}` (U+{:04X}) in {}",
            document.slice(span)[0],
            u32::from(first),
            encoding.name()
        ),
        _ => format!("`{first}` (U+{:04X})", u32::from(first)),
    };
    let message = match others.len() {
        0 => format!("{read} is not ASCII"),
        more => format!("{} lines are not all ASCII, beginning with {read}", more + 1),
    };
    let finding = report.add(span, message);
    for line in others.iter().take(SHOWN) {
        if let Some((span, other)) = character(context, line) {
            finding.label(span, format!("`{other}` here"));
        }
    }
    if first == char::REPLACEMENT_CHARACTER {
        finding.help("a conversion between encodings has lost the character; write it again, in ASCII");
        return;
    }
    finding.help(match replacement(first) {
        Some(ascii) => format!("write `{ascii}` in its place"),
        None => "write ASCII in its place".to_owned(),
    });
    if let Some(edits) = edits(context, line, &others) {
        finding.unsafe_fix("Write ASCII instead", edits);
    }
}

fn replacement(character: char) -> Option<&'static str> {
    REPLACEMENTS.iter().find(|(known, _)| *known == character).map(|(_, ascii)| *ascii)
}

/// The first character of a line that is not ASCII.
fn character(context: &Context<'_>, line: &Line) -> Option<(Span, char)> {
    characters(context, line).find(|(_, character)| !character.is_ascii())
}

/// The characters of a line with their places.
fn characters(context: &Context<'_>, line: &Line) -> impl Iterator<Item = (Span, char)> {
    let utf8 = context.document().encoding() == Encoding::Utf8;
    let text = context.sheet.text(line.span()).into_owned();
    let characters: Vec<char> = text.chars().collect();
    let mut start = line.span().start;
    characters.into_iter().map(move |character| {
        let length = if utf8 { character.len_utf8() as u32 } else { 1 };
        let span = Span::new(start, start + length);
        start = span.end;
        (span, character)
    })
}

/// The edits that put ASCII in the place of every other character, if each of them has such a stand-in.
fn edits(context: &Context<'_>, first: &Line, others: &[&Line]) -> Option<Vec<Edit>> {
    let lines = std::iter::once(first).chain(others.iter().copied());
    let foreign =
        lines.flat_map(|line| characters(context, line)).filter(|(_, character)| !character.is_ascii());
    foreign.map(|(span, character)| Some(Edit::replace(span, replacement(character)?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in, fixed, fixed_in};

    #[test]
    fn one_finding_names_the_first_place_and_the_number_of_lines() {
        let text = "; Größe\n[1000]\nParameterName=Temperature °C\nDenotation=é\n";
        assert_eq!(
            findings(&NON_ASCII, text),
            ["1:5 warning: 3 lines are not all ASCII, beginning with `ö` (U+00F6)"]
        );
        assert_eq!(
            fixed(&NON_ASCII, text),
            "; Groesse\n[1000]\nParameterName=Temperature degC\nDenotation=e\n"
        );
        assert_eq!(findings(&NON_ASCII, "[1000]\nParameterName=a\n"), [""; 0]);
    }

    #[test]
    fn other_encodings_are_named() {
        let text = b"[1000]\nParameterName=M\xFCller \xB5m\n";
        assert_eq!(
            findings_in(&NON_ASCII, "a.eds", text),
            ["2:16 warning: the byte FCh, `ü` (U+00FC) in windows-1252 is not ASCII"]
        );
        assert_eq!(fixed_in(&NON_ASCII, "a.eds", text), b"[1000]\nParameterName=Mueller um\n");
    }

    #[test]
    fn what_has_no_stand_in_has_no_fix() {
        assert_eq!(fixed(&NON_ASCII, "[1000]\nParameterName=中\n"), "[1000]\nParameterName=中\n");
        assert_eq!(
            findings(&NON_ASCII, "[1000]\nParameterName=\u{FFFD}\n"),
            ["2:15 warning: `\u{FFFD}` (U+FFFD) is not ASCII"]
        );
    }
}
