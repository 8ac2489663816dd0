use super::edits::with_endings;
use super::*;
use crate::{Edit, MOST_FINDINGS, Report, RuleSet, find};
use edskit_model::{LineEnding, Span};
use std::cell::Cell;

fn run(text: &[u8], rules: &[&str], least: Applicability) -> (String, usize, bool) {
    let mut set = RuleSet::none();
    for rule in rules {
        set.select(rule).unwrap();
    }
    let fixed = fix(&Linter::new(set), Datasheet::parse(text), FileKind::Eds, None, least);
    let text = fixed.sheet.document().encoding().decode(fixed.sheet.document().to_bytes()).into_owned();
    (text, fixed.applied, fixed.converged)
}

#[test]
fn unsafe_fixes_need_permission() {
    let text = b"[2000sub0]\nDataType=0x0007\n[2001sub0]\nDataType=0x0006\n";
    assert_eq!(run(text, &["OBJ013"], Applicability::Safe).1, 0);
    let (fixed, applied, converged) = run(text, &["OBJ013"], Applicability::Unsafe);
    assert_eq!(fixed, "[2000sub0]\nDataType=0x0005\n[2001sub0]\nDataType=0x0005\n");
    assert_eq!((applied, converged), (2, true));
}

#[test]
fn replacements_take_the_endings_of_the_file() {
    assert_eq!(with_endings("a\nb\r\n", LineEnding::CrLf), "a\r\nb\r\n");
}

#[test]
fn other_bytes_stay() {
    let text = b"[2000sub0]\nParameterName=M\xFCller\nDataType=0x0007\n";
    assert_eq!(
        run(text, &["OBJ013"], Applicability::Unsafe).0,
        "[2000sub0]\nParameterName=Müller\nDataType=0x0005\n"
    );
}

/// Lints a text word by word: a word with a fix is one that `fix` gives a replacement for.
fn words(fix: impl Fn(&str) -> Option<&'static str>) -> impl Fn(&Datasheet) -> Vec<Finding> {
    move |sheet| {
        let text = String::from_utf8_lossy(sheet.document().to_bytes()).into_owned();
        let mut report = Report::new(find("duplicate-section").unwrap()[0]);
        let mut worse = Report::new(find("duplicate-key").unwrap()[0]);
        for word in text.split_whitespace().filter(|word| !word.starts_with('.')) {
            let start = (word.as_ptr() as usize - text.as_ptr() as usize) as u32;
            let span = Span::new(start, start + word.len() as u32);
            if word == "worse" {
                worse.add(span, word);
                continue;
            }
            let finding = report.add(span, word);
            if let Some(replacement) = fix(word) {
                finding.safe_fix("Replace", vec![Edit::replace(span, replacement)]);
            }
        }
        [report.into_findings(), worse.into_findings()].concat()
    }
}

fn run_words(text: &str, fix: impl Fn(&str) -> Option<&'static str>) -> (String, usize, usize) {
    let fixed = fix_with(Datasheet::parse(text.as_bytes()), Applicability::Safe, words(fix));
    let text = String::from_utf8_lossy(fixed.sheet.document().to_bytes()).into_owned();
    (text, fixed.applied, fixed.refused)
}

#[test]
fn one_bad_fix_blocks_no_other() {
    let fix = |word: &str| match word {
        "bad" => Some("bad worse"),
        "good" => Some("."),
        _ => None,
    };
    let text = "good bad good good bad good bad";
    assert_eq!(run_words(text, fix), (". bad . . bad . bad".to_owned(), 4, 3));
    assert_eq!(run_words("bad bad", fix), ("bad bad".to_owned(), 0, 2));
}

#[test]
fn what_becomes_fixable_is_fixed_later() {
    let fix = |word: &str| match word {
        "one" => Some("two"),
        "two" => Some("."),
        _ => None,
    };
    assert_eq!(run_words("one two one", fix), (". . .".to_owned(), 5, 0));
}

#[test]
fn rules_that_want_the_opposite_change_nothing() {
    let fix = |word: &str| match word {
        "tick" => Some("tock"),
        "tock" => Some("tick"),
        "good" => Some("."),
        _ => None,
    };
    assert_eq!(run_words("good tick", fix), (". tock".to_owned(), 2, 1));
}

#[test]
fn the_search_for_bad_fixes_ends() {
    let lints = Cell::new(0);
    let fix = |word: &str| (word == "bad").then_some("bad worse");
    let lint = words(fix);
    let text = "bad ".repeat(MOST_FINDINGS);
    let fixed = fix_with(Datasheet::parse(text.as_bytes()), Applicability::Safe, |sheet| {
        lints.set(lints.get() + 1);
        lint(sheet)
    });
    assert_eq!((fixed.applied, fixed.refused, fixed.converged), (0, MOST_FINDINGS, false));
    assert!(lints.get() <= MOST_TRIALS + 3, "{}", lints.get());
    assert!(fixed.findings.iter().all(|finding| finding.fix.is_none()), "a refused fix is still offered");
}

