//! Fixes do no harm on real files: safe ones leave the device as it is, and none makes a file worse.

use edskit_lint::{Applicability, FileKind, Finding, Fixed, Linter, RuleSet, Severity, fix};
use edskit_model::{Datasheet, Entry, KeyName, LineEnding, Number, Section, same_meaning};
use edskit_tests::CorpusFile;
use edskit_types::{DataType, Index};
use std::collections::{BTreeMap, HashMap, HashSet};

/// Rules whose safe fixes leave a file that says the same in other words, and how `is_same` tells: the list has an empty
/// section more or an item less, `SubNumber` is what is described, what is left out and what its absence means are the
/// same, `#` becomes `;`, what stood behind a value becomes a comment, a time gets its other digit.
const REWORDING: [&str; 11] = [
    "LST001", "LST003", "LST006", "OBJ007", "OBJ019", "OBJ029", "PDO027", "SYN011", "SYN012", "SYN028",
    "VAL012",
];
/// The time of [FileInfo] in its own form.
const TIME: &str = "FIL005";

#[test]
fn safe_fixes_leave_every_file_with_its_meaning() {
    let Some(corpus) = edskit_tests::corpus("safe fixes over the corpus") else { return };
    let mut rules = RuleSet::all();
    for rule in REWORDING.into_iter().chain([TIME]) {
        rules.ignore(rule).expect("the rule exists");
    }
    let linter = Linter::new(rules);
    for file in &corpus {
        let fixed = run(&linter, file, Applicability::Safe);
        if let Err(difference) = same_meaning(&Datasheet::parse(&file.bytes), &fixed.sheet) {
            panic!("{}: {difference}", file.name);
        }
    }
}

#[test]
fn safe_fixes_that_use_other_words_leave_the_device() {
    let Some(corpus) = edskit_tests::corpus("safe fixes that reword") else { return };
    let mut rules = RuleSet::none();
    for rule in REWORDING.into_iter().chain([TIME]) {
        rules.select(rule).expect("the rule exists");
    }
    let linter = Linter::new(rules);
    for file in &corpus {
        let fixed = run(&linter, file, Applicability::Safe);
        if let Err(difference) = same_device(&Datasheet::parse(&file.bytes), &fixed.sheet) {
            panic!("{}: {difference}", file.name);
        }
    }
}

#[test]
fn safe_fixes_bring_up_nothing_and_keep_the_bytes_of_the_rest() {
    let Some(corpus) = edskit_tests::corpus("what safe fixes bring up") else { return };
    let linter = Linter::new(RuleSet::all());
    for file in &corpus {
        let before = Datasheet::parse(&file.bytes);
        let fixed = run(&linter, file, Applicability::Safe);
        assert_eq!(fixed.refused, 0, "{}: a safe fix was refused", file.name);
        // Behind a comment in the value was a number that nobody could read, and now it is judged.
        let has_comments =
            findings(&linter, &before, file).iter().any(|finding| finding.rule.code == "SYN012");
        if !has_comments {
            let there = counts(&findings(&linter, &before, file));
            for (what, count) in counts(&fixed.findings) {
                assert!(there.get(&what).is_some_and(|&before| count <= before), "{}: {what:?}", file.name);
            }
        }
        let (source, after) = (before.document(), fixed.sheet.document());
        assert_eq!(source.encoding(), after.encoding(), "{}", file.name);
        assert_eq!(beyond_ascii(&file.bytes), beyond_ascii(after.to_bytes()), "{}", file.name);
        for ending in [LineEnding::Lf, LineEnding::CrLf, LineEnding::Cr] {
            let is_usual = ending == source.line_ending();
            assert!(is_usual || after.count_of(ending) <= source.count_of(ending), "{}", file.name);
        }
        let kept: HashSet<&[u8]> = after.to_bytes().split(|&byte| byte == b'\n').collect();
        let touched = file.bytes.split(|&byte| byte == b'\n').filter(|line| !kept.contains(line)).count();
        assert!(fixed.applied > 0 || touched == 0, "{}", file.name);
    }
}

#[test]
fn unsafe_fixes_make_no_file_worse() {
    let Some(corpus) = edskit_tests::corpus("unsafe fixes over the corpus") else { return };
    let linter = Linter::new(RuleSet::all());
    for file in &corpus {
        let before = Datasheet::parse(&file.bytes);
        let fixed = run(&linter, file, Applicability::Unsafe);
        let errors = |findings: &[Finding]| {
            findings.iter().filter(|finding| finding.severity == Severity::Error).count()
        };
        assert!(errors(&fixed.findings) <= errors(&findings(&linter, &before, file)), "{}", file.name);
        assert!(fixed.sheet.objects().len() >= before.objects().len(), "{}: objects are gone", file.name);
    }
}

/// The fixes of a file, which come to an end and leave nothing for a second run.
fn run(linter: &Linter, file: &CorpusFile, least: Applicability) -> Fixed {
    let again = |bytes: &[u8]| {
        fix(linter, Datasheet::parse(bytes), FileKind::of(&file.name), Some(&file.name), least)
    };
    let fixed = again(&file.bytes);
    assert!(fixed.converged, "{}: the fixes never end", file.name);
    let twice = again(fixed.sheet.document().to_bytes());
    assert_eq!(twice.applied, 0, "{}: a second run changes something", file.name);
    fixed
}

