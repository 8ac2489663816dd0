//! Every real file of the corpus can be read, whole or cut off.

use edskit_lint::{FileKind, Finding, Linter, RuleSet};
use edskit_model::{Datasheet, Document, Line};
use edskit_tests::CorpusFile;

/// How many EDS and DCF files the corpus has.
const FILES: usize = 171;

/// The one file that lists objects and describes none: how its name begins.
const NO_OBJECT: &str = "c114dbc9";

/// Into how many equal parts a file is cut.
const PARTS: usize = 16;

#[test]
fn every_file_comes_back_byte_for_byte() {
    let Some(corpus) = corpus("the round trip of the corpus") else { return };
    for file in &corpus {
        let document = Document::parse(&file.bytes);
        assert!(document.to_bytes() == file.bytes, "{}", file.name);
        assert!(document.is_complete(), "{}", file.name);
        assert!(tiles(&document), "{}: a byte belongs to no line, or to two", file.name);
    }
}

#[test]
fn every_file_loads() {
    let Some(corpus) = corpus("loading the corpus") else { return };
    let linter = Linter::new(RuleSet::all());
    for file in &corpus {
        let sheet = Datasheet::parse(&file.bytes);
        assert_eq!(sheet.objects().len() == 0, file.name.starts_with(NO_OBJECT), "{}", file.name);
        let findings = lint(&linter, &sheet, &file.name);
        assert!(!is_foreign(&findings), "{}: this is a CANopen file", file.name);
    }
}

#[test]
fn files_that_are_not_canopen_get_one_finding() {
    let Some(shared) = edskit_tests::shared("the files that are not CANopen") else { return };
    let files = edskit_tests::files(&shared.join("corpus/not-canopen"), &["eds"]);
    assert_eq!(files.len(), 3);
    for file in &files {
        let findings = lint(&Linter::new(RuleSet::all()), &Datasheet::parse(&file.bytes), &file.name);
        assert!(is_foreign(&findings), "{}: {findings:?}", file.name);
    }
}

#[test]
fn every_file_can_be_cut_off_anywhere() {
    let Some(corpus) = corpus("reading cut files of the corpus") else { return };
    let linter = Linter::new(RuleSet::all());
    for file in &corpus {
        for part in 1..=PARTS {
            let cut = &file.bytes[..file.bytes.len() * part / PARTS];
            let sheet = Datasheet::parse(cut);
            assert!(sheet.document().to_bytes() == cut, "{}: {part}/{PARTS}", file.name);
            lint(&linter, &sheet, &file.name);
        }
    }
}

fn corpus(what: &str) -> Option<Vec<CorpusFile>> {
    let corpus = edskit_tests::corpus(what)?;
    assert_eq!(corpus.len(), FILES);
    Some(corpus)
}

fn lint(linter: &Linter, sheet: &Datasheet, name: &str) -> Vec<Finding> {
    linter.lint(sheet, FileKind::of(name), Some(name))
}

fn is_foreign(findings: &[Finding]) -> bool {
    findings.len() == 1 && findings[0].rule.name == "not-canopen"
}

/// Whether the byte order mark and the lines with their endings cover every byte once.
fn tiles(document: &Document) -> bool {
    let start = document.byte_order_mark().map_or(0, |mark| mark.end);
    let end = document
        .lines()
        .iter()
        .map(Line::full_span)
        .try_fold(start, |end, line| (line.start == end).then_some(line.end));
    end == Some(document.to_bytes().len() as u32)
}
