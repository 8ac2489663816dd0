//! How often each rule fires, by the severity that was found.

use super::format::Format;
use super::report::{FileReport, Summary};
use edskit_lint::{Rule, Severity};
use serde::Serialize;
use std::cmp::Reverse;
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

/// For each rule and severity how often it was found, and in how many files.
#[derive(Default)]
struct Counts(BTreeMap<(&'static str, Reverse<Severity>), (&'static Rule, usize, usize)>);

impl Counts {
    fn add(&mut self, file: &FileReport) {
        let mut seen = HashSet::new();
        for finding in file.findings() {
            let key = (finding.rule.code, Reverse(finding.severity));
            let (_, findings, files) = self.0.entry(key).or_insert((finding.rule, 0, 0));
            *findings += 1;
            *files += usize::from(seen.insert(key));
        }
    }

    /// The frequent ones first.
    fn rows(&self) -> Vec<Row> {
        let row = |(key, value): (&(&str, Reverse<Severity>), &(&'static Rule, usize, usize))| {
            let (&(_, Reverse(severity)), &(rule, findings, files)) = (key, value);
            Row { code: rule.code, name: rule.name, severity: severity.name(), findings, files }
        };
        let mut rows: Vec<Row> = self.0.iter().map(row).collect();
        rows.sort_by_key(|row| Reverse(row.findings));
        rows
    }
}

#[derive(Default)]
pub(super) struct Human(Counts);

impl Format for Human {
    fn file(&mut self, file: &FileReport, _: &mut dyn Write) -> io::Result<()> {
        self.0.add(file);
        Ok(())
    }

    fn end(&mut self, summary: &Summary, out: &mut dyn Write) -> io::Result<()> {
        let rows = self.0.rows();
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
        writeln!(out, "{summary}")
    }
}

#[derive(Default)]
pub(super) struct Json(Counts);

impl Format for Json {
    fn file(&mut self, file: &FileReport, _: &mut dyn Write) -> io::Result<()> {
        self.0.add(file);
        Ok(())
    }

    fn end(&mut self, _: &Summary, out: &mut dyn Write) -> io::Result<()> {
        serde_json::to_writer_pretty(&mut *out, &self.0.rows())?;
        writeln!(out)
    }
}
