//! `edskit config dcf`: what a gateway with some parameters is on CANopen, as a DCF.
//!
//! The data sheet of the gateway describes every configuration: the greatest number of entries, and PDOs that are
//! inactive. The parameters decide what there is of them (GW-EDS-16, GW-GAP-01), and nothing of it can be written over
//! CANopen (GW-OD-24). So the DCF is the data sheet with the entries that exist, and what they hold after a start as their
//! defaults.

mod description;
mod start;

use crate::cli::ConfigDcfArguments;
use crate::printable;
use crate::run::gateway::gateway;
use crate::{Exit, Streams};
use description::describe;
use edskit_model::Datasheet;
use start::Started;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// The data sheet of the gateway.
const DATA_SHEET: &[u8] = include_bytes!("../../../../../eds/CANopenGateway.eds");

pub(super) fn run(arguments: &ConfigDcfArguments, streams: &mut Streams) -> io::Result<Exit> {
    let Some(parameters) = super::read(&arguments.file, streams)? else { return Ok(Exit::Findings) };
    let started = match Started::of(gateway(parameters)) {
        Ok(started) => started,
        Err(reason) => {
            let file = super::name_of(&arguments.file);
            streams.complain(format_args!("{file}: there is no DCF, because {reason}"));
            return Ok(Exit::Findings);
        }
    };
    let default_name = file_name(&arguments.file.with_extension("dcf"));
    let name = arguments.output.as_deref().map_or(default_name, file_name);
    let dcf = describe(&Datasheet::parse(DATA_SHEET), &name, started).map_err(io::Error::other)?;
    match &arguments.output {
        None => {
            streams.stdout.write_all(&dcf)?;
            streams.stdout.flush()?;
        }
        Some(path) => fs::write(path, &dcf)
            .map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", path.display())))?,
    }
    Ok(Exit::Clean)
}

/// The name that the file has in its own text.
fn file_name(path: &Path) -> String {
    let name = path.file_name().filter(|name| *name != "-.dcf");
    name.map_or_else(|| "gateway.dcf".to_owned(), |name| printable::line(&name.to_string_lossy()))
}
