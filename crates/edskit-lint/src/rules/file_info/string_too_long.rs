use crate::rule::rule;
use crate::wording::count;
use crate::{Context, Report};
use edskit_model::{Encoding, Entry, Line, Shape, Span};

rule! {
    /// A text is longer than CiA 306 allows for its entry
    ///
    /// ## What it does
    /// Reports a text with more characters than its entry may have: 241 for `ParameterName`, 243 for `Description`
    /// and `ProductName`, 244 for `VendorName` and so on, in every section.
    ///
    /// ## Why is this bad
    /// The limits leave room for the key in a line of 255 characters. Readers with a buffer of that size cut the text
    /// off or refuse the file.
    ///
    /// ## Example
    /// ```eds
    /// [2000]
    /// ParameterName=Speed of the conveyor belt in the entry hall as measured by the encoder on the drive shaft, smoothed over the last eight revolutions, given in thousandths of a revolution per second, positive if the belt moves the goods towards the lift, negative if not
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [2000]
    /// ParameterName=Speed of the conveyor belt
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.4 to 6.3.
    pub(crate) static STRING_TOO_LONG = {
        code: "FIL009",
        name: "string-too-long",
        group: FileInfo,
        severity: Warning,
        since: "0.1.0",
        files: DEVICE_FILES,
        peers: [EdsDcfCheck("OBJ010"), EdsDcfCheck("MND003")],
        check: File(check),
    }
}

/// The smallest limit; nearly every line of a file is shorter.
const SMALLEST_LIMIT: usize = 241;

fn check(context: &Context<'_>, report: &mut Report) {
    let is_long = |line: &Line| line.span().len() > SMALLEST_LIMIT;
    if context.document().lines().iter().any(is_long) {
        for entry in context.sheet.entries().filter(|entry| is_long(entry.line())) {
            check_entry(context, entry, report);
        }
    }
}

fn check_entry(context: &Context<'_>, entry: Entry<'_>, report: &mut Report) {
    let Shape::Text(limit @ 1..) = entry.key().name.shape() else { return };
    let limit = usize::from(limit);
    let raw = entry.raw();
    if raw.len() <= limit {
        return;
    }
    // Bytes are characters in every encoding but UTF-8.
    let (characters, fitting) = match (context.document().encoding(), std::str::from_utf8(raw)) {
        (Encoding::Utf8, Ok(text)) => {
            (text.chars().count(), text.char_indices().nth(limit).map_or(raw.len(), |(offset, _)| offset))
        }
        _ => (raw.len(), limit),
    };
    if characters <= limit {
        return;
    }
    let key = entry.key_text();
    let span = entry.value_span();
    report
        .add(
            Span::new(span.start + fitting as u32, span.end),
            format!("{key} has {characters} characters, but the limit is {limit}"),
        )
        .here("what is too much")
        .help(format!("shorten it by {}", count(characters - limit, "character")));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, findings_in};

    #[test]
    fn limits_are_exact() {
        for (key, section, limit) in [
            ("Description", "FileInfo", 243),
            ("OrderCode", "DeviceInfo", 245),
            ("ParameterName", "2000sub1", 241),
            ("Line12", "Comments", 249),
        ] {
            let text = |length: usize| format!("[{section}]\n{key}={}\n", "x".repeat(length));
            assert!(findings(&STRING_TOO_LONG, &text(limit)).is_empty(), "{key}");
            let column = key.len() + 2 + limit;
            assert_eq!(
                findings(&STRING_TOO_LONG, &text(limit + 1)),
                [format!("2:{column} warning: {key} has {} characters, but the limit is {limit}", limit + 1)]
            );
        }
    }

    #[test]
    fn characters_count_not_bytes() {
        let text = format!("[FileInfo]\nDescription={}\n", "ü".repeat(243));
        assert!(findings(&STRING_TOO_LONG, &text).is_empty());
        assert_eq!(findings(&STRING_TOO_LONG, &text.replacen('ü', "üx", 1)).len(), 1);
        let latin = [&b"[FileInfo]\nDescription="[..], &[0xFC; 244], b"\n"].concat();
        assert_eq!(findings_in(&STRING_TOO_LONG, "a.eds", &latin).len(), 1);
    }

    #[test]
    fn keys_without_a_limit_may_be_long() {
        let long = "x".repeat(1000);
        let text = format!("[FileInfo]\nFileName={long}\nOwnKey={long}\n[2000]\nDefaultValue={long}\n");
        assert!(findings(&STRING_TOO_LONG, &text).is_empty());
    }
}
