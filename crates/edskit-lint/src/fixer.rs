//! Applying fixes: in rounds, without overlap, and never for the worse.

use crate::{Applicability, Edit, FileKind, Finding, Fix, Linter, Severity};
use edskit_model::{Datasheet, Document, Encoding, LineEnding, Span};
use std::collections::HashMap;
use std::mem;

/// After so many rounds in a row that leave as much to complain about as there was, the file is left as it was before
/// them: two rules want the opposite of each other. Real files need two or three rounds in all.
const MOST_IDLE_ROUNDS: usize = 10;

/// The search for the fixes to blame may lint a file so often. Real files need a dozen times; this is for hostile ones.
const MOST_TRIALS: usize = 500;

/// A file after its fixes.
#[derive(Debug)]
pub struct Fixed {
    /// The file, read again.
    pub sheet: Datasheet,
    /// What is still found in it.
    pub findings: Vec<Finding>,
    /// How many fixes were applied.
    pub applied: usize,
    /// How many fixes were sure enough and yet left out: they would have made the file worse, or cannot be written in
    /// its encoding.
    pub refused: usize,
    /// Whether nothing is left to do; false where two rules want the opposite of each other again and again.
    pub converged: bool,
}

/// Applies the fixes of `linter` to a file, as sure as `least` or surer, until there are none left.
///
/// Each round lints, takes the fixes that do not overlap in the order of the file, and reads the result again. Where
/// there is more to complain about than before, the fixes to blame are found and refused; the others are applied.
/// Replacements are written in the encoding of the file and with its line endings.
pub fn fix(
    linter: &Linter,
    sheet: Datasheet,
    kind: FileKind,
    file_name: Option<&str>,
    least: Applicability,
) -> Fixed {
    fix_with(sheet, least, |sheet| linter.lint(sheet, kind, file_name))
}

/// The same with any way to lint, such as one that knows the neighbours of the file.
pub fn fix_with(sheet: Datasheet, least: Applicability, lint: impl Fn(&Datasheet) -> Vec<Finding>) -> Fixed {
    let findings = lint(&sheet);
    let mut state = State { sheet, findings };
    let lint = |bytes: Vec<u8>| {
        let sheet = Datasheet::new(Document::from_vec(bytes));
        let findings = lint(&sheet);
        State { sheet, findings }
    };
    let (mut refused, mut applied, mut trials) = (Vec::new(), 0, MOST_TRIALS);
    // What was there before the rounds that improved nothing, and how many these are.
    let (mut best, mut idle_rounds) = (None, 0);
    while idle_rounds < MOST_IDLE_ROUNDS {
        let chosen = choose(&state, least, &refused);
        if chosen.is_empty() {
            break;
        }
        let mut round = Round { before: &state, accepted: Vec::new(), after: None, trials, lint: &lint };
        let blamed: Vec<Fix> = round.try_all(&chosen).into_iter().cloned().collect();
        trials = round.trials;
        let accepted: Vec<Fix> = round.accepted.into_iter().cloned().collect();
        refused.extend(blamed);
        let Some(after) = round.after else { continue };
        refused = refused.into_iter().filter_map(|fix| moved(fix, &accepted, &state)).collect();
        let before = mem::replace(&mut state, after);
        if state.burden() < before.burden() {
            (best, idle_rounds) = (None, 0);
        } else {
            best.get_or_insert((before, applied));
            idle_rounds += 1;
        }
        applied += accepted.len();
    }
    if let Some((before, count)) = best.filter(|_| idle_rounds == MOST_IDLE_ROUNDS) {
        (state, applied) = (before, count);
    }
    let refused = wanted(&state, least).count();
    let converged = idle_rounds < MOST_IDLE_ROUNDS;
    Fixed { sheet: state.sheet, findings: state.findings, applied, refused, converged }
}

/// A file and what is found in it.
struct State {
    sheet: Datasheet,
    findings: Vec<Finding>,
}

impl State {
    /// How much there is to complain about; errors weigh more than any number of warnings.
    fn burden(&self) -> [usize; 3] {
        let count = |severity| {
            let findings = self.findings.iter().filter(|finding| finding.severity == severity);
            findings.map(|finding| 1 + finding.omitted).sum()
        };
        [count(Severity::Error), count(Severity::Warning), count(Severity::Info)]
    }

    /// Whether no rule finds more errors or warnings here than there.
    fn has_no_more_than(&self, other: &State) -> bool {
        let (here, there) = (self.counts(), other.counts());
        here.iter().all(|(rule, count)| there.get(rule).is_some_and(|others| count <= others))
    }

    /// The number of errors and warnings of each rule and severity.
    fn counts(&self) -> HashMap<(&'static str, Severity), usize> {
        let mut counts = HashMap::new();
        for finding in self.findings.iter().filter(|finding| finding.severity > Severity::Info) {
            *counts.entry((finding.rule.code, finding.severity)).or_default() += 1 + finding.omitted;
        }
        counts
    }
}

/// The search for the fixes of one round that make the file no worse.
struct Round<'a, L> {
    before: &'a State,
    /// In the order of the file.
    accepted: Vec<&'a Fix>,
    /// The file with these, once there is one.
    after: Option<State>,
    /// How often the search may still lint.
    trials: usize,
    lint: &'a L,
}