fn findings(linter: &Linter, sheet: &Datasheet, file: &CorpusFile) -> Vec<Finding> {
    linter.lint(sheet, FileKind::of(&file.name), Some(&file.name))
}

/// How many errors and warnings each rule has.
fn counts(findings: &[Finding]) -> HashMap<(&'static str, Severity), usize> {
    let mut counts = HashMap::new();
    for finding in findings.iter().filter(|finding| finding.severity > Severity::Info) {
        *counts.entry((finding.rule.code, finding.severity)).or_default() += 1;
    }
    counts
}

fn beyond_ascii(bytes: &[u8]) -> Vec<u8> {
    bytes.iter().copied().filter(|byte| !byte.is_ascii()).collect()
}

/// The entries of a section by their keys; of doubled ones the first.
fn entries<'a>(section: Section<'a>) -> BTreeMap<String, Entry<'a>> {
    let mut entries = BTreeMap::new();
    for entry in section.entries().filter(|entry| !entry.is_empty()) {
        entries.entry(entry.key_text().to_lowercase()).or_insert(entry);
    }
    entries
}

/// Whether both describe the same device, although one may use more words.
fn same_device(before: &Datasheet, after: &Datasheet) -> Result<(), String> {
    let mut sections: HashMap<String, Vec<Section<'_>>> = HashMap::new();
    for section in after.sections() {
        sections.entry(section.name().to_lowercase()).or_default().push(section);
    }
    let mut expected = 0;
    for section in before.sections() {
        expected += 1;
        let others = sections.get_mut(&section.name().to_lowercase()).filter(|others| !others.is_empty());
        let other =
            others.map(|others| others.remove(0)).ok_or_else(|| format!("{} is gone", section.name()))?;
        let (left, right) = (entries(section), entries(other));
        if is_list(&section) {
            let items = |entries: &BTreeMap<String, Entry<'_>>| -> HashSet<Vec<u8>> {
                let items = entries.values().filter(|entry| entry.key().name == KeyName::Item);
                items.map(|entry| entry.raw().to_vec()).collect()
            };
            if items(&left) != items(&right) {
                return Err(format!("[{}] lists other objects", section.name()));
            }
            continue;
        }
        for key in left.keys().chain(right.keys()) {
            let (left, right) = (left.get(key), right.get(key));
            if !is_same(section, left.copied(), right.copied()) {
                return Err(format!("{key} of [{}] differs", section.name()));
            }
        }
    }
    let added = after.sections().len() - expected;
    let are_empty = sections
        .values()
        .flatten()
        .all(|section| is_list(section) && section.entries().all(|entry| entry.raw() == b"0"));
    if are_empty { Ok(()) } else { Err(format!("{added} sections are added")) }
}

/// Whether two entries of one key say the same, where none says what counts anyway.
fn is_same(section: Section<'_>, left: Option<Entry<'_>>, right: Option<Entry<'_>>) -> bool {
    match (left, right) {
        (Some(left), Some(right)) => {
            let (old, new) = (left.raw(), right.raw());
            let is_time = matches!(left.key().name, KeyName::CreationTime | KeyName::ModificationTime);
            let behind = old.strip_prefix(new).map(<[u8]>::trim_ascii_start);
            old == new
                || behind.is_some_and(|behind| matches!(behind.first(), Some(b';' | b'#')))
                || (is_time && minutes(old).is_some_and(|time| minutes(new) == Some(time)))
        }
        (Some(left), None) => match left.key().name {
            KeyName::ObjFlags => left.unsigned::<u32>().known() == Some(0),
            KeyName::LowLimit => range(section).is_some_and(|(low, _)| integer(left) == Some(low)),
            KeyName::HighLimit => range(section).is_some_and(|(_, high)| integer(left) == Some(high)),
            _ => left.key_text().starts_with('#'),
        },
        (None, Some(right)) => match right.key().name {
            KeyName::SubNumber | KeyName::Lines => true,
            KeyName::Dummy => right.raw() == b"0",
            KeyName::DataType => right.raw() == b"0x000F",
            KeyName::AccessType => right.raw() == b"rw",
            _ => false,
        },
        (None, None) => true,
    }
}

fn is_list(section: &Section<'_>) -> bool {
    section.kind().is_object_list()
}

fn integer(entry: Entry<'_>) -> Option<i128> {
    Number::parse(entry.raw()).ok().map(Number::value)
}

/// What the data type of the section holds.
fn range(section: Section<'_>) -> Option<(i128, i128)> {
    let index = section.filled(KeyName::DataType)?.unsigned::<u16>().known()?;
    DataType::from_index(Index(index))?.range()
}

/// The minute of the day, on a clock of 12 hours or of 24.
fn minutes(time: &[u8]) -> Option<u32> {
    let time = std::str::from_utf8(time).ok()?.to_ascii_uppercase();
    let numbers: Vec<u32> = time
        .split(|character: char| !character.is_ascii_digit())
        .filter_map(|digits| digits.parse().ok())
        .collect();
    let &[hour, minute, ..] = &numbers[..] else { return None };
    let hour = match (hour, time.contains("AM"), time.contains("PM")) {
        (12, true, _) => 0,
        (1..12, _, true) => hour + 12,
        _ => hour,
    };
    Some(60 * hour + minute)
}
