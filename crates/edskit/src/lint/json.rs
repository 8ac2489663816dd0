//! The JSON format. Its shape is versioned by the key `version`.

use super::format::Format;
use super::report::{FileReport, Outcome, Summary};
use crate::positions::{Located, Region};
use edskit_lint::{Applicability, FileKind, Severity};
use serde::Serialize;
use std::io::{self, Write};

/// Changes whenever a reader of the format would have to change.
const VERSION: u32 = 1;

#[derive(Serialize)]
struct JsonSummary {
    files: usize,
    errors: usize,
    warnings: usize,
    infos: usize,
    /// Findings that the baseline knows, which are not among the others.
    known: usize,
    fixed: usize,
    /// Fixes that were left out, because they would have made a file worse.
    fixes_left_out: usize,
}

#[derive(Serialize)]
struct JsonFile<'a> {
    path: &'a str,
    kind: &'static str,
    findings: Vec<JsonFinding<'a>>,
}

#[derive(Serialize)]
struct JsonFinding<'a> {
    code: &'static str,
    name: &'static str,
    severity: Severity,
    message: &'a str,
    help: Option<&'a str>,
    location: JsonLocation,
    label: &'a str,
    related: Vec<JsonRelated<'a>>,
    fix: Option<JsonFix<'a>>,
}

/// A further place of a finding.
#[derive(Serialize)]
pub(crate) struct JsonRelated<'a> {
    pub(crate) location: JsonLocation,
    pub(crate) label: &'a str,
}

/// Lines and columns count from 1, columns in characters; offsets count bytes from 0.
#[derive(Serialize)]
pub(crate) struct JsonLocation {
    line: u32,
    column: u32,
    end_line: u32,
    end_column: u32,
    offset: u32,
    end_offset: u32,
}

#[derive(Serialize)]
struct JsonFix<'a> {
    title: &'a str,
    applicability: Applicability,
    edits: Vec<JsonEdit<'a>>,
}

#[derive(Serialize)]
struct JsonEdit<'a> {
    location: JsonLocation,
    replacement: &'a str,
}

#[derive(Default)]
pub(super) struct Json {
    /// Whether a file was written, so that the next one needs a comma.
    has_file: bool,
}

impl Format for Json {
    fn begin(&mut self, out: &mut dyn Write) -> io::Result<()> {
        write!(out, "{{\n  \"version\": {VERSION},\n  \"files\": [")
    }

    fn file(&mut self, report: &FileReport, out: &mut dyn Write) -> io::Result<()> {
        let Some(file) = file(report) else { return Ok(()) };
        let separator = if std::mem::replace(&mut self.has_file, true) { "," } else { "" };
        write!(out, "{separator}\n    {}", indented(&file, "\n    ")?)
    }

    fn end(&mut self, summary: &Summary, out: &mut dyn Write) -> io::Result<()> {
        let counts = JsonSummary {
            files: summary.files,
            errors: summary.errors,
            warnings: summary.warnings,
            infos: summary.infos,
            known: summary.known,
            fixed: summary.fixed,
            fixes_left_out: summary.refused,
        };
        let close = if self.has_file { "\n  ]" } else { "]" };
        writeln!(
            out,
            "{close},\n  \"failures\": {},\n  \"summary\": {}\n}}",
            indented(&summary.failures, "\n  ")?,
            indented(&counts, "\n  ")?
        )
    }
}

/// JSON whose lines begin with `line_break`. A line break in a text is escaped and stays.
fn indented(value: &impl Serialize, line_break: &str) -> io::Result<String> {
    Ok(serde_json::to_string_pretty(value)?.replace('\n', line_break))
}

fn file(file: &FileReport) -> Option<JsonFile<'_>> {
    let Outcome::Linted { findings, .. } = &file.outcome else { return None };
    let kind = match file.kind {
        FileKind::Eds => "eds",
        FileKind::Dcf => "dcf",
        FileKind::Cpj => "cpj",
    };
    Some(JsonFile { path: &file.name, kind, findings: findings.iter().map(finding).collect() })
}

fn finding(finding: &Located) -> JsonFinding<'_> {
    let related = finding.places[1..]
        .iter()
        .map(|place| JsonRelated { location: location(place.region), label: &place.text });
    let fix = finding.fix.as_ref().map(|fix| JsonFix {
        title: &fix.title,
        applicability: fix.applicability,
        edits: fix
            .edits
            .iter()
            .map(|(region, replacement)| JsonEdit { location: location(*region), replacement })
            .collect(),
    });
    JsonFinding {
        code: finding.rule.code,
        name: finding.rule.name,
        severity: finding.severity,
        message: &finding.message,
        help: finding.help.as_deref(),
        location: location(finding.region()),
        label: &finding.places[0].text,
        related: related.collect(),
        fix,
    }
}

pub(crate) fn location(region: Region) -> JsonLocation {
    JsonLocation {
        line: region.start.line,
        column: region.start.column,
        end_line: region.end.line,
        end_column: region.end.column,
        offset: region.span.start,
        end_offset: region.span.end,
    }
}
