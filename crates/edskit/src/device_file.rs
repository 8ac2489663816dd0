//! An EDS or DCF with the side-file beside it (docs/generating.md).

use crate::files::{another_own_file, own_file, unreadable};
use crate::{Streams, printable};
use edskit_codegen::{Naming, Problem};
use edskit_model::own_file::OwnFile;
use std::fs;
use std::io;
use std::path::Path;

/// The two files that a dictionary is made from.
pub(crate) struct DeviceFile {
    pub(crate) eds: Vec<u8>,
    /// The text of the side-file, where there is one.
    pub(crate) side_file: Option<String>,
    /// How both files are called.
    pub(crate) naming: Naming,
}

impl DeviceFile {
    /// Reads both. A side-file that is named has to exist, the one beside the EDS need not.
    pub(crate) fn read(eds: &Path, side_file: Option<&Path>) -> Result<Self, String> {
        let mut naming = Naming::of(&eds.to_string_lossy());
        let bytes = fs::read(eds).map_err(|error| unreadable(&naming.eds, &error))?;
        if let Some(reason) = own_file(&bytes) {
            return Err(format!("{}: {reason}", naming.eds));
        }
        if let Some(side_file) = side_file {
            naming.side_file = side_file.to_string_lossy().into_owned();
        }
        let text = match fs::read_to_string(&naming.side_file) {
            Ok(text) => Some(text),
            Err(error) if side_file.is_none() && error.kind() == std::io::ErrorKind::NotFound => None,
            Err(error) => return Err(unreadable(&naming.side_file, &error)),
        };
        let another = text.as_deref().and_then(|text| another_own_file(text.as_bytes(), OwnFile::SideFile));
        if let Some(reason) = another {
            return Err(format!("{}: {reason}", naming.side_file));
        }
        Ok(Self { eds: bytes, side_file: text, naming })
    }
}

/// One line for each problem, as the concise format of `edskit lint` has them.
pub(crate) fn print_problems(problems: &[Problem], naming: &Naming, streams: &mut Streams) -> io::Result<()> {
    for problem in problems {
        let line = problem.line(&naming.eds, &naming.side_file).to_string();
        writeln!(streams.stderr, "{}: {}", problem.severity, printable::line(&line))?;
    }
    Ok(())
}