/// Lints a text by its sections: each `bad` entry has a fix after which its section holds something worse, and each
/// `good` entry one that does no harm.
fn sections(sheet: &Datasheet) -> Vec<Finding> {
    let mut report = Report::new(find("duplicate-section").unwrap()[0]);
    let mut worse = Report::new(find("duplicate-key").unwrap()[0]);
    for entry in sheet.entries() {
        let (key, value) = (entry.key_text(), entry.raw());
        match &*key {
            "bad" if value == b"0" => {
                let edits = vec![Edit::replace(entry.value_span(), "1")];
                report.add(entry.span(), key).safe_fix("Write 1", edits);
            }
            "bad" => {
                worse.add(entry.span(), "worse");
                worse.add(entry.span(), "worse");
            }
            "good" if value == b"0" => {
                let edits = vec![Edit::replace(entry.value_span(), "1")];
                report.add(entry.span(), key).safe_fix("Write 1", edits);
            }
            _ => {}
        }
    }
    [report.into_findings(), worse.into_findings()].concat()
}

#[test]
fn many_bad_fixes_in_many_sections_are_found_in_few_trials() {
    let mut text = String::new();
    for number in 0..300 {
        let bad = if number % 3 == 0 { "bad=0\n" } else { "" };
        text += &format!("[{:X}]\ngood=0\ngood=0\n{bad}good=0\ngood=0\n", 0x2000 + number);
    }
    let lints = Cell::new(0);
    let lint = |sheet: &Datasheet| {
        lints.set(lints.get() + 1);
        sections(sheet)
    };
    let fixed = fix_with(Datasheet::parse(text.as_bytes()), Applicability::Safe, lint);
    assert_eq!((fixed.applied, fixed.refused, fixed.converged), (1_200, 100, true));
    assert!(lints.get() < MOST_TRIALS, "{}", lints.get());
    let again = fix_with(fixed.sheet, Applicability::Safe, sections);
    assert_eq!((again.applied, again.refused), (0, 100), "a second run changes something");
}

#[test]
fn an_unsafe_fix_after_which_another_rule_complains_is_none() {
    let lint = |least: fn(&mut Finding, Edit)| {
        move |sheet: &Datasheet| {
            let mut report = Report::new(find("duplicate-section").unwrap()[0]);
            let mut other = Report::new(find("duplicate-key").unwrap()[0]);
            if sheet.document().to_bytes() == b"a" {
                least(report.add(Span::at(0), "a"), Edit::replace(Span::new(0, 1), "b"));
            } else {
                other.add(Span::at(0), "b");
            }
            [report.into_findings(), other.into_findings()].concat()
        }
    };
    let safe = lint(|finding, edit| {
        finding.safe_fix("Write b", vec![edit]);
    });
    let guessed = lint(|finding, edit| {
        finding.unsafe_fix("Write b", vec![edit]);
    });
    assert_eq!(fix_with(Datasheet::parse(b"a"), Applicability::Unsafe, safe).applied, 1);
    let fixed = fix_with(Datasheet::parse(b"a"), Applicability::Unsafe, guessed);
    assert_eq!((fixed.applied, fixed.refused, fixed.findings[0].fix.is_none()), (0, 1, true));
}

#[test]
fn what_was_refused_is_tried_again_when_the_rest_is_done() {
    // The first fix does harm until the second one, which follows from a third, is made.
    let lint = |sheet: &Datasheet| {
        let source = String::from_utf8_lossy(sheet.document().to_bytes()).into_owned();
        let mut report = Report::new(find("duplicate-section").unwrap()[0]);
        let mut worse = Report::new(find("duplicate-key").unwrap()[0]);
        let replace = |at: u32, text: &str| vec![Edit::replace(Span::new(at, at + 1), text)];
        if source.starts_with('a') {
            report.add(Span::at(0), "a").safe_fix("Write b", replace(0, "b"));
        } else if !source.ends_with('3') {
            worse.add(Span::at(0), "b before 3");
            worse.add(Span::at(0), "b before 3");
        }
        for (old, new) in [('1', "2"), ('2', "3")] {
            if source.ends_with(old) {
                report.add(Span::at(4), "number").safe_fix("Count", replace(4, new));
            }
        }
        [report.into_findings(), worse.into_findings()].concat()
    };
    let fixed = fix_with(Datasheet::parse(b"a   1"), Applicability::Safe, lint);
    assert_eq!((fixed.sheet.document().to_bytes(), fixed.refused), (&b"b   3"[..], 0));
}

#[test]
fn more_fixes_than_findings_are_kept() {
    let count = 25 * MOST_FINDINGS + 7;
    let fix = |word: &str| (word == "good").then_some(".");
    let (text, applied, refused) = run_words(&"good ".repeat(count), fix);
    assert_eq!((text, applied, refused), (". ".repeat(count), count, 0));
}

