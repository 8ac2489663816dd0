use crate::edits::number_like;
use crate::numbering::one_wrong;
use crate::rule::rule;
use crate::{Context, Edit, Report};
use edskit_model::{Entry, KeyName, ModuleSection, Section, SectionKind};
use std::collections::BTreeSet;

rule! {
    /// A section counts more or less than there is
    ///
    /// ## What it does
    /// Compares `Lines` of `[Comments]` and `[MxComments]` with their lines, `Items` of `[Tools]` with the sections
    /// `[Tool1]`, `[Tool2]` and so on, and `NrOfSeg` of `[DynamicChannels]` with the segments. It also reports a number
    /// that is left out. Counts of objects and modules have rules of their own.
    ///
    /// ## Why is this bad
    /// Readers ask for 1 to the count. They miss what is behind it, or refuse the file where something is missing:
    /// python-canopen does so for comments.
    ///
    /// ## Example
    /// ```eds
    /// [Comments]
    /// Lines=3
    /// Line1=Made for the drive
    /// Line2=of the second edition
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [Comments]
    /// Lines=2
    /// Line1=Made for the drive
    /// Line2=of the second edition
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.7; CiA 306-3 v1.2.
    pub(crate) static WRONG_COUNT = {
        code: "SYN028",
        name: "wrong-count",
        group: Syntax,
        severity: Warning,
        since: "0.1.0",
        files: ALL_FILES,
        check: File(check),
    }
}

/// A kind of section that says how many of something there are.
struct Counted {
    /// Whether a section is of the kind.
    is_section: fn(SectionKind) -> bool,
    /// The key that counts.
    count: KeyName,
    /// What it counts.
    what: What,
    /// What messages call one of them.
    noun: &'static str,
}

/// What a section counts.
enum What {
    /// Its own entries with one of these keys, by their numbers.
    Entries(&'static [KeyName]),
    /// Sections of the file, by their numbers.
    Sections(fn(SectionKind) -> Option<u16>),
}

/// Every such kind that has no rule of its own.
const COUNTED: [Counted; 3] = [
    Counted {
        is_section: |kind| {
            matches!(kind, SectionKind::Comments | SectionKind::Module(_, ModuleSection::Comments))
        },
        count: KeyName::Lines,
        what: What::Entries(&[KeyName::Line]),
        noun: "line",
    },
    Counted {
        is_section: |kind| kind == SectionKind::Tools,
        count: KeyName::Items,
        what: What::Sections(|kind| match kind {
            SectionKind::Tool(number) => Some(number),
            _ => None,
        }),
        noun: "tool",
    },
    Counted {
        is_section: |kind| kind == SectionKind::DynamicChannels,
        count: KeyName::NrOfSeg,
        what: What::Entries(&[KeyName::Type, KeyName::Dir, KeyName::Range, KeyName::PpOffset]),
        noun: "segment",
    },
];

fn check(context: &Context<'_>, report: &mut Report) {
    for section in context.sheet.other_sections() {
        if let Some(counted) = COUNTED.iter().find(|counted| (counted.is_section)(section.kind())) {
            check_section(section, counted, report);
        }
    }
}

fn check_section(section: Section<'_>, counted: &Counted, report: &mut Report) {
    let (listed, filled) = counted.numbers(section);
    let (name, key, noun) = (section.name(), counted.count.spelling(), counted.noun);
    let has = |count: usize| match count {
        0 => format!("no {noun}"),
        count => crate::wording::count(count, noun),
    };
    let Some(entry) = section.filled(counted.count) else {
        // A section without anything needs no count, but python-canopen asks for that of comments.
        if !listed.is_empty() || counted.count == KeyName::Lines {
            let line = format!("{key}={}", listed.len());
            let finding = report.add(
                section.span(),
                format!("`[{name}]` has no `{key}`; there {} {}", are(listed.len()), has(listed.len())),
            );
            finding.help(format!("add `{line}`"));
            let is_whole = listed.last().is_none_or(|last| usize::from(*last) == listed.len());
            if is_whole && section.entry(counted.count).is_none() {
                let ending = section.sheet().document().line_ending().as_str();
                let place = section.line().span().end;
                finding.safe_fix("Add the count", vec![Edit::insert(place, format!("{ending}{line}"))]);
            }
        }
        return;
    };
    let Some(claimed) = entry.unsigned::<u16>().known().map(usize::from) else { return };
    // Either way of counting is right: with or without what has no value.
    if claimed == listed.len() || claimed == filled.len() {
        if let Some(last) = listed.last().filter(|last| usize::from(**last) > listed.len()) {
            report_gap(section, counted, &listed, *last, report);
        }
        return;
    }
    let number = number_like(listed.len() as u64, entry.raw());
    let finding = report.add(
        entry.value_span(),
        format!("`{key}` is {}, but there {} {}", entry.text(), are(listed.len()), has(listed.len())),
    );
    if let Some(last) = counted.entries(section).last() {
        finding.label(last.span(), format!("the last {noun}"));
    }
    finding.help(format!("write `{key}={number}`"));
    // Where a number is left out, something may have got lost.
    if listed.last().is_none_or(|last| usize::from(*last) == listed.len()) {
        finding
            .unsafe_fix("Write the number of what is there", vec![Edit::replace(entry.value_span(), number)]);
    }
}

fn are(count: usize) -> &'static str {
    if count == 1 || count == 0 { "is" } else { "are" }
}

