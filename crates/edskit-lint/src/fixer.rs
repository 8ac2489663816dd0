//! Applying fixes: in rounds, without overlap, and never for the worse.

use crate::{Applicability, FileKind, Finding, Fix, Linter, Severity};
use edskit_model::{Datasheet, Document, LineEnding};

/// After this many rounds a file is left as it is; real files need two or three.
const MOST_ROUNDS: usize = 20;

/// A file after its fixes.
#[derive(Debug)]
pub struct Fixed {
    /// The file, read again.
    pub sheet: Datasheet,
    /// What is still found in it.
    pub findings: Vec<Finding>,
    /// How many findings were fixed.
    pub applied: usize,
    /// Whether every fix that was allowed could be applied; false where one would have made the file worse or the
    /// rounds ran out.
    pub converged: bool,
}

/// Applies the fixes of `linter` to a file, as sure as `least` or surer, until there are none left.
///
/// Each round lints, takes the fixes that do not overlap in the order of the file, and reads the result again. A round
/// after which there is more to complain about is tried again fix by fix, and a fix that makes the file worse is left out.
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
    let mut state = Fixed { sheet, findings, applied: 0, converged: true };
    let lint = |bytes: Vec<u8>| {
        let sheet = Datasheet::new(Document::from_vec(bytes));
        let findings = lint(&sheet);
        (sheet, findings)
    };
    for _ in 0..MOST_ROUNDS {
        let chosen = choose(&state.findings, least);
        if chosen.is_empty() {
            return state;
        }
        let (sheet, findings) = lint(apply(&state.sheet, &chosen));
        if burden(&findings) <= burden(&state.findings) {
            state.applied += chosen.len();
            (state.sheet, state.findings) = (sheet, findings);
            continue;
        }
        let better = chosen.iter().find_map(|fix| {
            let (sheet, findings) = lint(apply(&state.sheet, &[fix]));
            (burden(&findings) <= burden(&state.findings)).then_some((sheet, findings))
        });
        let Some((sheet, findings)) = better else {
            state.converged = false;
            return state;
        };
        state.applied += 1;
        (state.sheet, state.findings) = (sheet, findings);
    }
    state.converged = choose(&state.findings, least).is_empty();
    state
}

/// How much there is to complain about; errors weigh more than any number of warnings.
fn burden(findings: &[Finding]) -> [usize; 3] {
    let count = |severity| findings.iter().filter(|finding| finding.severity == severity).count();
    [count(Severity::Error), count(Severity::Warning), count(Severity::Info)]
}

/// The fixes of one round in the order of the file: those that overlap none before them.
fn choose(findings: &[Finding], least: Applicability) -> Vec<&Fix> {
    let wanted = |fix: &&Fix| fix.applicability >= least && !fix.edits.is_empty();
    let mut fixes: Vec<&Fix> =
        findings.iter().filter_map(|finding| finding.fix.as_ref()).filter(wanted).collect();
    fixes.sort_by_key(|fix| fix.edits[0].span);
    let mut end = 0;
    fixes.retain(|fix| {
        // The next fix may begin where the last one ended, but not insert at the same place.
        let free = fix.edits[0].span.start > end || (end == 0 && fix.edits[0].span.start == 0);
        if free {
            end = fix.edits.iter().map(|edit| edit.span.end).max().unwrap_or(end);
        }
        free
    });
    fixes
}

fn apply(sheet: &Datasheet, fixes: &[&Fix]) -> Vec<u8> {
    let document = sheet.document();
    let source = document.to_bytes();
    let mut result = Vec::with_capacity(source.len());
    let mut done = 0;
    for edit in fixes.iter().flat_map(|fix| &fix.edits) {
        result.extend_from_slice(&source[done..edit.span.start as usize]);
        let text = match document.line_ending() {
            LineEnding::Lf | LineEnding::None => document.encoding().encode(&edit.replacement),
            ending => document.encoding().encode(&with_endings(&edit.replacement, ending)),
        };
        result.extend_from_slice(&text);
        done = edit.span.end as usize;
    }
    result.extend_from_slice(&source[done..]);
    result
}

fn with_endings(text: &str, ending: LineEnding) -> String {
    text.replace("\r\n", "\n").replace('\n', ending.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RuleSet;

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
}
