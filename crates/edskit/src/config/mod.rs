//! `edskit config`: parameter files of devices.

mod advice;
mod collisions;
mod dcf;
mod decimal;
mod human;
mod json;
mod key;
mod other_file;
pub(crate) mod problem;
mod reading;
mod signals;
mod syntax;
mod table;
mod typed;
mod value;
mod view;
mod words;

pub(crate) use key::{Place, unknown_in_one};
pub(crate) use other_file::instead_of_scenario;
pub(crate) use problem::Problem;
pub(crate) use reading::{entries, parameters_of, span};
pub(crate) use signals::KnownSignals;
pub(crate) use syntax::{table_of, text_of};
pub(crate) use typed::amend;
pub(crate) use value::what_is;
pub(crate) use words::{apart, content, milliseconds, why};

use crate::cli::{Color, ConfigArguments, ConfigCheckArguments, ConfigCommand, ConfigFormat};
use crate::lint::human::{Style, excerpts};
use crate::{Exit, Streams, files};
use edskit_devices::gateway::{Configuration, Parameter, PdoTable};
use edskit_model::Document;
use reading::Reading;
use std::io::{self, Write};
use std::path::Path;
use view::View;

pub(crate) fn run(arguments: &ConfigArguments, streams: &mut Streams) -> io::Result<Exit> {
    match &arguments.command {
        ConfigCommand::Check(arguments) => check(arguments, streams),
        ConfigCommand::Dcf(arguments) => dcf::run(arguments, streams),
        ConfigCommand::Import(arguments) => table::import(arguments, streams),
        ConfigCommand::Export(arguments) => table::export(arguments, streams),
    }
}

/// What there is to say on a file.
struct Report {
    /// In the order of their places.
    problems: Vec<Problem>,
    /// Whether the initialisation of the gateway succeeds; `None` if the file could not be read whole.
    is_accepted: Option<bool>,
    /// Why there is no initialisation; `None` where there is one.
    apart: Option<String>,
    /// `None` likewise.
    view: Option<View>,
    /// `None` likewise.
    parameters: Option<Parameters>,
}

/// What a parameter file gives to a device.
#[derive(Debug, Default)]
pub(crate) struct Parameters {
    pub(crate) configuration: Configuration,
    pub(crate) signals: KnownSignals,
}

impl Report {
    fn of(bytes: &[u8]) -> Self {
        let mut reading = Reading::of(bytes);
        let is_complete = reading.is_complete();
        let (is_accepted, apart, view) = match is_complete {
            true => {
                let table = PdoTable::new(&reading.configuration, &reading.signals);
                let refused = collisions::refused(&reading, &table);
                let apart = words::apart(&reading.configuration);
                let is_accepted = refused.is_empty() && apart.is_none();
                let restricted = collisions::restricted(&reading, &table);
                let told: Vec<Parameter> = refused
                    .iter()
                    .chain(&restricted)
                    .flat_map(|problem| problem.decimals.iter().copied())
                    .collect();
                let judged = [refused, restricted, advice::of(&reading, &table, &told)];
                reading.problems.extend(judged.into_iter().flatten());
                (Some(is_accepted), apart, Some(View::new(&reading, &table)))
            }
            // A value that is missing because it could not be read would make others look wrong.
            false => (None, None, None),
        };
        let Reading { configuration, signals, problems, .. } = reading;
        let parameters = is_complete.then_some(Parameters { configuration, signals });
        Self { problems: in_order(problems), is_accepted, apart, view, parameters }
    }
}

/// Problems as they are printed, in the order of their places.
fn in_order(problems: Vec<Problem>) -> Vec<Problem> {
    let mut problems: Vec<Problem> = problems.into_iter().map(Problem::printable).collect();
    problems.sort_by_key(|problem| problem.span().start);
    problems
}

/// The parameters of a file, for a device that is to have them; `None` where it is not understood as a whole. What there
/// is to say on it is printed to the error stream, as `edskit config check` prints it.
pub(crate) fn read(path: &Path, streams: &mut Streams) -> io::Result<Option<Parameters>> {
    let document = Document::from_vec(files::read(path, streams)?);
    let Report { problems, parameters, .. } = Report::of(document.to_bytes());
    print_problems(path, &document, problems, streams)?;
    Ok(parameters)
}

/// Prints problems of a file to the error stream.
pub(crate) fn print_problems(
    path: &Path,
    document: &Document,
    problems: Vec<Problem>,
    streams: &mut Streams,
) -> io::Result<()> {
    let style = Style { color: Color::Auto.is_wanted(streams.is_terminal), width: streams.width };
    let excerpts = excerpts(&name_of(path), document, &in_order(problems), style);
    streams.stderr.write_all(excerpts.as_bytes())
}

/// The file as it is called in excerpts.
fn name_of(path: &Path) -> String {
    match files::Input::File(path.to_path_buf()).name("") {
        name if name == "-" => "stdin".to_owned(),
        name => name,
    }
}

fn check(arguments: &ConfigCheckArguments, streams: &mut Streams) -> io::Result<Exit> {
    let document = Document::from_vec(files::read(&arguments.file, streams)?);
    let name = &name_of(&arguments.file);
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
