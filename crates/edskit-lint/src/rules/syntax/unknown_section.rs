use super::by_object::by_object;
use crate::rule::rule;
use crate::wording::FEW;
use crate::{Context, Edit, Report, Severity};
use edskit_model::nearest;
use edskit_model::{Section, SectionKind};
use std::collections::{HashMap, HashSet};

rule! {
    /// A section is not one of CiA 306
    ///
    /// ## What it does
    /// Lists the sections that CiA 306 does not know. Sections whose names differ only in the number at their end are
    /// listed once. A name that looks like a known one is a warning, also with letters that look like digits (`[1AOO]`),
    /// and an error where the file is wrong without that section; the misspelt headers of one object are one finding. A
    /// sub-index above FFh is the matter of sub-index-too-large.
    ///
    /// ## Why is this bad
    /// Extensions are allowed, and other tools skip them. But a misspelt section is skipped in the same way, with
    /// everything in it.
    ///
    /// ## Example
    /// ```eds
    /// [FileInfo]
    /// FileName=example.eds
    /// [DevicInfo]
    /// VendorName=Example
    /// ```
    ///
    /// ## Use instead
    /// ```eds
    /// [FileInfo]
    /// FileName=example.eds
    /// [DeviceInfo]
    /// VendorName=Example
    /// ```
    ///
    /// ## References
    /// CiA 306 v1.3, 4.2.
    pub(crate) static UNKNOWN_SECTION = {
        code: "SYN023",
        name: "unknown-section",
        group: Syntax,
        severity: Info,
        since: "0.1.0",
        files: ALL_FILES,
        peers: [CanChkEds("unused section"), Dcfchk("unknown section in DCF")],
        check: File(check),
    }
}

/// Extensions that are well known, and the tool that writes them.
const EXTENSIONS: [(&str, &str); 2] =
    [("TypeDefinitions", "CANopenEditor"), ("StandardDataTypes", "CANFestival")];

/// How many names are compared with the known ones. A file with more unknown ones is not full of slips.
const MOST_COMPARED: usize = 1_000;

fn check(context: &Context<'_>, report: &mut Report) {
    let mut compared = 0;
    let mut groups: HashMap<String, usize> = HashMap::new();
    let mut listed: Vec<(Section<'_>, usize)> = Vec::new();
    let mut slips = Vec::new();
    for section in context.sheet.sections().filter(|section| section.kind() == SectionKind::Unknown) {
        let name = section.name();
        // SYN006 reports headers that are not even well formed, OBJ027 sub-indices that are too large.
        if name.is_empty() || section.line().closing_bracket().is_none() || has_large_sub_index(&name) {
            continue;
        }
        compared += 1;
        if compared <= MOST_COMPARED
            && let Some(known) = suggestion(context, &name)
        {
            let kind = SectionKind::of(known.as_bytes());
            slips.push((kind, Slip { section, kind, known }));
            continue;
        }
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit()).to_ascii_lowercase();
        let group = *groups.entry(stem).or_insert(listed.len());
        match listed.get_mut(group) {
            Some((_, count)) => *count += 1,
            None => listed.push((section, 1)),
        }
    }
    for group in by_object(slips) {
        misspelt(context, &group, report);
    }
    for (section, count) in listed {
        unknown(section, count, report);
    }
}

/// A misspelt header.
struct Slip<'a> {
    section: Section<'a>,
    /// The name that was meant, and what it is.
    known: String,
    kind: SectionKind,
}

/// The sections that misspelt headers mean.
pub(super) fn meant(context: &Context<'_>) -> Vec<SectionKind> {
    let unknown = context.sheet.sections().filter(|section| section.kind() == SectionKind::Unknown);
    let names = unknown.take(MOST_COMPARED).filter_map(|section| suggestion(context, &section.name()));
    let kinds = names.map(|name| SectionKind::of(name.as_bytes()));
    kinds.filter(|kind| *kind != SectionKind::Unknown).collect()
}

