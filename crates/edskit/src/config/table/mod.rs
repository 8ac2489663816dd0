//! Tables of parameters, as the PC tool exports them: to a parameter file, and back.

mod export;
mod import;
mod reading;

pub(super) use export::run as export;
pub(super) use import::run as import;

use crate::cli::ConfigUnit;
use crate::{Streams, files};
use edskit_devices::gateway::Owner;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// What begins a line of a parameter file that keeps a row of a table: one of a parameter that is not known here.
const KEPT: &str = "#: ";

/// The tables of a parameter file.
const TABLES: [(Owner, &str); 2] = [(Owner::Gateway, "[gateway]"), (Owner::Governor, "[governor]")];

impl From<ConfigUnit> for Owner {
    fn from(unit: ConfigUnit) -> Self {
        match unit {
            ConfigUnit::Gateway => Self::Gateway,
            ConfigUnit::Governor => Self::Governor,
        }
    }
}

/// Writes to a file, or to standard output where none is named.
fn write(text: &str, output: Option<&Path>, streams: &mut Streams) -> io::Result<()> {
    match output {
        None => {
            streams.stdout.write_all(text.as_bytes())?;
            streams.stdout.flush()
        }
        Some(path) => fs::write(path, text).map_err(|error| {
            io::Error::new(error.kind(), files::unreadable(&path.to_string_lossy(), &error))
        }),
    }
}