#[test]
fn a_fix_around_another_waits_and_a_broken_one_is_left_out() {
    let lint = |sheet: &Datasheet| {
        let source = sheet.document().to_bytes();
        let mut report = Report::new(find("duplicate-section").unwrap()[0]);
        if source.starts_with(b"a") && source.ends_with(b"a") {
            let last = source.len() as u32 - 1;
            let edits = vec![Edit::replace(Span::new(0, 1), "-"), Edit::delete(Span::new(last, last + 1))];
            report.add(Span::at(0), "around").safe_fix("Replace", edits);
        }
        if let Some(place) = source.iter().position(|&byte| byte == b'b') {
            let span = Span::new(place as u32, place as u32 + 1);
            report.add(span, "within").safe_fix("Replace", vec![Edit::replace(span, "+")]);
            let crossed = vec![Edit::delete(span), Edit::insert(0, "x")];
            report.add(span, "not in order").safe_fix("Replace", crossed);
            report.add(span, "outside").safe_fix("Replace", vec![Edit::insert(99, "x")]);
        }
        report.into_findings()
    };
    let fixed = fix_with(Datasheet::parse(b"a b a"), Applicability::Safe, lint);
    assert_eq!(fixed.sheet.document().to_bytes(), b"- + ");
    assert_eq!((fixed.applied, fixed.converged), (2, true));
}

#[test]
fn of_two_insertions_at_one_place_one_waits() {
    let lint = |sheet: &Datasheet| {
        let source = sheet.document().to_bytes();
        let mut report = Report::new(find("duplicate-section").unwrap()[0]);
        for letter in ["x", "y"] {
            if !source.contains(&letter.as_bytes()[0]) {
                report.add(Span::at(0), letter).safe_fix("Insert", vec![Edit::insert(0, letter)]);
            }
        }
        report.into_findings()
    };
    let fixed = fix_with(Datasheet::parse(b"a"), Applicability::Safe, lint);
    assert_eq!((fixed.sheet.document().to_bytes(), fixed.applied), (&b"yxa"[..], 2));
}

#[test]
fn text_that_the_encoding_cannot_write_is_left_out() {
    let fix = |name: &'static str| {
        move |sheet: &Datasheet| {
            let mut report = Report::new(find("duplicate-section").unwrap()[0]);
            if sheet.document().to_bytes().starts_with(b"a") {
                let edits = vec![Edit::replace(Span::new(0, 1), name)];
                report.add(Span::at(0), "name").safe_fix("Replace", edits);
            }
            report.into_findings()
        }
    };
    let run = |text: &[u8], name: &'static str| {
        let fixed = fix_with(Datasheet::parse(text), Applicability::Safe, fix(name));
        (fixed.sheet.document().to_bytes().to_vec(), fixed.refused)
    };
    assert_eq!(run(b"a \xFC", "\u{3B2}"), (b"a \xFC".to_vec(), 1));
    assert_eq!(run(b"a \xFC", "\u{E4}"), (b"\xE4 \xFC".to_vec(), 0));
    assert_eq!(run(b"a b", "\u{E4}"), (b"a b".to_vec(), 1));
    assert_eq!(run("a \u{FC}".as_bytes(), "\u{3B2}"), ("\u{3B2} \u{FC}".as_bytes().to_vec(), 0));
}

#[test]
fn a_fix_that_would_be_left_out_is_not_offered() {
    let mut text = String::new();
    for number in 0..40 {
        let bad = if number % 8 == 0 { "bad=0\n" } else { "" };
        text += &format!("[{:X}]\ngood=0\n{bad}good=0\n", 0x2000 + number);
    }
    let sheet = Datasheet::parse(text.as_bytes());
    let mut findings = sections(&sheet);
    let fixed = fix_with(sheet.clone(), Applicability::Safe, sections);
    assert_eq!(withdraw_refused(&sheet, &mut findings, sections), fixed.refused);
    assert_eq!(fixed.refused, 5);
    assert!(findings.iter().all(|finding| finding.fix.is_some() == (finding.message == "good")));
    let nothing = |_: &Datasheet| -> Vec<Finding> { panic!("nobody has to look again") };
    let mut without: Vec<Finding> = findings.into_iter().filter(|finding| finding.fix.is_none()).collect();
    assert_eq!(withdraw_refused(&sheet, &mut without, nothing), 0);
}

#[test]
fn a_look_at_fixes_ends_sooner() {
    let lints = Cell::new(0);
    let fix = |word: &str| (word == "bad").then_some("bad worse");
    let lint = words(fix);
    let sheet = Datasheet::parse("bad ".repeat(MOST_FINDINGS).as_bytes());
    let mut findings = lint(&sheet);
    let refused = withdraw_refused(&sheet, &mut findings, |sheet| {
        lints.set(lints.get() + 1);
        lint(sheet)
    });
    assert!(lints.get() <= MOST_TRIALS_OF_A_LOOK + 3, "{}", lints.get());
    assert!(refused == MOST_FINDINGS && findings.iter().all(|finding| finding.fix.is_none()));
}
