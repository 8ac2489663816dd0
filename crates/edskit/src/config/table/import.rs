//! `edskit config import`: a parameter file from tables.

use super::reading::{Line, lines, only_owner};
use super::{KEPT, TABLES, write};
use crate::cli::ConfigImportArguments;
use crate::config::key::{self, Place};
use crate::config::other_file::instead_of_table;
use crate::config::problem::{self, Problem};
use crate::config::reading::{DEVICE, span};
use crate::config::typed::{number, row::Row};
use crate::config::{name_of, print_problems, value};
use crate::{Exit, Streams, files, printable};
use edskit_devices::gateway::{Owner, Parameter};
use edskit_lint::Severity;
use edskit_model::{Document, Span};
use std::io::{self, Write as _};

pub(in crate::config) fn run(arguments: &ConfigImportArguments, streams: &mut Streams) -> io::Result<Exit> {
    let mut made = Made::default();
    let mut exit = Exit::Clean;
    for file in &arguments.files {
        let document = Document::from_vec(files::read(file, streams)?);
        // The places of problems are those of the text in UTF-8.
        let text = document.encoding().decode(document.to_bytes()).into_owned();
        let problems = made.take(&name_of(file), &text, arguments.unit.map(Owner::from));
        let is_bad = problems.iter().any(|problem| problem.severity >= Severity::Warning);
        exit = if is_bad { Exit::Findings } else { exit };
        print_problems(file, &Document::from_vec(text.into_bytes()), problems, streams)?;
    }
    if made.settings.is_empty() {
        streams.complain(format_args!("there is no parameter in it, so that no file is written"));
        return Ok(Exit::Findings);
    }
    write(&made.text(), arguments.output.as_deref(), streams)?;
    writeln!(streams.stderr, "{}", made.summary())?;
    Ok(exit)
}

/// What has been read.
#[derive(Default)]
struct Made {
    /// The names of the files.
    files: Vec<String>,
    settings: Vec<(Parameter, String)>,
    /// The lines of each unit, in the order of the tables: entries, and rows that are kept as remarks.
    lines: [Vec<String>; 2],
    /// How many rows are kept.
    kept: usize,
}

/// One table while it is read.
struct Table<'t> {
    text: &'t str,
    /// The unit that the rows are of, where something says so.
    unit: Option<Owner>,
    /// The unit of most rows that only one unit has.
    usual: Owner,
    problems: Vec<Problem>,
}

impl Made {
    /// Reads one table; what is wrong with it.
    fn take(&mut self, name: &str, text: &str, unit: Option<Owner>) -> Vec<Problem> {
        if let Some(problem) = instead_of_table(text) {
            return vec![problem];
        }
        self.files.push(printable::line(name));
        let lines = lines(text);
        let owners = lines.iter().filter_map(|(_, line)| match line {
            Line::Row(row) => only_owner(row),
            _ => None,
        });
        let (of_gateway, of_governor): (Vec<Owner>, Vec<Owner>) =
            owners.partition(|owner| *owner == Owner::Gateway);
        let usual = if of_governor.len() > of_gateway.len() { Owner::Governor } else { Owner::Gateway };
        let mut table = Table { text, unit, usual, problems: Vec::new() };
        for (content, line) in lines {
            match line {
                Line::Unit(owner) if unit.is_none() => table.unit = Some(owner),
                Line::Unit(_) | Line::Other => {}
                Line::Remark => {
                    let owner = table.unit.unwrap_or(usual);
                    self.lines[owner as usize].push(printable::line(content));
                }
                Line::Row(row) => self.take_row(&mut table, content, &row),
            }
        }
        table.problems
    }

    fn take_row(&mut self, table: &mut Table<'_>, content: &str, row: &Row<'_>) {
        let owner = self.owner_of(table, row);
        match entry(table, owner, row) {
            Ok((parameter, line)) if self.has(parameter) => {
                let message = format!("{parameter} has a row already");
                let problem = Problem::at(problem::DUPLICATE_KEY, table.span(row.value, content), message);
                table.problems.push(problem.help("it is kept as a remark; keep one of the two"));
                self.keep(owner, content);
                drop(line);
            }
            Ok((parameter, line)) => {
                self.settings.push((parameter, line.clone()));
                self.lines[owner as usize].push(line);
            }
            Err(problem) => {
                table.problems.extend(problem);
                self.keep(owner, content);
            }
        }
    }

