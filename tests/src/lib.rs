//! Helpers of the tests of what crosses crates: where the files are, hostile ones, and the command line.

pub mod allocation;
mod command;
pub mod conformance;
pub mod field_report;
mod folder;
pub mod hostile;
pub mod picture;
pub mod seeded;

pub use command::{Output, edskit, edskit_bytes, edskit_with_input};
pub use folder::Folder;

use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// A file of the corpus.
pub struct CorpusFile {
    /// The file's own name.
    pub name: String,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// The root of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("this package is a folder of the repository")
        .to_owned()
}

/// The shared folder beside the repository, or where `EDSKIT_SHARED` says; `None` where there is none.
///
/// It holds what is read from there and never copied into the project. Where it is missing, a test that needs it says
/// with `what` that this is left out, and passes, so that everybody can run the rest.
///
/// # Panics
/// Where the folder is missing and `CI` is set: there nothing may be left out.
pub fn shared(what: &str) -> Option<PathBuf> {
    let folder = env::var_os("EDSKIT_SHARED").map_or_else(|| root().join("../shared"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    assert!(!is_ci(), "{what} needs the shared folder, and {} is none", folder.display());
    // Not `eprintln!`: the test harness would keep its text back, and nobody would know.
    let _ = writeln!(io::stderr(), "left out: {what} needs the shared folder ({})", folder.display());
    None
}

/// The real EDS and DCF files of the shared folder, sorted by name; `None` as [`shared`] says.
///
/// # Panics
/// Where a file cannot be read, and as [`shared`] says.
pub fn corpus(what: &str) -> Option<Vec<CorpusFile>> {
    Some(files(&shared(what)?.join("corpus/files"), &["eds", "dcf"]))
}

/// The files of a folder that have one of these endings, sorted by name.
///
/// # Panics
/// Where the folder or a file cannot be read.
pub fn files(folder: &Path, endings: &[&str]) -> Vec<CorpusFile> {
    let mut paths = paths(folder);
    paths.retain(|path| {
        path.extension().and_then(OsStr::to_str).is_some_and(|ending| endings.contains(&ending))
    });
    let file = |path: &PathBuf| CorpusFile { name: file_name(path), bytes: read(path) };
    paths.iter().map(file).collect()
}

/// The paths of what a folder holds, sorted.
///
/// # Panics
/// Where the folder cannot be read.
pub fn paths(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> =
        entries.map(|entry| entry.expect("the folder can be read").path()).collect();
    paths.sort();
    paths
}

/// The Rust files below a folder with their text, those of the fuzz targets' own workspace left out.
///
/// # Panics
/// Where a folder or a file cannot be read.
pub fn rust_sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    for path in paths(folder) {
        if path.is_dir() && !path.ends_with("tests/fuzz") {
            found.extend(rust_sources(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let text = String::from_utf8(read(&path)).expect("Rust sources are UTF-8");
            found.push((path, text));
        }
    }
    found
}

/// The bytes of a file.
///
/// # Panics
/// Where the file cannot be read.
pub fn read(path: &Path) -> Vec<u8> {
    fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Whether this is a run in continuous integration: `CI` is set to something.
fn is_ci() -> bool {
    env::var_os("CI").is_some_and(|value| !value.is_empty())
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
