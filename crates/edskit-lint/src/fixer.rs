//! Applying fixes: in rounds, without overlap, and never for the worse.

mod edits;
mod search;
mod state;

use crate::{Applicability, FileKind, Finding, Fix, Linter};
use edits::{apply, choose, is_wanted, moved, wanted};
use edskit_model::{Datasheet, Document};
use search::Round;
use state::{Places, State, places};
use std::collections::HashMap;
use std::mem;

/// After so many rounds in a row that leave as much to complain about as there was, the file is left as it was before
/// them: two rules want the opposite of each other. Real files need two or three rounds in all.
const MOST_IDLE_ROUNDS: usize = 10;

/// The search for the fixes to blame may lint a file so often. Real files need a dozen times; this is for hostile ones.
const MOST_TRIALS: usize = 500;

/// The same where nothing is written, and somebody only wants to know what would be.
const MOST_TRIALS_OF_A_LOOK: usize = 30;

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
    let Done { mut state, applied, converged } =
        apply_all(State { sheet, findings }, least, MOST_TRIALS, lint);
    let refused = wanted(&state, least).count();
    for finding in &mut state.findings {
        // What did harm when it was tried is no fix.
        finding.fix = finding.fix.take().filter(|fix| !is_wanted(fix, least));
    }
    Fixed { sheet: state.sheet, findings: state.findings, applied, refused, converged }
}

/// Takes out the safe fixes of `findings` that [`fix_with`] would leave out, and says how many these are. What it takes too
/// long to try goes too. Where no finding has a safe fix, nothing is done.
///
/// `findings` are those that `lint` has of `sheet`.
pub fn withdraw_refused(
    sheet: &Datasheet,
    findings: &mut [Finding],
    lint: impl Fn(&Datasheet) -> Vec<Finding>,
) -> usize {
    let least = Applicability::Safe;
    let is_fixable = |finding: &Finding| finding.fix.as_ref().is_some_and(|fix| is_wanted(fix, least));
    if !findings.iter().any(is_fixable) {
        return 0;
    }
    let state = State { sheet: sheet.clone(), findings: findings.to_vec() };
    // The usual case: all of them are applied at once.
    let chosen = choose(&state, least, &[]);
    if chosen.len() == wanted(&state, least).count() {
        let sheet = Datasheet::new(Document::from_vec(apply(&state.sheet, &chosen)));
        let after = State { findings: lint(&sheet), sheet };
        if after.has_no_more_than(&state) {
            return 0;
        }
    }
    let done = apply_all(state, least, MOST_TRIALS_OF_A_LOOK, lint);
    // The fixes before it have moved a finding, but not out of its section.
    let mut refused: HashMap<_, usize> = HashMap::new();
    for finding in done.state.findings.iter().filter(|finding| is_fixable(finding)) {
        *refused.entry(identity(&done.state.sheet, finding)).or_default() += 1;
    }
    let mut withdrawn = 0;
    for finding in findings.iter_mut().filter(|finding| is_fixable(finding)) {
        if let Some(left @ 1..) = refused.get_mut(&identity(sheet, finding)) {
            *left -= 1;
            finding.fix = None;
            withdrawn += 1;
        }
    }
    withdrawn
}

/// What makes a finding the same in two states of a file.
fn identity(sheet: &Datasheet, finding: &Finding) -> (&'static str, String, Vec<Vec<u8>>) {
    let section: Places = places(sheet, [finding.span()].into_iter());
    (finding.rule.code, finding.message.clone(), section.into_iter().collect())
}

/// A file after the fixes that could be applied.
struct Done {
    state: State,
    applied: usize,
    converged: bool,
}

fn apply_all(
    mut state: State,
    least: Applicability,
    mut trials: usize,
    lint: impl Fn(&Datasheet) -> Vec<Finding>,
) -> Done {
    let lint = |bytes: Vec<u8>| {
        let sheet = Datasheet::new(Document::from_vec(bytes));
        let findings = lint(&sheet);
        State { sheet, findings }
    };
    let (mut refused, mut applied) = (Vec::new(), 0);
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
    let converged = idle_rounds < MOST_IDLE_ROUNDS && trials > 0;
    Done { state, applied, converged }
}

#[cfg(test)]
mod tests;
