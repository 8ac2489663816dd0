//! The report on real files: how often each rule fires on the corpus, with one finding of each judged by hand.

use crate::CorpusFile;
use edskit_lint::{FileKind, Finding, Linter, Rule, RuleSet, Severity};
use edskit_model::Datasheet;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::fmt::Write;

/// The text before the numbers.
const INTRODUCTION: &str = "\
# Field report

What edskit finds in real files, and whether it is right. The files are EDS and DCF files of many vendors, tools and
hobbyists from public repositories; they are not part of this project. Every rule ran over all of them. Of each rule that
fires, one finding was looked up and judged by hand. Of the errors, up to three of every rule in every file were looked
at; what was arguable among them became a warning.

A finding that is right on the file and yet a matter of
taste, of the device, or of how one reads CiA 306 is no error: an error says that two statements of the file contradict each
other, that CiA 306 or CiA 301 forbids it, or that tools in use refuse or misread it.

`cargo xtask field-report` writes this page from the corpus and from the judgements in `field-report.toml`. A test says when
a number is stale, when a rule that fires is not judged, and when a judged finding is gone.
";

/// A finding that was looked up and judged.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Judged {
    /// The rule's code.
    pub rule: String,
    /// The file of the corpus.
    pub file: String,
    /// The line of the finding, from 1.
    pub line: u32,
    /// What is wrong there, and what a tool or a device makes of it.
    pub judgement: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Judgements {
    judged: Vec<Judged>,
}

/// A finding, and where it is.
struct Found<'a> {
    file: &'a str,
    line: u32,
    finding: Finding,
}

/// The findings of one severity or rule.
#[derive(Default)]
struct Tally<'a> {
    findings: usize,
    files: BTreeSet<&'a str>,
}

/// The report on `corpus` in Markdown.
///
/// # Errors
/// What does not hold any more: a rule that fires is not judged, or there is no such finding as one that is.
pub fn field_report(corpus: &[CorpusFile], judgements: &str) -> Result<String, String> {
    let judgements: Judgements = toml::from_str(judgements).map_err(|error| error.to_string())?;
    let all = RuleSet::all();
    let found = lint(corpus, &Linter::new(all.clone()));
    let by_default = lint(corpus, &Linter::new(RuleSet::default()));
    let mut page = INTRODUCTION.to_owned();
    summary(&mut page, corpus, &by_default);
    let mut problems = String::new();
    let mut silent = Vec::new();
    page.push_str("\n## Rules that fire\n");
    for rule in all.enabled() {
        let of_rule: Vec<&Found<'_>> = found.iter().filter(|found| found.finding.rule == rule).collect();
        let judged: Vec<&Judged> =
            judgements.judged.iter().filter(|judged| judged.rule == rule.code).collect();
        match (&of_rule[..], &judged[..]) {
            ([], []) => silent.push(rule),
            ([], _) => line(&mut problems, format!("{}: judged, but fires nowhere", rule.code)),
            ([first, ..], []) => {
                let Found { file, line: number, .. } = first;
                line(&mut problems, format!("{}: not judged, as at {file}:{number}", rule.code));
            }
            (_, [judged]) => {
                if of_rule.iter().any(|found| (found.file, found.line) == (&judged.file, judged.line)) {
                    chapter(&mut page, rule, &of_rule, judged);
                } else {
                    let Judged { rule, file, line: number, .. } = judged;
                    line(&mut problems, format!("{rule}: no finding at {file}:{number}"));
                }
            }
            _ => line(&mut problems, format!("{}: judged twice", rule.code)),
        }
    }
    page.push_str("\n## Rules that fire nowhere\n\nNo file of the corpus has what these look for. The project's own tests show that they work.\n");
    page.push('\n');
    for rule in silent {
        line(&mut page, format!("- {} {}", rule.code, rule.name));
    }
    let known = |judged: &&Judged| all.enabled().any(|rule| rule.code == judged.rule);
    for judged in judgements.judged.iter().filter(|judged| !known(judged)) {
        line(&mut problems, format!("{}: no such rule", judged.rule));
    }
    if problems.is_empty() { Ok(page) } else { Err(problems) }
}

fn lint<'a>(corpus: &'a [CorpusFile], linter: &Linter) -> Vec<Found<'a>> {
    let mut all = Vec::new();
    for file in corpus {
        let sheet = Datasheet::parse(&file.bytes);
        for finding in linter.lint(&sheet, FileKind::of(&file.name), Some(&file.name)) {
            let line = sheet.document().position(finding.span().start).line;
            all.push(Found { file: &file.name, line, finding });
        }
    }
    all
}

fn summary(page: &mut String, corpus: &[CorpusFile], found: &[Found<'_>]) {
    let [errors, warnings, infos] = [Severity::Error, Severity::Warning, Severity::Info]
        .map(|severity| tally(found.iter().filter(|found| found.finding.severity == severity)));
    let without = |tallies: &[&Tally<'_>]| {
        let is_free =
            |file: &&CorpusFile| tallies.iter().all(|tally| !tally.files.contains(file.name.as_str()));
        corpus.iter().filter(is_free).count()
    };
    let rows = [
        format!(
            "edskit {} on {} files, with the rules that are on by default:",
            env!("CARGO_PKG_VERSION"),
            corpus.len()
        ),
        String::new(),
        "| Severity | Findings | Files with one |".to_owned(),
        "| --- | ---: | ---: |".to_owned(),
        row("error", &errors),
        row("warning", &warnings),
        row("info", &infos),
        String::new(),
        format!(
            "{} files have no error, {} neither error nor warning, {} no finding at all.",
            without(&[&errors]),
            without(&[&errors, &warnings]),
            without(&[&errors, &warnings, &infos])
        ),
    ];
    page.push('\n');
    for row in rows {
        line(page, row);
    }
}

fn chapter(page: &mut String, rule: &Rule, found: &[&Found<'_>], judged: &Judged) {
    let Rule { code, name, .. } = rule;
    let parts: Vec<String> = [Severity::Error, Severity::Warning, Severity::Info]
        .into_iter()
        .map(|severity| {
            (severity, tally(found.iter().copied().filter(|found| found.finding.severity == severity)))
        })
        .filter(|(_, tally)| tally.findings > 0)
        .map(|(severity, tally)| {
            let (findings, files) = (tally.findings, tally.files.len());
            let findings = match severity {
                Severity::Info => format!("{findings} info"),
                _ => counted(findings, severity.name()),
            };
            format!("{findings} in {}", counted(files, "file"))
        })
        .collect();
    let off = if rule.enabled { "" } else { " Off by default." };
    line(page, format!("\n### {code} {name}\n\n{}.{off}", parts.join(", ")));
    line(page, format!("\n`{}`, line {}:\n{}", judged.file, judged.line, judged.judgement.trim()));
}

fn tally<'a>(found: impl Iterator<Item = &'a Found<'a>>) -> Tally<'a> {
    let mut tally = Tally::default();
    for found in found {
        tally.findings += 1 + found.finding.omitted;
        tally.files.insert(found.file);
    }
    tally
}

fn row(severity: &str, tally: &Tally<'_>) -> String {
    format!("| {severity} | {} | {} |", tally.findings, tally.files.len())
}

fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

fn line(text: &mut String, line: String) {
    writeln!(text, "{line}").expect("a string takes any text");
}
