//! `edskit config`: parameter files of devices.

mod advice;
mod collisions;
mod human;
mod json;
mod key;
mod problem;
mod reading;
mod signals;
mod syntax;
mod value;
mod view;

use crate::cli::{ConfigArguments, ConfigCheckArguments, ConfigCommand, ConfigFormat};
use crate::lint::human::{Style, excerpts};
use crate::{Exit, Streams, files};
use edskit_devices::gateway::PdoTable;
use edskit_model::Document;
use problem::Problem;
use reading::Reading;
use std::io::{self, Write};
use view::View;

pub(crate) fn run(arguments: &ConfigArguments, streams: &mut Streams) -> io::Result<Exit> {
    match &arguments.command {
        ConfigCommand::Check(arguments) => check(arguments, streams),
    }
}

/// What there is to say on a file.
struct Report {
    /// In the order of their places.
    problems: Vec<Problem>,
    /// Whether the initialisation of the gateway succeeds; `None` if the file could not be read whole.
    is_accepted: Option<bool>,
    /// `None` likewise.
    view: Option<View>,
}

impl Report {
    fn of(bytes: &[u8]) -> Self {
        let mut reading = Reading::of(bytes);
        let (is_accepted, view) = match reading.is_complete() {
            true => {
                let table = PdoTable::new(&reading.configuration, &reading.signals);
                let refused = collisions::refused(&reading, &table);
                let is_accepted = refused.is_empty();
                let judged =
                    [refused, collisions::restricted(&reading, &table), advice::of(&reading, &table)];
                reading.problems.extend(judged.into_iter().flatten());
                (Some(is_accepted), Some(View::new(&reading, &table)))
            }
            // A value that is missing because it could not be read would make others look wrong.
            false => (None, None),
        };
        let mut problems: Vec<Problem> = reading.problems.into_iter().map(Problem::printable).collect();
        problems.sort_by_key(|problem| problem.span().start);
        Self { problems, is_accepted, view }
    }
}

fn check(arguments: &ConfigCheckArguments, streams: &mut Streams) -> io::Result<Exit> {
    let document = Document::from_vec(files::read(&arguments.file, streams)?);
    let name = files::Input::File(arguments.file.clone()).name("");
    let name = if name == "-" { "stdin" } else { &name };
    let report = Report::of(document.to_bytes());
    match arguments.format {
        ConfigFormat::Human => {
            let style = Style { color: arguments.color.is_wanted(streams.is_terminal), width: streams.width };
            let excerpts = excerpts(name, &document, &report.problems, style);
            human::write(&report, &excerpts, arguments.quiet, &mut streams.stdout)?;
        }
        ConfigFormat::Json => json::write(&report, name, &document, &mut streams.stdout)?,
    }
    streams.stdout.flush()?;
    let threshold = arguments.fail_on.severity();
    let failed = report.problems.iter().any(|problem| problem.severity >= threshold);
    Ok(if failed { Exit::Findings } else { Exit::Clean })
}
