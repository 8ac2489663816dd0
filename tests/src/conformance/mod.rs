//! The pages `docs/conformance/<device>.md`: which test shows which statement of a device's manual.
//!
//! A test names the statements that it shows in comments directly above or inside its function. A file
//! `docs/conformance/<device>.toml` says how many statements there are, how doubtful ones are read, and why no test shows
//! some of them. The page is made of both.

mod device;
mod id;
mod page;
mod source;

pub use device::{Chapter, Device};
pub use id::{Id, ids};
pub use page::{Evidence, Page};
pub use source::{Source, TestFunction};

use crate::{paths, root, rust_sources};
use std::fs;

/// The names of the devices that have a page, sorted.
pub fn device_names() -> Vec<String> {
    let mut paths = paths(&root().join("docs/conformance"));
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    paths.iter().filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned())).collect()
}

/// What `docs/conformance/<name>.toml` says.
///
/// # Errors
/// Why it cannot be read.
pub fn device(name: &str) -> Result<Device, String> {
    let path = root().join(format!("docs/conformance/{name}.toml"));
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    toml::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))
}

/// What the tests below `crates/` and `tests/` show of a device.
///
/// # Errors
/// What is wrong with the IDs in comments, in tests and elsewhere, one line for each.
pub fn evidence(device: &Device) -> Result<Evidence, String> {
    let root = root();
    let mut evidence = Evidence::default();
    let mut problems = Vec::new();
    for (path, text) in ["crates", "tests"].iter().flat_map(|folder| rust_sources(&root.join(folder))) {
        let path = path.strip_prefix(&root).expect("sources are in the repository");
        let file = path.to_str().expect("sources have names in UTF-8").replace('\\', "/");
        if let Err(found) = evidence.read(device, &file, &text) {
            problems.extend(found);
        }
    }
    if problems.is_empty() { Ok(evidence) } else { Err(problems.join("\n")) }
}
