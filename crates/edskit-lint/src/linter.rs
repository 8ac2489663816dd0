//! The engine: it walks a file once and calls each rule at the level it asked for.

use crate::context::{Context, Report, Variable};
use crate::rules::syntax::not_canopen::{self, NOT_CANOPEN};
use crate::{Check, FileKind, Finding, RuleSet};
use edskit_model::{Datasheet, Entry, Line, Object, Section};

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
}

/// The checks of one run by level, so that the walk makes no decision per rule.
#[derive(Default)]
struct Checks {
    file: Vec<Active<fn(&Context<'_>, &mut Report)>>,
    line: Vec<Active<fn(&Context<'_>, &Line, &mut Report)>>,
    section: Vec<Active<fn(&Context<'_>, Section<'_>, &mut Report)>>,
    entry: Vec<Active<fn(&Context<'_>, Entry<'_>, &mut Report)>>,
    object: Vec<Active<fn(&Context<'_>, Object<'_>, &mut Report)>>,
    variable: Vec<Active<fn(&Context<'_>, &Variable<'_>, &mut Report)>>,
}

/// A check and the rule it belongs to.
struct Active<F> {
    check: F,
    rule: &'static crate::Rule,
}

impl Linter {
    /// A linter with these rules.
    pub fn new(rules: RuleSet) -> Self {
        Self { rules }
    }

    /// The rules.
    pub fn rules(&self) -> &RuleSet {
        &self.rules
    }

    /// Every finding of the rules, in the order of the file.
    ///
    /// `file_name` is the file's own name without folders. A file that is no CANopen file at all gets the one
    /// finding that says what it is.
    pub fn lint(&self, sheet: &Datasheet, kind: FileKind, file_name: Option<&str>) -> Vec<Finding> {
        let context = Context::new(sheet, kind, file_name);
        let mut report = Report { rule: &NOT_CANOPEN, severity: NOT_CANOPEN.severity, findings: Vec::new() };
        if not_canopen::is_foreign(&context) {
            if self.rules.is_enabled(&NOT_CANOPEN) {
                not_canopen::check(&context, &mut report);
            }
        } else {
            walk(&context, &self.checks(kind), &mut report);
        }
        let mut findings = report.findings;
        self.rules.apply_severities(&mut findings);
        findings.sort_by(|a, b| {
            (a.span().start, a.rule.code, a.span().end).cmp(&(b.span().start, b.rule.code, b.span().end))
        });
        findings
    }

    fn checks(&self, kind: FileKind) -> Checks {
        let mut checks = Checks::default();
        for rule in self.rules.enabled().filter(|rule| rule.files.contains(&kind)) {
            match rule.check {
                Check::File(check) => checks.file.push(Active { check, rule }),
                Check::Line(check) => checks.line.push(Active { check, rule }),
                Check::Section(check) => checks.section.push(Active { check, rule }),
                Check::Entry(check) => checks.entry.push(Active { check, rule }),
                Check::Object(check) => checks.object.push(Active { check, rule }),
                Check::Variable(check) => checks.variable.push(Active { check, rule }),
            }
        }
        checks
    }
}

/// Calls every check of one level.
macro_rules! run {
    ($checks:expr, $context:expr, $report:expr $(, $argument:expr)?) => {
        for active in &$checks {
            $report.rule = active.rule;
            $report.severity = active.rule.severity;
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
        for object in context.sheet.objects() {
            let variable = Variable::new(object.index(), None, object.description());
            run!(checks.variable, context, report, &variable);
        }
        for sub in context.sheet.sub_objects() {
            let variable = Variable::new(sub.index(), Some(sub.sub_index()), sub.description());
            run!(checks.variable, context, report, &variable);
        }
    }
}
