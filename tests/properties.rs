//! What holds for every input, whatever it is.

use edskit_lint::{Applicability, FileKind, Finding, Fix, Linter, RuleSet, Severity, fix};
use edskit_model::{Datasheet, Span, format, same_meaning};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select, subsequence};
use std::sync::LazyLock;

/// The files of the project: its own device files and the fixtures of its tests.
static FILES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let folders = ["eds", "tests/fixtures"].map(|folder| edskit_tests::root().join(folder));
    let files = folders.iter().flat_map(|folder| edskit_tests::files(folder, &["eds", "dcf", "cpj"]));
    files.map(|file| file.bytes).collect()
});

/// File names with the endings that count.
const NAMES: [&str; 3] = ["device.eds", "device.dcf", "nodelist.cpj"];

/// The most lines of a file of the project that one case looks at.
const WINDOW: usize = 120;

proptest! {
    #[test]
    fn any_bytes(bytes in vec(any::<u8>(), 0..400), name in select(&NAMES)) {
        check(&bytes, name)?;
    }

    #[test]
    fn anything_like_a_file((name, lines) in text()) {
        let text: String = lines.into_iter().flat_map(|(line, ending)| [line, ending.to_owned()]).collect();
        check(text.as_bytes(), name)?;
    }

    #[test]
    fn anything_like_a_file_that_is_not_utf8((name, lines) in text(), byte in 0x80_u8.., place in any::<Index>()) {
        let text: String = lines.into_iter().flat_map(|(line, ending)| [line, ending.to_owned()]).collect();
        let mut bytes = text.into_bytes();
        bytes.insert(place.index(bytes.len() + 1), byte);
        check(&bytes, name)?;
    }

    #[test]
    fn a_file_of_the_project_after_some_accidents(
        file in any::<Index>(),
        start in any::<Index>(),
        accidents in vec(accident(), 0..6),
        name in select(&NAMES),
    ) {
        let lines: Vec<&[u8]> = FILES[file.index(FILES.len())].split_inclusive(|&byte| byte == b'\n').collect();
        let start = start.index(lines.len());
        let mut bytes = lines[start..lines.len().min(start + WINDOW)].concat();
        for accident in accidents {
            accident.happen(&mut bytes);
        }
        check(&bytes, name)?;
    }
}

#[test]
fn the_files_of_the_project_as_they_are() {
    assert!(!FILES.is_empty());
    for bytes in FILES.iter() {
        for name in NAMES {
            check(bytes, name).unwrap();
        }
    }
}

/// What holds for the text, for the findings of every rule and their fixes, and for the canonical text.
fn check(bytes: &[u8], name: &str) -> Result<(), TestCaseError> {
    let sheet = Datasheet::parse(bytes);
    prop_assert_eq!(sheet.document().to_bytes(), bytes);
    let lint = || Linter::new(RuleSet::all()).lint(&sheet, FileKind::of(name), Some(name));
    let findings = lint();
    for finding in &findings {
        check_finding(finding, bytes)?;
    }
    prop_assert!(findings.is_sorted_by_key(|finding| finding.span().start));
    prop_assert_eq!(format!("{:?}", findings), format!("{:?}", lint()));
    for least in [Applicability::Safe, Applicability::Unsafe] {
        check_fixes(bytes, name, &findings, least)?;
    }
    check_format(&sheet)
}

/// All fixes together make no file worse, and change nothing where there is none.
fn check_fixes(
    bytes: &[u8],
    name: &str,
    findings: &[Finding],
    least: Applicability,
) -> Result<(), TestCaseError> {
    let linter = Linter::new(RuleSet::all());
    let fixed = fix(&linter, Datasheet::parse(bytes), FileKind::of(name), Some(name), least);
    let count = |findings: &[Finding], severity| {
        findings.iter().filter(|finding| finding.severity == severity).count()
    };
    let burden = |findings| {
        [Severity::Error, Severity::Warning, Severity::Info].map(|severity| count(findings, severity))
    };
    let result = fixed.sheet.document().to_bytes();
    prop_assert!(burden(&fixed.findings) <= burden(findings), "{}", result.escape_ascii());
    prop_assert!(fixed.applied > 0 || result == bytes, "{}", result.escape_ascii());
    Ok(())
}