/// Reports the misspelt headers of one object, or one header of another section.
fn misspelt(context: &Context<'_>, slips: &[Slip<'_>], report: &mut Report) {
    let Some((first, rest)) = slips.split_first() else { return };
    let known = &first.known;
    let more = match rest.len() {
        0 => String::new(),
        1 => ", and one more header of the object is misspelt".to_owned(),
        more => format!(", and {more} more headers of the object are misspelt"),
    };
    let name = first.section.name();
    let message = format!("`[{name}]` is not a section of CiA 306; it looks like `[{known}]`{more}");
    let finding = report.add(first.section.name_span(), message);
    for slip in rest.iter().take(FEW) {
        finding.label(slip.section.name_span(), format!("this looks like `[{}]`", slip.known));
    }
    let is_missed = slips.iter().any(|slip| is_missed(context, slip.kind));
    finding.severity(if is_missed { Severity::Error } else { Severity::Warning });
    finding.help(format!("write `[{known}]` if that is meant"));
    // A section that is there already, or is meant twice, would stand twice.
    let mut kinds = HashSet::new();
    let is_free = |slip: &Slip<'_>| context.sheet.section(slip.kind).is_none();
    if slips.iter().all(|slip| is_free(slip) && kinds.insert(slip.kind)) {
        let title = match rest {
            [] => format!("Write `[{known}]`"),
            _ => format!("Write `[{known}]`, and the others in the same way"),
        };
        let edits = slips.iter().map(|slip| Edit::replace(slip.section.name_span(), slip.known.as_str()));
        finding.unsafe_fix(title, edits.collect());
    }
}

/// Whether a file is wrong without a section that it does not have: what a list names, or every file needs.
fn is_missed(context: &Context<'_>, kind: SectionKind) -> bool {
    let is_needed = match kind {
        SectionKind::DeviceInfo | SectionKind::MandatoryObjects => true,
        SectionKind::Object(index) => context.listing().is_listed(index),
        SectionKind::SubObject(index, _) => context.listing().is_described(index),
        _ => false,
    };
    is_needed && context.sheet.section(kind).is_none()
}

fn unknown(section: Section<'_>, count: usize, report: &mut Report) {
    let name = section.name();
    let others = match count {
        1 => String::new(),
        2 => ", and there is one more of the kind".to_owned(),
        _ => format!(", and there are {} more of the kind", count - 1),
    };
    let finding = report.add(section.name_span(), format!("`[{name}]` is not a section of CiA 306{others}"));
    if let Some((_, tool)) = EXTENSIONS.iter().find(|(known, _)| name.eq_ignore_ascii_case(known)) {
        finding.help(format!("it is an extension of {tool}; other tools skip it"));
    } else if name.len() > 4 && name.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        finding.severity(Severity::Warning).help("an index has four hexadecimal digits");
    } else {
        finding.help("extensions are allowed, but other tools skip them");
    }
}

/// The section that was meant, by its name.
fn suggestion(context: &Context<'_>, name: &str) -> Option<String> {
    let dense: String = name.chars().filter(|c| !matches!(c, ' ' | '\t' | '_' | '-' | '.')).collect();
    let kind = SectionKind::of(dense.as_bytes());
    // Many words are hexadecimal digits once their blanks are gone.
    if dense.len() < name.len() && !matches!(kind, SectionKind::Object(_)) && kind != SectionKind::Unknown {
        return kind.canonical_name();
    }
    if let Some(known) = with_digits(context, name) {
        return Some(known);
    }
    if let Some((index, rest)) = split_object(name) {
        if let Some(suffix) = nearest(rest, ["ObjectLinks", "Name", "Value", "Denotation"]) {
            return Some(format!("{index}{suffix}"));
        }
        let (word, digits) = rest.split_at_checked("sub".len())?;
        let is_sub_index =
            (1..=2).contains(&digits.len()) && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
        return (is_sub_index && nearest(word, ["sub"]).is_some()).then(|| format!("{index}sub{digits}"));
    }
    if let Some(known) = nearest(name, SectionKind::fixed_names()) {
        return Some(known.to_owned());
    }
    if let Some(rest) = name.strip_prefix(['M', 'm']) {
        let (module, word) = rest.split_at(rest.find(|c: char| !c.is_ascii_digit())?);
        if !module.is_empty() {
            let parts = ["ModuleInfo", "Comments", "FixedObjects", "SubExtends"];
            return nearest(word, parts).map(|part| format!("M{module}{part}"));
        }
    }
    // `[Device]` for `[DeviceInfo]`
    let begins = |known: &&str| known.get(..name.len()).is_some_and(|start| start.eq_ignore_ascii_case(name));
    let known = SectionKind::fixed_names().find(begins).filter(|_| name.len() >= 4)?;
    context.sheet.section(SectionKind::of(known.as_bytes())).is_none().then(|| known.to_owned())
}

