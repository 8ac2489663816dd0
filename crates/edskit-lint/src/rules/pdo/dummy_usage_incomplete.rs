use crate::edits::add_lines;
use crate::rule::rule;
use crate::wording::few;
use crate::{Context, Edit, Report};
use edskit_model::{Entry, KeyName, Section, SectionKind};

rule! {
    /// DummyUsage says nothing of some data types
    ///
    /// ## What it does
    /// Reports a `[DummyUsage]` that lacks some of the entries `Dummy0001` to `Dummy0007`, or has them without a value or
    /// in hexadecimal.
    ///
    /// ## Why is this bad
    /// By the standard the data type cannot be mapped as a dummy then, and 0x1 is 1. But python-canopen asks for all seven,
    /// reads them in decimal, and refuses the whole file where it cannot.
    ///
    /// ## Example
    /// ```eds
    /// [DummyUsage]
    /// Dummy0002=0
    /// Dummy0003=0
    /// Dummy0004=0
    /// Dummy0005=1
    /// Dummy0006=1
    /// Dummy0007=1
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [DummyUsage]
    /// Dummy0001=0
    /// Dummy0002=0
    /// Dummy0003=0
    /// Dummy0004=0
    /// Dummy0005=1
    /// Dummy0006=1
    /// Dummy0007=1
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.6.2; engineering judgement: the readers in use.
    pub(crate) static DUMMY_USAGE_INCOMPLETE = {
        code: "PDO027",
        name: "dummy-usage-incomplete",
        group: Pdo,
        severity: Info,
        since: "0.1.0",
        files: DEVICE_FILES,
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    let Some(section) = context.sheet.section(SectionKind::DummyUsage) else { return };
    let entry = |number: u16| section.numbered(KeyName::Dummy, number);
    let absent: Vec<u16> = (1..=7).filter(|&number| entry(number).is_none()).collect();
    let empty: Vec<_> = (1..=7).filter_map(entry).filter(|entry| entry.is_empty()).collect();
    let mut edits: Vec<Edit> =
        empty.iter().map(|entry| Edit::insert(entry.value_span().start, "0")).collect();
    report_hexadecimal(section, report);
    if absent.is_empty() && edits.is_empty() {
        return;
    }
    let mut names: Vec<String> = absent.iter().map(|number| format!("`Dummy{number:04X}`")).collect();
    if names.is_empty() {
        names = empty.iter().map(|entry| format!("`{}`", entry.key_text())).collect();
    }
    let message = format!(
        "`[{}]` does not say what {} {}; python-canopen refuses the whole file without all seven",
        section.name(),
        few(names.iter()),
        if names.len() == 1 { "is" } else { "are" }
    );
    let lines: Vec<String> = absent.iter().map(|number| format!("Dummy{number:04X}=0")).collect();
    if !lines.is_empty() {
        let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
        edits.push(add_lines(section, &lines));
    }
    edits.sort_by_key(|edit| edit.span);
    // An empty entry at the end and the lines behind it would stand at one place.
    if edits.windows(2).any(|pair| pair[0].span == pair[1].span) {
        let texts: String = edits.iter().map(|edit| edit.replacement.as_str()).collect();
        edits = vec![Edit::insert(edits[0].span.start, texts)];
    }
    let finding = report.add(section.span(), message);
    for entry in empty {
        finding.label(entry.span(), "empty, which counts as missing");
    }
    finding
        .help("write 0 for what cannot be mapped as a dummy, which is what its absence means")
        .safe_fix("Write 0 for the missing ones", edits);
}

/// Reports flags that are written as hexadecimal numbers.
fn report_hexadecimal(section: Section<'_>, report: &mut Report) {
    let flags = section.all_numbered(KeyName::Dummy).filter(|entry| (1..=7).contains(&entry.key().number));
    let flags: Vec<(Entry<'_>, bool)> = flags
        .filter(|entry| matches!(entry.raw(), [b'0', b'x' | b'X', ..]))
        .filter_map(|entry| Some((entry, entry.flag().known()?)))
        .collect();
    let Some((first, flag)) = flags.first() else { return };
    let (value, digit) = (first.text(), u8::from(*flag));
    let message = format!(
        "`{}` is `{value}`; python-canopen reads it in decimal and refuses the whole file",
        first.key_text()
    );
    let edits =
        flags.iter().map(|(entry, flag)| Edit::replace(entry.value_span(), u8::from(*flag).to_string()));
    report
        .add(first.value_span(), message)
        .help(format!("write `{digit}`"))
        .safe_fix("Write the flags in decimal", edits.collect());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn every_missing_entry_is_added_as_0() {
        let text = "[DummyUsage]\r\nDummy0005=1\r\nDummy0006=\r\n";
        assert_eq!(
            findings(&DUMMY_USAGE_INCOMPLETE, text),
            [
                "1:1 info: `[DummyUsage]` does not say what `Dummy0001`, `Dummy0002`, `Dummy0003`, `Dummy0004` and 1 more are; python-canopen refuses the whole file without all seven"
            ]
        );
        assert_eq!(
            fixed(&DUMMY_USAGE_INCOMPLETE, text),
            "[DummyUsage]\r\nDummy0005=1\r\nDummy0006=0\r\nDummy0001=0\r\nDummy0002=0\r\nDummy0003=0\r\nDummy0004=0\r\nDummy0007=0\r\n"
        );
        let all: String = (1..=7).map(|number| format!("Dummy000{number}=0\n")).collect();
        assert_eq!(findings(&DUMMY_USAGE_INCOMPLETE, &format!("[DummyUsage]\n{all}")), [""; 0]);
        let empty = format!("[DummyUsage]\n{}", all.replace("3=0", "3="));
        assert_eq!(fixed(&DUMMY_USAGE_INCOMPLETE, &empty), format!("[DummyUsage]\n{all}"));
        assert_eq!(findings(&DUMMY_USAGE_INCOMPLETE, "[1000]\n"), [""; 0]);
        let hexadecimal = format!("[DummyUsage]\n{}", all.replace("2=0", "2=0x1").replace("5=0", "5=0x00"));
        assert_eq!(
            findings(&DUMMY_USAGE_INCOMPLETE, &hexadecimal),
            [
                "3:11 info: `Dummy0002` is `0x1`; python-canopen reads it in decimal and refuses the whole file"
            ]
        );
        let decimal = format!("[DummyUsage]\n{}", all.replace("2=0", "2=1"));
        assert_eq!(fixed(&DUMMY_USAGE_INCOMPLETE, &hexadecimal), decimal);
    }
}
