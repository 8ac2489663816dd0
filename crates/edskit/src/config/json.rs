//! The JSON format. Its shape is versioned by the key `version`.

use super::Report;
use super::problem::Problem;
use super::view::View;
use crate::lint::json::{JsonLocation, JsonRelated, location};
use crate::positions::Region;
use edskit_lint::{Label, Severity};
use edskit_model::Document;
use serde::Serialize;
use std::io::{self, Write};

/// Changes whenever a reader of the format would have to change.
const VERSION: u32 = 1;

#[derive(Serialize)]
struct Output<'a> {
    version: u32,
    path: &'a str,
    findings: Vec<JsonFinding<'a>>,
    /// `null` if the file could not be read whole.
    accepted: Option<bool>,
    /// Why there is no initialisation; `null` where there is one, and if the file could not be read whole.
    apart: Option<&'a str>,
    configuration: Option<&'a View>,
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
}

pub(super) fn write(report: &Report, name: &str, document: &Document, out: &mut dyn Write) -> io::Result<()> {
    let output = Output {
        version: VERSION,
        path: name,
        findings: report.problems.iter().map(|problem| finding(problem, document)).collect(),
        accepted: report.is_accepted,
        apart: report.apart.as_deref(),
        configuration: report.view.as_ref(),
    };
    serde_json::to_writer_pretty(&mut *out, &output)?;
    writeln!(out)
}

fn finding<'a>(problem: &'a Problem, document: &Document) -> JsonFinding<'a> {
    let place = |label: &Label| location(Region::of(document, label.span));
    JsonFinding {
        code: problem.kind.code,
        name: problem.kind.name,
        severity: problem.severity,
        message: &problem.message,
        help: problem.help.as_deref(),
        location: place(&problem.labels[0]),
        label: &problem.labels[0].text,
        related: problem.labels[1..]
            .iter()
            .map(|label| JsonRelated { location: place(label), label: &label.text })
            .collect(),
    }
}