/// The object or sub-object that a name means in which letters stand for digits that look like them: `1AOO`.
fn with_digits(context: &Context<'_>, name: &str) -> Option<String> {
    let (index, rest) = name.split_at_checked(4)?;
    let (word, sub_index) = match rest.split_at_checked("sub".len()) {
        Some((word, sub_index)) if word.eq_ignore_ascii_case("sub") => (word, sub_index),
        _ => (rest, ""),
    };
    let digits = |text: &str| -> String {
        let digit = |letter| match letter {
            'O' | 'o' => '0',
            'l' | 'I' | 'i' | '|' => '1',
            _ => letter,
        };
        text.chars().map(digit).collect()
    };
    let meant = format!("{}{word}{}", digits(index), digits(sub_index));
    let kind = SectionKind::of(meant.as_bytes());
    // A word without any digit may well be a name of its own.
    let is_listed = || kind.index().is_some_and(|index| context.listing().is_listed(index));
    let is_number = index.bytes().any(|byte| byte.is_ascii_digit()) || is_listed();
    (meant != name && kind.index().is_some() && is_number).then(|| kind.canonical_name()).flatten()
}

/// Four hexadecimal digits at the start of a name, and what follows.
fn split_object(name: &str) -> Option<(&str, &str)> {
    let (index, rest) = name.split_at_checked(4)?;
    index.bytes().all(|byte| byte.is_ascii_hexdigit()).then_some((index, rest)).filter(|_| !rest.is_empty())
}

