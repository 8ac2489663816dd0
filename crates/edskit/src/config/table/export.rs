//! `edskit config export`: a table from a parameter file.

use super::{KEPT, TABLES, write};
use crate::cli::ConfigExportArguments;
use crate::config::reading::Reading;
use crate::config::{in_order, print_problems};
use crate::{Exit, Streams, files};
use edskit_devices::gateway::{Owner, Parameter, Quantity};
use edskit_model::Document;
use std::io;

/// What stands over the columns.
const HEAD: &str = "Number;Name;Value;Unit";

pub(in crate::config) fn run(arguments: &ConfigExportArguments, streams: &mut Streams) -> io::Result<Exit> {
    let document = Document::from_vec(files::read(&arguments.file, streams)?);
    let reading = Reading::of(document.to_bytes());
    let is_complete = reading.is_complete();
    let text = String::from_utf8_lossy(document.to_bytes()).into_owned();
    let table = table(&reading, &text, arguments.unit.map(Owner::from));
    let has_signals = !reading.signals.declared.is_empty();
    print_problems(&arguments.file, &document, in_order(reading.problems), streams)?;
    if !is_complete {
        return Ok(Exit::Findings);
    }
    if has_signals {
        streams.complain(format_args!("what `[governor.signals]` describes is no parameter, and has no row"));
    }
    write(&table, arguments.output.as_deref(), streams)?;
    Ok(Exit::Clean)
}

/// The rows of one unit, or of both below their titles.
fn table(reading: &Reading, text: &str, unit: Option<Owner>) -> String {
    let mut table = format!("{HEAD}\n");
    for (owner, title) in TABLES.into_iter().filter(|(owner, _)| unit.is_none_or(|unit| unit == *owner)) {
        let own = reading.settings().iter().filter(|setting| setting.parameter.owner() == owner);
        let mut rows: Vec<String> = own.map(|setting| row(setting.parameter, setting.value)).collect();
        rows.extend(kept(text, title));
        if rows.is_empty() {
            continue;
        }
        if unit.is_none() {
            table.push_str(&format!("{title};;;\n"));
        }
        rows.iter().for_each(|row| table.push_str(&format!("{row}\n")));
    }
    table
}

/// A row as the PC tool shows it: a decimal comma, identifiers in hexadecimal digits.
fn row(parameter: Parameter, value: i32) -> String {
    let name = parameter.name().map(|name| name.to_string()).unwrap_or_default();
    let amount = parameter.amount(value).to_string();
    let (value, unit) = match parameter.quantity() {
        Quantity::Identifier => (format!("{value:X}"), "Hex"),
        _ => {
            let (value, unit) = amount.split_once(' ').unwrap_or((&amount, ""));
            (value.replace('.', ","), unit)
        }
    };
    format!("{};{name};{value};{unit}", parameter.number())
}

/// The rows that an import has kept below the title of a table.
fn kept(text: &str, title: &str) -> Vec<String> {
    let mut is_own = false;
    let mut rows = Vec::new();
    for line in text.lines().map(str::trim) {
        if line.starts_with('[') {
            is_own = line == title;
        } else if let Some(row) = line.strip_prefix(KEPT).filter(|_| is_own) {
            rows.push(row.to_owned());
        }
    }
    rows
}
