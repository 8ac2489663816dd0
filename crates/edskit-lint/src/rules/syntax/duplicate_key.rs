use super::lost_header;
use crate::numbering::one_wrong;
use crate::rule::rule;
use crate::{Context, Edit, Report, Severity};
use edskit_model::{Entry, Key, KeyName, Section, SectionKind};
use std::collections::hash_map::{self, HashMap};

rule! {
    /// A key stands twice in a section
    ///
    /// ## What it does
    /// Reports a key that its section has already, in whatever case. Both places are shown. It is a warning where both
    /// have the same value.
    ///
    /// ## Why is this bad
    /// Readers differ: some refuse the file, some take the first value, some the last one.
    ///
    /// ## Example
    /// ```eds
    /// [1018]
    /// ParameterName=Identity
    /// SubNumber=2
    /// SubNumber=5
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [1018]
    /// ParameterName=Identity
    /// SubNumber=5
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static DUPLICATE_KEY = {
        code: "SYN014",
        name: "duplicate-key",
        group: Syntax,
        severity: Error,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [CanChkEds("25"), EdsDcfCheck("INI003")],
        check: File(check),
    }
}

fn check(context: &Context<'_>, report: &mut Report) {
    for section in context.sheet.sections() {
        if may_repeat(section) {
            check_section(context, section, report);
        }
    }
}

/// Whether a key may stand twice: a glance that needs no table. A key without a number is looked up by its name;
/// numbered keys are fine as long as they ascend.
fn may_repeat(section: Section<'_>) -> bool {
    let mut seen = [false; 128];
    let mut last = Key::fixed(KeyName::Unknown);
    for key in section.keys() {
        let again = if key.number == 0 {
            std::mem::replace(&mut seen[key.name as usize % 128], true)
        } else {
            std::mem::replace(&mut last, key) >= key
        };
        if again {
            return true;
        }
    }
    false
}

/// For so many doubled keys of a section the one that is due is looked for. Where there are more, the list is no list.
const MOST_LOOKED_AT: usize = 16;

fn check_section(context: &Context<'_>, section: Section<'_>, report: &mut Report) {
    let mut known = HashMap::new();
    let mut found = 0;
    for entry in section.entries() {
        // What follows a header that lost its line belongs to that section; see SYN008.
        if entry.raw().ends_with(b"]") && lost_header::on_line(context, entry.line_number()).is_some() {
            return;
        }
        let spelling = entry.key_span().slice(context.source()).to_ascii_lowercase();
        match known.entry(spelling) {
            hash_map::Entry::Vacant(free) => {
                free.insert(entry);
            }
            hash_map::Entry::Occupied(first) => {
                found += 1;
                let due = if found <= MOST_LOOKED_AT { due_key(section, entry) } else { None };
                repeated(*first.get(), entry, due, report);
            }
        }
    }
}

fn repeated(first: Entry<'_>, again: Entry<'_>, due: Option<String>, report: &mut Report) {
    let key = again.key_text();
    let same = first.raw() == again.raw();
    let message = if same {
        format!("the key `{key}` stands a second time, with the same value")
    } else {
        format!("the key `{key}` stands a second time: it is `{}`, then `{}`", first.text(), again.text())
    };
    let finding = report.add(again.span(), message);
    finding.here("the second one").label(first.span(), "the first one");
    if same {
        finding
            .severity(Severity::Warning)
            .help("delete one of the two")
            .safe_fix("Delete the second one", vec![Edit::delete(again.line().full_span())]);
    } else if let Some(key) = due {
        let own = format!("{key}={}", again.text());
        finding
            .help(format!("write `{own}` if it has a place of its own, or delete one of the two"))
            .unsafe_fix(format!("Write `{own}`"), vec![Edit::replace(again.key_span(), key)]);
    } else {
        finding.help("keep the value that was meant, and delete the other entry");
    }
}