impl<'a, L: Fn(Vec<u8>) -> State> Round<'a, L> {
    /// Accepts all of these if they do no harm besides those that are accepted, else halves them until the fixes to
    /// blame are found, which it returns. Where there is no time left for this, it blames them all.
    fn try_all(&mut self, fixes: &[&'a Fix]) -> Vec<&'a Fix> {
        let together: Vec<&Fix> = self.accepted.iter().chain(fixes).copied().collect();
        let after = (self.lint)(apply(&self.before.sheet, &together));
        let before = self.after.as_ref().unwrap_or(self.before);
        // What one fix mends must not hide what another one breaks.
        let is_harmless = match fixes {
            [_] => after.burden() <= before.burden(),
            _ => after.has_no_more_than(before),
        };
        if is_harmless {
            self.accepted = together;
            self.after = Some(after);
            return Vec::new();
        }
        if fixes.len() == 1 || self.trials < 2 {
            return fixes.to_vec();
        }
        self.trials -= 2;
        let (left, right) = fixes.split_at(fixes.len() / 2);
        let mut blamed = self.try_all(left);
        blamed.extend(self.try_all(right));
        blamed
    }
}

/// The fixes that are sure enough.
fn wanted(state: &State, least: Applicability) -> impl Iterator<Item = &Fix> {
    let fixes = state.findings.iter().filter_map(|finding| finding.fix.as_ref());
    fixes.filter(move |fix| fix.applicability >= least && !fix.edits.is_empty())
}

/// The fixes of one round in the order of the file: those that overlap none before them and can be applied.
fn choose<'a>(state: &'a State, least: Applicability, refused: &[Fix]) -> Vec<&'a Fix> {
    let length = state.sheet.document().to_bytes().len();
    let encoding = state.sheet.document().encoding();
    let mut fixes: Vec<&Fix> = wanted(state, least)
        .filter(|fix| is_applicable(fix, length, encoding) && !refused.contains(fix))
        .collect();
    fixes.sort_by_key(|fix| extent(fix));
    let mut last: Option<Span> = None;
    fixes.retain(|fix| {
        let extent = extent(fix);
        // Not even touching: of two that insert at one place, nobody knows which text comes first.
        let is_free = last.is_none_or(|last| last.end < extent.start);
        if is_free {
            last = Some(extent);
        }
        is_free
    });
    fixes
}

/// Whether the edits lie in the file in order and apart, and can be written in its encoding.
fn is_applicable(fix: &Fix, length: usize, encoding: Encoding) -> bool {
    let spans = || fix.edits.iter().map(|edit| edit.span);
    let is_in_order = spans().is_sorted_by(|a, b| a.end <= b.start);
    let is_inside = spans().all(|span| span.start <= span.end && span.end as usize <= length);
    is_in_order && is_inside && fix.edits.iter().all(|edit| encoding.can_encode(&edit.replacement))
}

/// From the first edit to the end of the last.
fn extent(fix: &Fix) -> Span {
    let (first, last) = (&fix.edits[0], &fix.edits[fix.edits.len() - 1]);
    Span::new(first.span.start, last.span.end)
}

/// A refused fix where it stands after others were applied; `None` where one of them touched its place, so that it may
/// be tried again.
fn moved(mut fix: Fix, applied: &[Fix], before: &State) -> Option<Fix> {
    for edit in &mut fix.edits {
        let mut shift = 0;
        for other in applied.iter().flat_map(|fix| &fix.edits) {
            if other.span.start > edit.span.end {
                break;
            }
            if other.span.end >= edit.span.start {
                return None;
            }
            shift += written(other, &before.sheet).len() as i64 - other.span.len() as i64;
        }
        let place = |offset: u32| u32::try_from(i64::from(offset) + shift).ok();
        edit.span = Span::new(place(edit.span.start)?, place(edit.span.end)?);
    }
    Some(fix)
}

fn apply(sheet: &Datasheet, fixes: &[&Fix]) -> Vec<u8> {
    let source = sheet.document().to_bytes();
    let mut result = Vec::with_capacity(source.len());
    let mut done = 0;
    for edit in fixes.iter().flat_map(|fix| &fix.edits) {
        result.extend_from_slice(&source[done..edit.span.start as usize]);
        result.extend_from_slice(&written(edit, sheet));
        done = edit.span.end as usize;
    }
    result.extend_from_slice(&source[done..]);
    result
}

/// The replacement in the encoding and with the line endings of the file.
fn written(edit: &Edit, sheet: &Datasheet) -> Vec<u8> {
    let document = sheet.document();
    match document.line_ending() {
        LineEnding::Lf | LineEnding::None => document.encoding().encode(&edit.replacement),
        ending => document.encoding().encode(&with_endings(&edit.replacement, ending)),
    }
}

fn with_endings(text: &str, ending: LineEnding) -> String {
    text.replace("\r\n", "\n").replace('\n', ending.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{MOST_FINDINGS, Report, RuleSet, find};
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
        assert_eq!((fixed.applied, fixed.refused, fixed.converged), (0, MOST_FINDINGS, true));
        assert!(lints.get() <= MOST_TRIALS + 3, "{}", lints.get());
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
                let edits =
                    vec![Edit::replace(Span::new(0, 1), "-"), Edit::delete(Span::new(last, last + 1))];
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
}