fn check_format(sheet: &Datasheet) -> Result<(), TestCaseError> {
    let text = format(sheet);
    let shown = text.escape_ascii();
    let formatted = Datasheet::parse(&text);
    prop_assert_eq!(same_meaning(sheet, &formatted), Ok(()), "{}", shown);
    prop_assert!(format(&formatted) == text, "formatting again changes something: {}", shown);
    Ok(())
}

fn check_finding(finding: &Finding, bytes: &[u8]) -> Result<(), TestCaseError> {
    prop_assert!(!finding.labels.is_empty(), "{:?} has no place", finding);
    prop_assert!(!finding.message.is_empty(), "{:?} says nothing", finding);
    for label in &finding.labels {
        prop_assert!(is_place(label.span, bytes), "{:?} is no place in the file: {:?}", label, finding);
    }
    finding.fix.as_ref().map_or(Ok(()), |fix| check_fix(fix, finding, bytes))
}

fn check_fix(fix: &Fix, finding: &Finding, bytes: &[u8]) -> Result<(), TestCaseError> {
    prop_assert!(!fix.edits.is_empty() && !fix.title.is_empty(), "the fix is empty: {:?}", finding);
    for edit in &fix.edits {
        prop_assert!(is_place(edit.span, bytes), "{:?} is no place in the file: {:?}", edit, finding);
    }
    let in_order = fix.edits.is_sorted_by(|a, b| a.span.end <= b.span.start);
    prop_assert!(in_order, "edits overlap or are not in order: {:?}", finding);
    prop_assert!(fix.apply(bytes) != bytes, "the fix changes nothing: {:?}", finding);
    Ok(())
}

/// Whether a span lies in the file and, where that is UTF-8, cuts no character in two.
fn is_place(span: Span, bytes: &[u8]) -> bool {
    let (start, end) = (span.start as usize, span.end as usize);
    let cuts = std::str::from_utf8(bytes)
        .is_ok_and(|text| !text.is_char_boundary(start) || !text.is_char_boundary(end));
    start <= end && end <= bytes.len() && !cuts
}

type Text = (&'static str, Vec<(String, &'static str)>);

/// A file name, and lines with their endings.
fn text() -> impl Strategy<Value = Text> {
    (select(&NAMES), vec((line(), select(&["\n", "\n", "\n", "\r\n", "\r"][..])), 0..60))
}

fn line() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => section(),
        12 => entry(),
        1 => "[;# \t]{0,3}.{0,20}",
        1 => select(&["", "<<<<<<< mine", "=======", ">>>>>>> theirs", "\u{FEFF}", "key: value", "=", "[]"][..])
            .prop_map(str::to_owned),
    ]
}

/// A section header in any spelling: few indices, so that sections meet each other.
fn section() -> impl Strategy<Value = String> {
    let named = select(
        &[
            "FileInfo",
            "DeviceInfo",
            "DeviceComissioning",
            "DeviceCommissioning",
            "DummyUsage",
            "Comments",
            "Tools",
            "Tool1",
            "DynamicChannels",
            "SupportedModules",
            "ConnectedModules",
            "MandatoryObjects",
            "OptionalObjects",
            "ManufacturerObjects",
            "Topology",
            "Topology2",
        ][..],
    );
    prop_oneof![
        4 => "\\[(0x)?(0005|1000|1001|1003|1018|1400|1600|1800|1A00|1a00|2000|6000|7fff)(sub(0|1|2|01|FF))?\\]",
        1 => "\\[(1003|1600|2000)(Name|Value|Denotation|ObjectLinks)\\]",
        1 => "\\[M[0-2](ModuleInfo|Comments|FixedObjects|Fixed2000|Fixed2000sub1|SubExtends|SubExt6000)\\]",
        2 => named.prop_map(|name| format!("[{name}]")),
        1 => " ?\\[ ?[A-Za-z0-9 ]{0,12} ?\\]? ?(;.{0,5})?",
    ]
}

/// A key of any group with a value of any shape.
fn entry() -> impl Strategy<Value = String> {
    (key(), select(&["=", "=", "=", " = ", "=\t"][..]), value())
        .prop_map(|(key, equals, value)| key + equals + &value)
}

