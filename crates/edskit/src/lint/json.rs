//! The JSON format. Its shape is versioned by the key `version`.

use super::report::{FileReport, Outcome, Report};
use crate::positions::{Located, Region};
use edskit_lint::{Applicability, FileKind, Severity};
use serde::Serialize;
use std::io::{self, Write};

/// Changes whenever a reader of the format would have to change.
const VERSION: u32 = 1;

#[derive(Serialize)]
struct Output<'a> {
    version: u32,
    files: Vec<JsonFile<'a>>,
    failures: Vec<&'a str>,
    summary: JsonSummary,
}

#[derive(Serialize)]
struct JsonSummary {
    files: usize,
    errors: usize,
    warnings: usize,
    infos: usize,
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

pub(super) fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let summary = report.summary();
    let output = Output {
        version: VERSION,
        files: report.files.iter().filter_map(file).collect(),
        failures: report.all_failures().collect(),
        summary: JsonSummary {
            files: summary.files,
            errors: summary.errors,
            warnings: summary.warnings,
            infos: summary.infos,
        },
    };
    serde_json::to_writer_pretty(&mut *out, &output)?;
    writeln!(out)
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