/// The key that is due where a number of a list stands a second time: the one that is missing there.
fn due_key(section: Section<'_>, again: Entry<'_>) -> Option<String> {
    let name = again.key().name;
    let (spelling, number) = (name.spelling(), again.key().number);
    if number == 0 || !matches!(name, KeyName::Item | KeyName::Line) {
        return None;
    }
    let entries: Vec<Entry<'_>> = section.all_numbered(name).collect();
    let only = one_wrong(entries.iter().map(|entry| entry.key().number));
    let due = match only {
        Some((place, due)) if entries.get(place).map(|entry| entry.id()) == Some(again.id()) => due,
        Some(_) => return None,
        // The keys of compact lists are sub-indexes, of which any may be left out.
        None if matches!(
            section.kind(),
            SectionKind::CompactNames(_) | SectionKind::CompactValues(_) | SectionKind::CompactDenotations(_)
        ) =>
        {
            return None;
        }
        None => number.checked_add(1).filter(|next| section.numbered(name, *next).is_none())?,
    };
    Some(format!("{spelling}{due}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    #[test]
    fn case_does_not_matter_but_zeros_do() {
        let text = "[1018]\nSubNumber=2\nsubnumber=3\n[DummyUsage]\nDummy0002=1\nDummy0001=1\nDummy0002=1\n";
        assert_eq!(
            findings(&DUPLICATE_KEY, text),
            [
                "3:1 error: the key `subnumber` stands a second time: it is `2`, then `3`",
                "7:1 warning: the key `Dummy0002` stands a second time, with the same value",
            ]
        );
        assert_eq!(
            fixed(&DUPLICATE_KEY, text),
            "[1018]\nSubNumber=2\nsubnumber=3\n[DummyUsage]\nDummy0002=1\nDummy0001=1\n"
        );
        assert_eq!(findings(&DUPLICATE_KEY, "[MandatoryObjects]\n1=0x1000\n01=0x1001\n"), [""; 0]);
    }

    #[test]
    fn an_item_whose_number_stands_twice_is_not_lost() {
        for (section, key) in
            [("OptionalObjects", ""), ("M1FixedObjects", ""), ("2000ObjectLinks", ""), ("Comments", "Line")]
        {
            let text = format!("[{section}]\n{key}1=0x3077\n{key}2=0x3078\n{key}2=0x3079\n{key}4=0x3080\n");
            let mended = text.replace("2=0x3079", "3=0x3079");
            assert_eq!(fixed(&DUPLICATE_KEY, &text), mended);
            let last = format!("[{section}]\n{key}1=0x3077\n{key}2=0x3078\n{key}2=0x3079\n");
            assert_eq!(fixed(&DUPLICATE_KEY, &last), last.replace("2=0x3079", "3=0x3079"));
            let full = format!("[{section}]\n{key}1=0x3077\n{key}2=0x3078\n{key}3=0x3080\n{key}2=0x3079\n");
            assert_eq!(fixed(&DUPLICATE_KEY, &full), full.replace("2=0x3079", "4=0x3079"));
        }
        let compact = "[2000Value]\n2=1\n2=5\n4=1\n";
        assert_eq!(fixed(&DUPLICATE_KEY, compact), compact);
    }

    #[test]
    fn what_follows_a_lost_header_is_no_repetition() {
        let text =
            "[1000]\nParameterName=a\nPDOMapping=0[1001]\nParameterName=b\n[1002]\nDataType=5\nDataType=6\n";
        assert_eq!(findings(&DUPLICATE_KEY, text).len(), 1);
    }

    #[test]
    fn unknown_keys_and_sections_count_too() {
        assert_eq!(
            findings(&DUPLICATE_KEY, "[1000]\nUnit=a\nFactor=1\nUNIT=b\n[x]\na=1\n[y]\na=1\na=2\n").len(),
            2
        );
    }

    #[test]
    fn a_list_of_any_order_is_read_once() {
        let mut text = "[MandatoryObjects]\n".to_owned();
        for item in (0..60_000).rev() {
            text.push_str(&format!("{item}=0x1000\n"));
        }
        assert_eq!(findings(&DUPLICATE_KEY, &text), [""; 0]);
        text.push_str("0=0x1000\n");
        assert_eq!(findings(&DUPLICATE_KEY, &text).len(), 1);
    }
}