fn key() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => "(ParameterName|ObjectType|DataType|AccessType|DefaultValue|PDOMapping|LowLimit|HighLimit|SubNumber)",
        3 => "(ParameterValue|Denotation|CompactSubObj|ObjFlags|Count|ObjExtend|UploadFile|SRDOMapping|InvertedSRAD)",
        3 => "(FileName|FileVersion|FileRevision|EDSVersion|Description|CreationTime|CreationDate|LastEDS|CreatedBy)",
        3 => "(VendorName|VendorNumber|ProductName|RevisionNumber|BaudRate_(10|125|800)|NrOf[RT]XPDO|Granularity)",
        2 => "(SupportedObjects|NrOfEntries|ObjectLinks|Lines|Items|NrOfSeg|Nodes|NodeID|Baudrate|LSS_Supported)",
        3 => "([0-9]{1,3}|Line[0-9]|Dummy000[0-9]|Type[01]|Dir1|Range1|PPOffset1|Node[0-9]{1,3}(Present|Name|DCFName))",
        1 => "[a-zA-Z_ \u{E4}]{0,14}",
    ]
}

fn value() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => "(0x)?[0-9A-Fa-f]{0,9}",
        3 => "(0|1|7|8|9|0x0?[0-9]|0x000[1-9A-F]|0x1[0-9A-B]|rw|ro|wo|rwr|RWW|const|5 ?;.{0,4})",
        2 => "(0x[0-9]{1,3} ?\\+ ?)?\\$(NODEID|NodeId|NODE)( ?\\+ ?(0x)?[0-9A-F]{0,4}){0,3}",
        2 => "-?[0-9]{1,4}([.,][0-9]{1,3})?(e[0-9])?",
        2 => "[01][0-9][:-][0-9]{1,2}([AP]M|-(19|20)[0-9]{2})?",
        1 => "0x20000[01][0-4]0",
        2 => ".{0,12}",
        1 => "[a-z\"' \u{E4}\u{20AC}\u{1F600};#=]{0,12}",
    ]
}

/// Something that befalls a file.
#[derive(Clone, Debug)]
enum Accident {
    Delete(Index, usize),
    Double(Index, usize),
    Put(Index, String),
    Overwrite(Index, u8),
    Cut(Index),
    SwapLines(Index, Index),
}

fn accident() -> impl Strategy<Value = Accident> {
    let piece = prop_oneof![
        subsequence(&["\n", "[", "]", "=", ";", " ", "\0", "0x", "$NODEID+", "\u{E4}", "\u{1A}"][..], 1..3)
            .prop_map(|pieces| pieces.concat()),
        line(),
    ];
    prop_oneof![
        (any::<Index>(), 1_usize..40).prop_map(|(place, length)| Accident::Delete(place, length)),
        (any::<Index>(), 1_usize..400).prop_map(|(place, length)| Accident::Double(place, length)),
        (any::<Index>(), piece).prop_map(|(place, piece)| Accident::Put(place, piece)),
        (any::<Index>(), any::<u8>()).prop_map(|(place, byte)| Accident::Overwrite(place, byte)),
        any::<Index>().prop_map(Accident::Cut),
        (any::<Index>(), any::<Index>()).prop_map(|(one, other)| Accident::SwapLines(one, other)),
    ]
}

impl Accident {
    fn happen(self, bytes: &mut Vec<u8>) {
        let range = |bytes: &[u8], place: Index, length: usize| {
            let start = place.index(bytes.len() + 1);
            start..bytes.len().min(start + length)
        };
        match self {
            Self::Delete(place, length) => {
                bytes.drain(range(bytes, place, length));
            }
            Self::Double(place, length) => {
                let range = range(bytes, place, length);
                let piece = bytes[range.clone()].to_vec();
                bytes.splice(range.end..range.end, piece);
            }
            Self::Put(place, piece) => {
                let start = place.index(bytes.len() + 1);
                bytes.splice(start..start, piece.into_bytes());
            }
            Self::Overwrite(place, byte) => {
                if !bytes.is_empty() {
                    let place = place.index(bytes.len());
                    bytes[place] = byte;
                }
            }
            Self::Cut(place) => bytes.truncate(place.index(bytes.len() + 1)),
            Self::SwapLines(one, other) => {
                let mut lines: Vec<&[u8]> = bytes.split_inclusive(|&byte| byte == b'\n').collect();
                if !lines.is_empty() {
                    let (one, other) = (one.index(lines.len()), other.index(lines.len()));
                    lines.swap(one, other);
                    *bytes = lines.concat();
                }
            }
        }
    }
}
