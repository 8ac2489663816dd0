//! How often each rule fires.

use super::report::Report;
use edskit_lint::Rule;
use serde::Serialize;
use std::collections::{BTreeMap, HashSet};
use std::io::{self, Write};

#[derive(Serialize)]
struct Row {
    code: &'static str,
    name: &'static str,
    severity: &'static str,
    findings: usize,
    files: usize,
}

/// The rules that fired, the frequent ones first.
fn rows(report: &Report) -> Vec<Row> {
    let mut counts: BTreeMap<&'static str, (&'static Rule, usize, HashSet<&str>)> = BTreeMap::new();
    for (file, finding) in report.findings() {
        let (_, findings, files) =
            counts.entry(finding.rule.code).or_insert((finding.rule, 0, HashSet::new()));
        *findings += 1;
        files.insert(&file.name);
    }
    let row = |(rule, findings, files): (&'static Rule, usize, HashSet<&str>)| Row {
        code: rule.code,
        name: rule.name,
        severity: rule.severity.name(),
        findings,
        files: files.len(),
    };
    let mut rows: Vec<Row> = counts.into_values().map(row).collect();
    rows.sort_by_key(|row| std::cmp::Reverse(row.findings));
    rows
}

pub(super) fn human(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let rows = rows(report);
    if !rows.is_empty() {
        writeln!(out, "{:>9} {:>6}  {:<7} {:<8} name", "findings", "files", "code", "severity")?;
    }
    for row in &rows {
        writeln!(
            out,
            "{:>9} {:>6}  {:<7} {:<8} {}",
            row.findings, row.files, row.code, row.severity, row.name
        )?;
    }
    writeln!(out, "{}", report.summary())
}

pub(super) fn json(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, &rows(report))?;
    writeln!(out)
}
