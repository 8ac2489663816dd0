//! Applying fixes: in rounds, without overlap, and never for the worse.

use crate::{Applicability, Edit, FileKind, Finding, Fix, Linter, Severity};
use edskit_model::{Datasheet, Document, Encoding, LineEnding, Span};
use std::collections::{HashMap, HashSet};
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
    /// What is still found in it. What was refused is not offered as a fix any more.
    pub findings: Vec<Finding>,
    /// How many fixes were applied.
    pub applied: usize,
    /// How many fixes were sure enough and yet left out: they would have made the file worse, or cannot be written in
    /// its encoding.
    pub refused: usize,
    /// Whether nothing is left to do. It is false where the search was given up: two rules want the opposite of each
    /// other again and again, or more fixes had to be tried than a file gets trials.
    pub converged: bool,
}

/// Applies the fixes of `linter` to a file, as sure as `least` or surer, until there are none left.
///
/// Each round lints, takes the fixes that do not overlap in the order of the file, and reads the result again. Where
/// there is more to complain about than before, the fixes to blame are found and refused; the others are applied.
/// What was refused is tried once more when the rest is done, which may have made room for it.
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
    // How many fixes were applied when the refused ones were tried again.
    let mut tried_again = None;
    while idle_rounds < MOST_IDLE_ROUNDS {
        let mut chosen = choose(&state, least, &refused);
        let is_again = chosen.is_empty();
        if is_again {
            chosen = choose(&state, least, &[]);
            if chosen.is_empty() || trials == 0 || tried_again == Some(applied) {
                break;
            }
            tried_again = Some(applied);
            refused.clear();
        }
        let mut round = Round { before: &state, accepted: Vec::new(), after: None, trials, lint: &lint };
        let blamed = if is_again { round.try_each(&chosen) } else { round.try_all(&chosen) };
        let blamed: Vec<Fix> = blamed.into_iter().cloned().collect();
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
    let converged = idle_rounds < MOST_IDLE_ROUNDS && trials > 0;
    for finding in &mut state.findings {
        // What did harm when it was tried is no fix.
        finding.fix = finding.fix.take().filter(|fix| !is_wanted(fix, least));
    }
    Fixed { sheet: state.sheet, findings: state.findings, applied, refused, converged }
}

/// A file and what is found in it.
struct State {
    sheet: Datasheet,
    findings: Vec<Finding>,
}

/// The number of errors and warnings of each rule and severity.
type Counts = HashMap<(&'static str, Severity), usize>;

/// The sections that something is about, by their names in lower case; the empty name for what is in none.
type Places = HashSet<Vec<u8>>;

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
        has_no_more(&self.counts(), &other.counts())
    }

    fn counts(&self) -> Counts {
        let mut counts = Counts::new();
        for finding in self.complaints() {
            *counts.entry((finding.rule.code, finding.severity)).or_default() += 1 + finding.omitted;
        }
        counts
    }

    /// The same for each section that a finding points at.
    fn counts_by_place(&self) -> HashMap<Vec<u8>, Counts> {
        let mut counts: HashMap<Vec<u8>, Counts> = HashMap::new();
        for finding in self.complaints() {
            for place in places(&self.sheet, finding.labels.iter().map(|label| label.span)) {
                let counts = counts.entry(place).or_default();
                *counts.entry((finding.rule.code, finding.severity)).or_default() += 1 + finding.omitted;
            }
        }
        counts
    }

    /// Errors and warnings; what is only worth knowing keeps no fix back.
    fn complaints(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|finding| finding.severity > Severity::Info)
    }
}

fn has_no_more(here: &Counts, there: &Counts) -> bool {
    here.iter().all(|(rule, count)| there.get(rule).is_some_and(|others| count <= others))
}

