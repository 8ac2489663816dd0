//! Profile files.

use crate::files;
use edskit_lint::{Profile, ProfileError};
use edskit_model::own_file::OwnFile;
use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Why a profile file cannot be used.
#[derive(Debug)]
pub(crate) enum Unusable {
    /// It cannot be read.
    Unreadable(PathBuf, io::Error),
    /// It is another file of edskit, for this reason.
    Another(PathBuf, String),
    /// It is not a profile.
    Wrong(PathBuf, ProfileError),
}

/// With the path of the file, and the line and column of a mistake.
impl fmt::Display for Unusable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(path, error) => f.write_str(&files::unreadable(&path.to_string_lossy(), error)),
            Self::Another(path, reason) => write!(f, "{}: {reason}", path.display()),
            Self::Wrong(path, error) => write!(f, "{}:{error}", path.display()),
        }
    }
}

/// Reads a profile file.
pub(crate) fn read(path: &Path) -> Result<Profile, Unusable> {
    let text = fs::read_to_string(path).map_err(|error| Unusable::Unreadable(path.to_path_buf(), error))?;
    if let Some(reason) = files::another_own_file(text.as_bytes(), OwnFile::Profile) {
        return Err(Unusable::Another(path.to_path_buf(), reason));
    }
    Profile::parse(&text).map_err(|error| Unusable::Wrong(path.to_path_buf(), error))
}