    /// The unit of a row: the one that the table names, or that alone has its parameter, or that of most other rows. What
    /// that has already is taken for the other one.
    fn owner_of(&self, table: &mut Table<'_>, row: &Row<'_>) -> Owner {
        if let Some(owner) = table.unit.or_else(|| only_owner(row)) {
            return owner;
        }
        let other = if table.usual == Owner::Gateway { Owner::Governor } else { Owner::Gateway };
        let find = |owner| key::parameter(owner, &row.key(), Span::at(0), Place::File).ok();
        match (find(table.usual), find(other)) {
            (Some(own), Some(others)) if self.has(own) && !self.has(others) => {
                let message = format!(
                    "{others} stands here for the second time, and is taken for that of the other unit"
                );
                let span = table.span(if row.number.is_empty() { row.name } else { row.number }, "");
                let problem = Problem::at(problem::DUPLICATE_KEY, span, message).severity(Severity::Info);
                table.problems.push(
                    problem.help("a line `[gateway]` or `[governor]` before its rows says whose they are"),
                );
                other
            }
            _ => table.usual,
        }
    }

    fn has(&self, parameter: Parameter) -> bool {
        self.settings.iter().any(|(own, _)| own.main() == parameter.main())
    }

    /// Keeps a row as a remark.
    fn keep(&mut self, owner: Owner, content: &str) {
        self.kept += 1;
        self.lines[owner as usize].push(format!("{KEPT}{}", printable::line(&content.replace('\t', ";"))));
    }

    fn text(&self) -> String {
        let mut text = format!("device = \"{DEVICE}\"\n\n# From {}.", self.files.join(" and "));
        if self.kept > 0 {
            text.push_str(" Behind `#:` stand rows that say nothing about the gateway.");
        }
        text.push('\n');
        for ((_, table), lines) in TABLES.iter().zip(&self.lines).filter(|(_, lines)| !lines.is_empty()) {
            text.push_str(&format!("\n{table}\n{}\n", lines.join("\n")));
        }
        text
    }

    fn summary(&self) -> String {
        let count = |owner| self.settings.iter().filter(|(parameter, _)| parameter.owner() == owner).count();
        let (of_gateway, of_governor) = (count(Owner::Gateway), count(Owner::Governor));
        let rows = if self.kept == 1 {
            "1 row is kept as a remark".to_owned()
        } else {
            format!("{} rows are kept as remarks", self.kept)
        };
        format!("{of_gateway} parameters of the gateway, {of_governor} of the governor; {rows}")
    }
}

impl Table<'_> {
    /// The place of a part of the text, or of another one where it is empty.
    fn span(&self, part: &str, or: &str) -> Span {
        let part = if part.is_empty() { or } else { part };
        let start = (part.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize).min(self.text.len());
        span(start..(start + part.len()).min(self.text.len()))
    }
}

/// The parameter of a row and its entry in the file; what is wrong with it where there is none, nothing for rows of what is
/// not known or cannot be set.
fn entry(table: &mut Table<'_>, owner: Owner, row: &Row<'_>) -> Result<(Parameter, String), Option<Problem>> {
    let key_span = table.span(if row.name.is_empty() { row.number } else { row.name }, row.number);
    let parameter = key::parameter(owner, &row.key(), key_span, Place::File).map_err(|problem| {
        let is_unknown = [problem::UNKNOWN_PARAMETER, problem::MEASURED_VALUE]
            .map(|kind| kind.code)
            .contains(&problem.kind.code);
        (!is_unknown).then_some(problem)
    })?;
    let at = table.span(row.value, if row.number.is_empty() { row.name } else { row.number });
    let typed = number::read(parameter, &row.amount());
    let Some(meaning) = typed.meanings.first() else {
        return Err(Some(match typed.beyond {
            Some(_) => value::out_of_range(parameter, typed.beyond, at),
            None => {
                let message = format!("`{}` is no value of {parameter}", row.amount());
                Problem::at(problem::UNREADABLE_ROW, at, message).help(value::allowed(parameter))
            }
        }));
    };
    // In a table of the PC tool a comma divides decimals.
    if typed.meanings.len() > 1 && !row.value.contains(',') {
        let message = format!("`{}` is read as {}", row.value, parameter.amount(meaning.value));
        let problem = Problem::at(problem::UNREADABLE_ROW, at, message).severity(Severity::Info);
        table.problems.push(problem.help("its point is taken to divide decimals, and not thousands"));
    }
    let number = parameter.number();
    let key = match parameter.name() {
        Some(name) => format!("\"{number} {name}\""),
        None => number.to_string(),
    };
    Ok((parameter, format!("{key} = {}", meaning.toml(parameter))))
}
