//! The engine: it walks a file once and calls each rule at the level it asked for.

use crate::conflicts::Conflicts;
use crate::context::{Context, Report, Variable};
use crate::inline_comment;
use crate::rule::{EntryCheck, FileCheck, LineCheck, ObjectCheck, SectionCheck, VariableCheck};
use crate::rules::syntax::line_without_equals::{self, LINE_WITHOUT_EQUALS};
use crate::rules::syntax::not_canopen::{self, NOT_CANOPEN};
use crate::suppression;
use crate::{Check, FileKind, Finding, Neighbours, Profile, RuleSet};
use edskit_model::Datasheet;
use std::sync::Arc;

/// Runs a set of rules over files.
///
/// ```
/// use edskit_lint::{FileKind, Linter, RuleSet};
/// use edskit_model::Datasheet;
/// let sheet = Datasheet::parse(b"[1000]\nParameterName=a\n[1000]\nParameterName=b\n");
/// let linter = Linter::new(RuleSet::default());
/// let findings = linter.lint(&sheet, FileKind::Eds, None);
/// assert!(findings.iter().any(|finding| finding.rule.name == "duplicate-section"));
/// ```
pub struct Linter {
    rules: RuleSet,
    profiles: Arc<[Profile]>,
}

/// The checks of one run by level, so that the walk makes no decision per rule.
#[derive(Default)]
struct Checks {
    file: Vec<Active<FileCheck>>,
    line: Vec<Active<LineCheck>>,
    section: Vec<Active<SectionCheck>>,
    entry: Vec<Active<EntryCheck>>,
    object: Vec<Active<ObjectCheck>>,
    variable: Vec<Active<VariableCheck>>,
}

/// A check and the rule it belongs to.
struct Active<F> {
    check: F,
    rule: &'static crate::Rule,
    /// Position among the rules of the run.
    slot: usize,
}

impl Linter {
    /// A linter with these rules.
    pub fn new(rules: RuleSet) -> Self {
        Self { rules, profiles: Arc::default() }
    }

    /// The same linter, which holds devices to these profiles besides those of CiA.
    pub fn with_profiles(mut self, profiles: impl Into<Arc<[Profile]>>) -> Self {
        self.profiles = profiles.into();
        self
    }

    /// The rules.
    pub fn rules(&self) -> &RuleSet {
        &self.rules
    }

    /// Every finding of the rules, in the order of the file; of one rule at most [`MOST_FINDINGS`](crate::MOST_FINDINGS), the last of which
    /// then tells how many were left out.
    ///
    /// `file_name` is the file's own name without folders. A file that is no CANopen file at all gets the one
    /// finding that says what it is.
    pub fn lint(&self, sheet: &Datasheet, kind: FileKind, file_name: Option<&str>) -> Vec<Finding> {
        self.lint_context(&Context::new(sheet, kind, file_name).with_profiles(&self.profiles))
    }

    /// The same for a file whose neighbours are known, so that checks across files run too.
    pub fn lint_among(
        &self,
        sheet: &Datasheet,
        kind: FileKind,
        file_name: Option<&str>,
        neighbours: &dyn Neighbours,
    ) -> Vec<Finding> {
        let mut context = Context::new(sheet, kind, file_name).with_profiles(&self.profiles);
        context.neighbours = Some(neighbours);
        self.lint_context(&context)
    }

    fn lint_context(&self, context: &Context<'_>) -> Vec<Finding> {
        let conflicts = Conflicts::of(context.document());
        if conflicts.is_empty() {
            return self.lint_text(context, Vec::new());
        }
        let mut report = Report::new(&LINE_WITHOUT_EQUALS);
        if self.rules.is_enabled(&LINE_WITHOUT_EQUALS) {
            line_without_equals::report_conflicts(context.document(), &conflicts, &mut report);
        }
        let left = report.into_findings();
        let [ours, theirs] = conflicts.sides(context.document()).map(|sheet| {
            let mut side = Context::new(&sheet, context.kind, context.file_name);
            side = side.with_profiles(&self.profiles);
            side.neighbours = context.neighbours;
            self.lint_text(&side, left.clone())
        });
        conflicts.common(context.document(), ours, &theirs)
    }

    /// What is found in a file without conflicts, and what is `found` already.
    fn lint_text(&self, context: &Context<'_>, found: Vec<Finding>) -> Vec<Finding> {
        let mut report = Report::new(&NOT_CANOPEN);
        if not_canopen::is_foreign(context) {
            if self.rules.is_enabled(&NOT_CANOPEN) {
                not_canopen::check(context, &mut report);
            }
        } else {
            walk(context, &self.checks(context.kind), &mut report);
        }
        let mut findings = report.into_findings();
        line_without_equals::take_over_lost_headers(context, &mut findings);
        inline_comment::protect(context, &mut findings);
        for label in findings.iter_mut().flat_map(|finding| &mut finding.labels) {
            // Rules count bytes; people and editors want to see characters.
            label.span = context.document().whole_characters(label.span);
        }
        findings.extend(found);
        suppression::apply(context, &self.rules, &mut findings);
        self.rules.apply_severities(&mut findings);
        findings.sort_by_key(Finding::place);
        findings
    }