/// Whether more than two digits stand behind `sub`.
fn has_large_sub_index(name: &str) -> bool {
    let sub_index = split_object(name).and_then(|(_, rest)| rest.split_at_checked("sub".len()));
    sub_index.is_some_and(|(word, digits)| {
        word.eq_ignore_ascii_case("sub")
            && digits.len() > 2
            && digits.bytes().all(|byte| byte.is_ascii_hexdigit())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{findings, fixed};
    use crate::{FileKind, Linter, RuleSet};
    use edskit_model::Datasheet;

    #[test]
    fn extensions_are_listed_once_for_each_stem() {
        let text = "[1000]\n[TypeDefinitions]\n[Colour1]\n[Colour2]\n[Colour33]\n[Shape]\n[]\n[Half\n";
        assert_eq!(
            findings(&UNKNOWN_SECTION, text),
            [
                "2:2 info: `[TypeDefinitions]` is not a section of CiA 306",
                "3:2 info: `[Colour1]` is not a section of CiA 306, and there are 2 more of the kind",
                "6:2 info: `[Shape]` is not a section of CiA 306",
            ]
        );
    }

    #[test]
    fn misspelt_names_are_recognised() {
        for (wrong, right) in [
            ("FielInfo", "FileInfo"),
            ("Mandatory Objects", "MandatoryObjects"),
            ("Device", "DeviceInfo"),
            ("DeviceCom", "DeviceComissioning"),
            ("1018sup1", "1018sub1"),
            ("1003Values", "1003Value"),
            ("M1ModulInfo", "M1ModuleInfo"),
            ("Comment", "Comments"),
        ] {
            assert_eq!(
                fixed(&UNKNOWN_SECTION, &format!("[1000]\n[{wrong}]\n")),
                format!("[1000]\n[{right}]\n")
            );
        }
        for (wrong, right) in [
            ("1AOO", "1A00"),
            ("l018", "1018"),
            ("I8OO", "1800"),
            ("10l8sub1", "1018sub1"),
            ("1018subl", "1018sub1"),
            ("6OOOName", "6000Name"),
        ] {
            assert_eq!(
                fixed(&UNKNOWN_SECTION, &format!("[1000]\n[{wrong}]\n")),
                format!("[1000]\n[{right}]\n")
            );
            let found =
                |before: &str| findings(&UNKNOWN_SECTION, &format!("{before}[1000]\n[{wrong}]\n")).remove(0);
            assert!(found("").contains(" warning"), "{wrong}");
            let listed = found(&format!("[OptionalObjects]\n1=0x{}\n[1018]\n", &right[..4]));
            let is_list = right.ends_with("Name");
            assert_eq!(listed.contains(" error"), right != "1018" && !is_list, "{listed}");
        }
        let listed = "[OptionalObjects]\n1=0xA000\n[AOOO]\n";
        assert_eq!(fixed(&UNKNOWN_SECTION, listed), listed.replace("AOOO", "A000"));
        for other in
            ["Foil", "AOOO", "Def", "DeviceX11", "1018x", "ABCDE", "A B", "M", "M1", "Makro", "1018sub"]
        {
            let text = format!("[1000]\n[{other}]\n");
            assert_eq!(fixed(&UNKNOWN_SECTION, &text), text);
        }
        assert_eq!(
            findings(&UNKNOWN_SECTION, "[FileInfo]\n[FielInfo]\n[File]\n"),
            [
                "2:2 warning: `[FielInfo]` is not a section of CiA 306; it looks like `[FileInfo]`",
                "3:2 info: `[File]` is not a section of CiA 306",
            ]
        );
    }

    #[test]
    fn one_slip_in_all_headers_of_an_object_is_one_finding() {
        let text = "[1A01]\n[1AOO]\n[1AOOsub0]\n[1AOOsub1]\n[1A01sub0]\n[lA01sub1]\n[1018sup1]\n[1018sup2]\n[FielInfo]\n";
        assert_eq!(
            findings(&UNKNOWN_SECTION, text),
            [
                "2:2 warning: `[1AOO]` is not a section of CiA 306; it looks like `[1A00]`, and 2 more headers of the object are misspelt",
                "6:2 error: `[lA01sub1]` is not a section of CiA 306; it looks like `[1A01sub1]`",
                "7:2 warning: `[1018sup1]` is not a section of CiA 306; it looks like `[1018sub1]`, and one more header of the object is misspelt",
                "9:2 warning: `[FielInfo]` is not a section of CiA 306; it looks like `[FileInfo]`",
            ]
        );
        let right = text
            .replace("1AOO", "1A00")
            .replace("lA01", "1A01")
            .replace("sup", "sub")
            .replace("Fiel", "File");
        assert_eq!(fixed(&UNKNOWN_SECTION, text), right);
        let listed = format!("[OptionalObjects]\n1=0x1A00\n{text}");
        assert!(findings(&UNKNOWN_SECTION, &listed)[0].starts_with("4:2 error"));
        // Which of the two is meant, nobody knows.
        let twice = "[1000]\n[1AOO]\n[1AOOsub1]\n[1A0Osub1]\n";
        assert_eq!(findings(&UNKNOWN_SECTION, twice).len(), 1);
        assert_eq!(fixed(&UNKNOWN_SECTION, twice), twice);
    }

    #[test]
    fn what_is_misspelt_is_not_missing_too() {
        let identity = "[1018]\nObjectType=9\n[1018sub0]\nDataType=5\n[1018subl]\nDataType=7\n";
        let pdo = "[1400]\nObjectType=9\n[1400subO]\nDataType=5\n[1400subl]\nDataType=7\n[1400sup2]\nDataType=5\n[1600]\nObjectType=9\n[1600sub0]\n";
        let mut rules = RuleSet::none();
        for code in ["SYN023", "COM013", "PDO026", "OBJ012", "OBJ008"] {
            rules.select(code).unwrap();
        }
        let linter = Linter::new(rules);
        for text in [identity, pdo] {
            let found = linter.lint(&Datasheet::parse(text.as_bytes()), FileKind::Eds, None);
            let codes: Vec<_> = found.iter().map(|finding| finding.rule.code).collect();
            assert_eq!(codes, ["SYN023"], "{text}");
        }
    }

    #[test]
    fn numbers_that_are_too_large() {
        let text = "[4900]\n[4900sub99]\n[4900sub100]\n[4900sub101]\n[4901sub1FF]\n[10000]\n";
        assert_eq!(findings(&UNKNOWN_SECTION, text), ["6:2 warning: `[10000]` is not a section of CiA 306",]);
    }
}
