//! Lints the mutants of a kind and judges what comes back.

use edskit_lint::{FileKind, Finding, Linter, Neighbours, RuleSet, Severity};
use edskit_model::Datasheet;
use edskit_tests::seeded::{Base, Defect, Mutant};
use std::collections::BTreeSet;
use std::rc::Rc;

/// What became of one kind of defect.
pub(crate) struct Run {
    /// The rule that has to report it.
    pub(crate) rule: &'static str,
    /// How many mutants there were.
    pub(crate) mutants: usize,
    /// How many of them the rule reported at the right line.
    pub(crate) caught: usize,
    /// What is not as it must be, one text for each mutant.
    pub(crate) failures: Vec<String>,
}

/// Lints every mutant of a kind.
pub(crate) fn run(defect: &Defect, bases: &[Base]) -> Run {
    let mut rules = RuleSet::default();
    rules.select(defect.rule).expect("defects name rules that exist");
    let linter = Linter::new(rules);
    let mut followed = BTreeSet::new();
    let mut run = Run { rule: defect.rule, mutants: 0, caught: 0, failures: Vec::new() };
    for base in bases {
        for mutant in defect.mutants(base) {
            run.mutants += 1;
            let report = Report::of(&linter, &base.name, &mutant);
            let found = report.is_caught(defect, &mutant);
            followed.extend(report.findings.iter().map(|finding| finding.rule.code));
            run.caught += usize::from(found);
            let unrelated = report.unrelated_errors(defect);
            if !found || !unrelated.is_empty() {
                run.failures.push(format!(
                    "{} {}: {} lines {:?}: {}{}",
                    defect.rule,
                    defect.kind,
                    base.name,
                    mutant.expected(),
                    if found {
                        "caught".to_owned()
                    } else {
                        format!("MISSED, found were {:?}", report.places())
                    },
                    if unrelated.is_empty() { String::new() } else { format!("; unrelated {unrelated:?}") },
                ));
            }
        }
    }
    for (rule, _) in defect.consequences.iter().filter(|(rule, _)| !followed.contains(rule)) {
        run.failures.push(format!("{} {}: {rule} never follows", defect.rule, defect.kind));
    }
    run
}

/// What all rules find in a base.
pub(crate) fn findings_of_base(base: &Base) -> Vec<String> {
    Report::of(&Linter::new(RuleSet::all()), &base.name, &Mutant::of(base)).places()
}

struct Report {
    findings: Vec<Finding>,
    sheet: Datasheet,
}

impl Report {
    fn of(linter: &Linter, name: &str, mutant: &Mutant) -> Self {
        let sheet = Datasheet::parse(&mutant.bytes());
        let kind = FileKind::of(name);
        let findings = match mutant.neighbours() {
            [] => linter.lint(&sheet, kind, Some(name)),
            files => linter.lint_among(&sheet, kind, Some(name), &Folder(files)),
        };
        Self { findings, sheet }
    }

    /// Whether the rule points at an expected line.
    fn is_caught(&self, defect: &Defect, mutant: &Mutant) -> bool {
        let expected = mutant.expected();
        let places = |finding: &Finding| match defect.by_label {
            true => finding.labels.len(),
            false => 1,
        };
        let own = self.findings.iter().filter(|finding| finding.rule.code == defect.rule);
        own.into_iter().any(|finding| {
            let mut labels = finding.labels[..places(finding)].iter();
            labels.any(|label| expected.contains(&self.line(label.span.start)))
        })
    }

    /// Errors of other rules that are no consequence of the defect.
    fn unrelated_errors(&self, defect: &Defect) -> Vec<String> {
        let is_related = |finding: &Finding| {
            let code = finding.rule.code;
            code == defect.rule || defect.consequences.iter().any(|(rule, _)| *rule == code)
        };
        let errors = self.findings.iter().filter(|finding| finding.severity == Severity::Error);
        errors.filter(|finding| !is_related(finding)).map(|finding| self.place(finding)).collect()
    }

    fn places(&self) -> Vec<String> {
        self.findings.iter().map(|finding| self.place(finding)).collect()
    }

    fn place(&self, finding: &Finding) -> String {
        format!("{}:{} {}", finding.rule.code, self.line(finding.span().start), finding.message)
    }

    fn line(&self, offset: u32) -> usize {
        self.sheet.document().position(offset).line as usize
    }
}

/// The files beside the one that is linted.
struct Folder<'a>(&'a [(String, String)]);

impl Neighbours for Folder<'_> {
    fn exists(&self, relative: &str) -> Option<bool> {
        Some(self.0.iter().any(|(name, _)| *name == file_name(relative)))
    }

    fn sheet(&self, relative: &str) -> Option<Rc<Datasheet>> {
        let (_, text) = self.0.iter().find(|(name, _)| *name == file_name(relative))?;
        Some(Rc::new(Datasheet::parse(text.as_bytes())))
    }
}

/// The node list says that its files are in the folder `.`.
fn file_name(relative: &str) -> &str {
    relative.trim_start_matches("./")
}