    fn checks(&self, kind: FileKind) -> Checks {
        let mut checks = Checks::default();
        for (slot, rule) in self.rules.enabled().filter(|rule| rule.files.contains(&kind)).enumerate() {
            match rule.check {
                Check::File(check) => checks.file.push(Active { check, rule, slot }),
                Check::Line(check) => checks.line.push(Active { check, rule, slot }),
                Check::Section(check) => checks.section.push(Active { check, rule, slot }),
                Check::Entry(check) => checks.entry.push(Active { check, rule, slot }),
                Check::Object(check) => checks.object.push(Active { check, rule, slot }),
                Check::Variable(check) => checks.variable.push(Active { check, rule, slot }),
            }
        }
        checks
    }
}

/// Calls every check of one level.
macro_rules! run {
    ($checks:expr, $context:expr, $report:expr $(, $argument:expr)?) => {
        for active in &$checks {
            $report.enter(active.rule, active.slot);
            (active.check)($context $(, $argument)?, $report);
        }
    };
}

fn walk(context: &Context<'_>, checks: &Checks, report: &mut Report) {
    run!(checks.file, context, report);
    if !checks.line.is_empty() {
        for line in context.document().lines() {
            run!(checks.line, context, report, line);
        }
    }
    if !checks.section.is_empty() {
        for section in context.sheet.sections() {
            run!(checks.section, context, report, section);
        }
    }
    if !checks.entry.is_empty() {
        for entry in context.sheet.entries() {
            run!(checks.entry, context, report, entry);
        }
    }
    if !checks.object.is_empty() {
        for object in context.sheet.objects() {
            run!(checks.object, context, report, object);
        }
    }
    if !checks.variable.is_empty() {
        let mut prescriptions = Vec::new();
        for object in context.sheet.objects() {
            context.profiles.find(object.index(), &mut prescriptions);
            let variable = Variable::new(object.index(), None, object.description(), &prescriptions);
            run!(checks.variable, context, report, &variable);
        }
        let mut index = None;
        for sub in context.sheet.sub_objects() {
            if index != Some(sub.index()) {
                context.profiles.find(sub.index(), &mut prescriptions);
                index = Some(sub.index());
            }
            let variable =
                Variable::new(sub.index(), Some(sub.sub_index()), sub.description(), &prescriptions);
            run!(checks.variable, context, report, &variable);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{MOST_FINDINGS, find};

    #[test]
    fn a_place_is_made_of_whole_characters() {
        let text = "[1000]\nDataType=1\u{20AC}\n";
        let linter = Linter::new(RuleSet::only(&find("invalid-number").unwrap()));
        let findings = linter.lint(&Datasheet::parse(text.as_bytes()), FileKind::Eds, None);
        assert_eq!(findings[0].span().slice(text.as_bytes()), "\u{20AC}".as_bytes());
    }

    #[test]
    fn a_value_that_swallowed_a_header_is_one_defect() {
        let codes = |text: &str| {
            let mut rules = RuleSet::none();
            for rule in ["SYN008", "OBJ002", "OBJ005", "OBJ022", "DEV003", "LST001"] {
                rules.select(rule).unwrap();
            }
            let findings = Linter::new(rules).lint(&Datasheet::parse(text.as_bytes()), FileKind::Eds, None);
            findings.iter().map(|finding| finding.rule.code).collect::<Vec<_>>()
        };
        for entry in ["ObjectType=7", "AccessType=ro", "PDOMapping=0"] {
            assert_eq!(codes(&format!("[1000]\n{entry}[1001]\nParameterName=a\n")), ["LST001", "SYN008"]);
        }
        assert_eq!(codes("[DeviceInfo]\nLSS_Supported=0[1000]\nParameterName=a\n"), ["LST001", "SYN008"]);
        assert_eq!(codes("50[DeviceInfo]\nVendorName=a\n"), ["LST001", "SYN008"]);
    }

    #[test]
    fn of_one_rule_only_so_many_findings_are_kept_and_the_last_says_so() {
        let sheet = Datasheet::parse("[1000]\n".repeat(MOST_FINDINGS + 8).as_bytes());
        let linter = Linter::new(RuleSet::only(&find("duplicate-section").unwrap()));
        let findings = linter.lint(&sheet, FileKind::Eds, None);
        assert_eq!(findings.len(), MOST_FINDINGS);
        let last = &findings[MOST_FINDINGS - 1].message;
        assert!(last.ends_with("a second time; 7 more findings of this rule are left out"), "{last}");
        assert!(findings[..MOST_FINDINGS - 1].iter().all(|finding| !finding.message.contains("left out")));
    }
}