fn report_gap(
    section: Section<'_>,
    counted: &Counted,
    listed: &BTreeSet<u16>,
    last: u16,
    report: &mut Report,
) {
    let noun = counted.noun;
    let missing = (1..=last).find(|number| !listed.contains(number)).unwrap_or(last);
    let entries: Vec<Entry<'_>> = counted.entries(section).collect();
    let wrong = one_wrong(entries.iter().map(|entry| entry.key().number));
    match wrong.and_then(|(place, due)| Some((entries.get(place)?, due))) {
        Some((entry, due)) => {
            let spelling = entry.key().name.spelling();
            report
                .add(entry.key_span(), format!("`{}` stands in the place of {noun} {due}", entry.key_text()))
                .help(format!("write `{spelling}{due}`"))
                .unsafe_fix(
                    format!("Write `{spelling}{due}`"),
                    vec![Edit::replace(entry.key_span(), format!("{spelling}{due}"))],
                );
        }
        None => {
            report
                .add(section.span(), format!("there is a {noun} {last}, but no {noun} {missing}"))
                .help(format!("number the {noun}s from 1 without a gap"));
        }
    }
}

impl Counted {
    /// The numbers of what is there, and of those that have a value.
    fn numbers(&self, section: Section<'_>) -> (BTreeSet<u16>, BTreeSet<u16>) {
        match self.what {
            What::Entries(_) => {
                let number = |entry: Entry<'_>| entry.key().number;
                let filled = self.entries(section).filter(|entry| !entry.is_empty()).map(number).collect();
                (self.entries(section).map(number).collect(), filled)
            }
            What::Sections(number) => {
                let sections = section.sheet().other_sections();
                let numbers: BTreeSet<u16> = sections.filter_map(|other| number(other.kind())).collect();
                (numbers.clone(), numbers)
            }
        }
    }

    /// The entries that are counted, in the order of the file.
    fn entries<'a>(&self, section: Section<'a>) -> impl Iterator<Item = Entry<'a>> {
        let keys = match self.what {
            What::Entries(keys) => keys,
            What::Sections(_) => &[],
        };
        section.entries().filter(move |entry| keys.contains(&entry.key().name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};

    fn found(text: &str) -> String {
        findings(&WRONG_COUNT, text).join("|")
    }

    #[test]
    fn lines_of_comments() {
        let lines = "Line1=a\nLine2=b\nLine3=\n";
        assert_eq!(found(&format!("[Comments]\nLines=3\n{lines}")), "");
        assert_eq!(found(&format!("[Comments]\nLines=2\n{lines}")), "", "an empty line need not count");
        for section in ["Comments", "M1Comments"] {
            let text = format!("[{section}]\nLines=0x05\n{lines}");
            assert_eq!(found(&text), "2:7 warning: `Lines` is 0x05, but there are 3 lines");
            assert_eq!(fixed(&WRONG_COUNT, &text), text.replace("0x05", "0x03"));
        }
        assert_eq!(
            found(&format!("[Comments]\nLines=1\n{lines}")),
            "2:7 warning: `Lines` is 1, but there are 3 lines"
        );
        assert_eq!(
            found(&format!("[Comments]\n{lines}")),
            "1:1 warning: `[Comments]` has no `Lines`; there are 3 lines"
        );
        assert_eq!(found("[Comments]\nLines=1\n"), "2:7 warning: `Lines` is 1, but there is no line");
        assert_eq!(found("[Comments]\n"), "1:1 warning: `[Comments]` has no `Lines`; there is no line");
        assert_eq!(fixed(&WRONG_COUNT, "[Comments]\nLine1=a\n"), "[Comments]\nLines=1\nLine1=a\n");
        assert_eq!(
            found("[Tools]\n") + &found("[Comments]\nLines=0\n") + &found("[Comments]\nLines=x\nLine1=a\n"),
            ""
        );
    }

    #[test]
    fn a_number_that_is_left_out() {
        let text = "[Comments]\nLines=3\nLine1=a\nLine22=b\nLine3=c\n";
        assert_eq!(found(text), "4:1 warning: `Line22` stands in the place of line 2");
        assert_eq!(fixed(&WRONG_COUNT, text), text.replace("22", "2"));
        assert_eq!(
            found("[Comments]\nLines=2\nLine3=a\nLine5=b\n"),
            "1:1 warning: there is a line 5, but no line 1"
        );
        let lost = "[Comments]\nLines=3\nLine1=a\nLine3=c\n";
        assert_eq!(found(lost), "2:7 warning: `Lines` is 3, but there are 2 lines");
        assert_eq!(fixed(&WRONG_COUNT, lost), lost, "line 2 may have got lost");
    }

    #[test]
    fn tools_and_segments() {
        assert_eq!(found("[Tools]\nItems=1\n[Tool1]\nName=a\n"), "");
        assert_eq!(
            found("[Tools]\nItems=2\n[Tool1]\nName=a\n"),
            "2:7 warning: `Items` is 2, but there is 1 tool"
        );
        assert_eq!(
            found("[Tools]\nItems=1\n[Tool1]\n[Tool2]\n"),
            "2:7 warning: `Items` is 1, but there are 2 tools"
        );
        assert_eq!(found("[Tools]\nItems=1\n[Tool2]\n"), "1:1 warning: there is a tool 2, but no tool 1");
        let segments = "Type1=5\nDir1=ro\nRange1=0xA000-0xA00F\nPPOffset1=0\n";
        assert_eq!(found(&format!("[DynamicChannels]\nNrOfSeg=1\n{segments}")), "");
        assert_eq!(
            found(&format!("[DynamicChannels]\nNrOfSeg=2\n{segments}")),
            "2:9 warning: `NrOfSeg` is 2, but there is 1 segment"
        );
        assert_eq!(
            found(&format!("[DynamicChannels]\nNrOfSeg=0\n{segments}")),
            "2:9 warning: `NrOfSeg` is 0, but there is 1 segment"
        );
    }
}
