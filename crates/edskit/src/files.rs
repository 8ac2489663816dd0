//! Finding and reading the files of a command.

mod globs;

use crate::{Streams, paths};
use edskit_model::Datasheet;
use edskit_model::own_file::OwnFile;
use std::collections::{HashMap, HashSet};
use std::ffi::OsString;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Endings of the files that a folder is searched for, in any case.
const ENDINGS: [&str; 3] = ["eds", "dcf", "cpj"];

/// Where one input comes from.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Input {
    /// A file.
    File(PathBuf),
    /// Standard input, read already.
    Stdin(Vec<u8>),
}

impl Input {
    /// The path as it is shown: `/` between its parts on every system.
    pub(crate) fn name(&self, stdin_name: &str) -> String {
        match self {
            Self::File(path) => paths::text(path),
            Self::Stdin(_) => stdin_name.to_owned(),
        }
    }

    /// The bytes.
    pub(crate) fn read(&self) -> io::Result<Vec<u8>> {
        match self {
            Self::File(path) => fs::read(path),
            Self::Stdin(bytes) => Ok(bytes.clone()),
        }
    }
}

/// What `paths` name: each file once, folders searched, in the order of the arguments and sorted within a folder.
#[derive(Default)]
pub(crate) struct Inputs {
    pub(crate) inputs: Vec<Input>,
    /// What could not be searched, and why.
    pub(crate) failures: Vec<String>,
}

pub(crate) fn find(paths: &[PathBuf], streams: &mut Streams) -> io::Result<Inputs> {
    let mut found = Inputs::default();
    for path in paths {
        if path.as_os_str() == "-" {
            let mut bytes = Vec::new();
            streams.stdin.read_to_end(&mut bytes)?;
            found.inputs.push(Input::Stdin(bytes));
        } else if globs::is_glob(path) {
            match globs::expand(path) {
                Ok(paths) => paths.iter().for_each(|path| add(path, &mut found)),
                Err(reason) => found.failures.push(reason),
            }
        } else {
            add(path, &mut found);
        }
    }
    let mut seen = HashSet::new();
    // Most files lie together, and to ask for the folder of each takes its time.
    let mut folders: HashMap<PathBuf, PathBuf> = HashMap::new();
    found.inputs.retain(|input| match input {
        Input::File(path) => match (path.parent(), path.file_name()) {
            (Some(parent), Some(name)) => {
                let folder = folders.entry(parent.to_path_buf()).or_insert_with(|| paths::folder(parent));
                seen.insert(folder.join(name))
            }
            _ => seen.insert(paths::whole(path)),
        },
        Input::Stdin(_) => true,
    });
    Ok(found)
}

fn add(path: &Path, found: &mut Inputs) {
    if path.is_dir() {
        search(path, found);
    } else {
        found.inputs.push(Input::File(path.to_path_buf()));
    }
}

/// The one file that an argument names, which may be a glob.
///
/// # Errors
/// Where a glob names no file, or several.
pub(crate) fn one(argument: OsString) -> Result<PathBuf, String> {
    let path = PathBuf::from(argument);
    if !globs::is_glob(&path) {
        return Ok(path);
    }
    let mut files = globs::expand(&path)?;
    match files.len() {
        1 => Ok(files.remove(0)),
        count => Err(format!(
            "{} files are meant by this, and one is wanted: {} is the first",
            count,
            files[0].display()
        )),
    }
}

/// Adds the files below `folder` that end like a CANopen file; what git ignores is passed over.
fn search(folder: &Path, found: &mut Inputs) {
    let mut files = Vec::new();
    for entry in ignore::WalkBuilder::new(folder).require_git(false).build() {
        match entry {
            Ok(entry) if entry.path().is_file() && has_known_ending(entry.path()) => {
                let path = entry.into_path();
                files.push(path.strip_prefix("./").map(Path::to_path_buf).unwrap_or(path));
            }
            Ok(_) => {}
            Err(error) => found.failures.push(error.to_string()),
        }
    }
    if files.is_empty() {
        found.failures.push(format!("{}: no .eds, .dcf or .cpj file in this folder", folder.display()));
    }
    files.sort();
    found.inputs.extend(files.into_iter().map(Input::File));
}

fn has_known_ending(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default();
    ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known))
}

/// Reads one file or standard input into a datasheet; the error names the file.
pub(crate) fn read_datasheet(path: &Path, streams: &mut Streams) -> io::Result<Datasheet> {
    Ok(Datasheet::new(edskit_model::Document::from_vec(read(path, streams)?)))
}

/// Reads one file or standard input; the error names the file.
pub(crate) fn read(path: &Path, streams: &mut Streams) -> io::Result<Vec<u8>> {
    if path.as_os_str() == "-" {
        let mut bytes = Vec::new();
        streams.stdin.read_to_end(&mut bytes)?;
        return Ok(bytes);
    }
    fs::read(path).map_err(|error| io::Error::new(error.kind(), unreadable(&path.to_string_lossy(), &error)))
}

/// What a file of edskit itself is, and which command takes it; `None` for other files.
pub(crate) fn own_file(bytes: &[u8]) -> Option<String> {
    OwnFile::of(bytes).map(OwnFile::told)
}

/// The same where one kind of these files is wanted, and the file is another one.
pub(crate) fn another_own_file(bytes: &[u8], wanted: OwnFile) -> Option<String> {
    OwnFile::of(bytes)?.instead_of(wanted)
}

/// Why a file could not be read.
pub(crate) fn unreadable(name: &str, error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => format!("{name}: there is no such file or folder"),
        io::ErrorKind::PermissionDenied => format!("{name}: no permission to read it"),
        io::ErrorKind::IsADirectory => format!("{name}: this is a folder"),
        _ => format!("{name}: {error}"),
    }
}