/// The sections in which these spans lie.
fn places(sheet: &Datasheet, spans: impl Iterator<Item = Span>) -> Places {
    let name = |span: Span| {
        let section = sheet.section_at(span.start);
        section.map(|section| {
            // A section is the same however its name is spelt.
            let canonical = section.kind().canonical_name().map(String::into_bytes);
            let own = || section.name_span().slice(sheet.document().to_bytes()).to_vec();
            canonical.unwrap_or_else(own).to_ascii_lowercase()
        })
    };
    spans.map(|span| name(span).unwrap_or_default()).collect()
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
    /// Accepts all of these if they do no harm besides those that are accepted, else looks for the fixes to blame, which
    /// it returns. Where there is no time left for this, it blames them all.
    fn try_all(&mut self, fixes: &[&'a Fix]) -> Vec<&'a Fix> {
        if fixes.is_empty() {
            return Vec::new();
        }
        let Some((together, after)) = self.with(fixes) else { return fixes.to_vec() };
        let before = self.after.as_ref().unwrap_or(self.before);
        let is_harmless = match fixes {
            [fix] => is_harmless(fix, before, &after),
            // What one fix mends must not hide what another one breaks.
            _ => after.has_no_more_than(before),
        };
        if is_harmless {
            self.accepted = together;
            self.after = Some(after);
            return Vec::new();
        }
        if fixes.len() == 1 {
            return fixes.to_vec();
        }
        let mut blamed = Vec::new();
        for part in self.divide(fixes, &worse_places(before, &after)) {
            blamed.extend(self.try_all(&part));
        }
        blamed
    }

    /// Two parts of fixes that do harm together: those in sections that got worse apart from the others, or where that
    /// says nothing, half of the fixes of every section. So many sections are searched at once.
    fn divide(&self, fixes: &[&'a Fix], worse: &Places) -> [Vec<&'a Fix>; 2] {
        let own_places = |fix: &&Fix| places(&self.before.sheet, fix.edits.iter().map(|edit| edit.span));
        let is_innocent = |fix: &&Fix| own_places(fix).is_disjoint(worse);
        let (innocent, suspect): (Vec<&Fix>, Vec<&Fix>) = fixes.iter().copied().partition(is_innocent);
        if !innocent.is_empty() && !suspect.is_empty() {
            return [innocent, suspect];
        }
        let place = |fix: &Fix| self.before.sheet.section_at(extent(fix).start).map(|section| section.id());
        let mut sizes: HashMap<Option<u32>, usize> = HashMap::new();
        for fix in fixes {
            *sizes.entry(place(fix)).or_default() += 1;
        }
        if sizes.len() == fixes.len() {
            let (left, right) = fixes.split_at(fixes.len() / 2);
            return [left.to_vec(), right.to_vec()];
        }
        let mut taken: HashMap<Option<u32>, usize> = HashMap::new();
        let (first, second) = fixes.iter().copied().partition(|fix| {
            let place = place(fix);
            let taken = taken.entry(place).or_default();
            *taken += 1;
            *taken <= sizes[&place].div_ceil(2)
        });
        [first, second]
    }

    /// Tries one after the other, and returns those that do harm.
    fn try_each(&mut self, fixes: &[&'a Fix]) -> Vec<&'a Fix> {
        fixes.iter().flat_map(|fix| self.try_all(&[fix])).collect()
    }

    /// The file with these fixes besides those that are accepted; `None` where there is no time left for that.
    fn with(&mut self, fixes: &[&'a Fix]) -> Option<(Vec<&'a Fix>, State)> {
        self.trials = self.trials.checked_sub(1)?;
        let mut together: Vec<&Fix> = self.accepted.iter().chain(fixes).copied().collect();
        together.sort_by_key(|fix| extent(fix));
        let after = (self.lint)(apply(&self.before.sheet, &together));
        Some((together, after))
    }
}

/// Whether one fix leaves no more to complain about.
///
/// A safe fix may bring to light what its own mistake hid, since the file means the same before and after. An unsafe one
/// after which another rule complains has guessed wrong.
fn is_harmless(fix: &Fix, before: &State, after: &State) -> bool {
    let is_lighter = after.burden() <= before.burden();
    is_lighter && (fix.applicability == Applicability::Safe || after.has_no_more_than(before))
}

/// The sections in which a rule finds more errors or warnings than before.
fn worse_places(before: &State, after: &State) -> Places {
    let (there, here) = (before.counts_by_place(), after.counts_by_place());
    let none = Counts::new();
    let worse =
        here.into_iter().filter(|(place, counts)| !has_no_more(counts, there.get(place).unwrap_or(&none)));
    worse.map(|(place, _)| place).collect()
}

/// The fixes that are sure enough.
fn wanted(state: &State, least: Applicability) -> impl Iterator<Item = &Fix> {
    let fixes = state.findings.iter().filter_map(|finding| finding.fix.as_ref());
    fixes.filter(move |fix| is_wanted(fix, least))
}

fn is_wanted(fix: &Fix, least: Applicability) -> bool {
    fix.applicability >= least && !fix.edits.is_empty()
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
