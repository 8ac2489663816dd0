//! The files beside a linted one, as checks across files see them.

use edskit_lint::Neighbours;
use edskit_model::{Datasheet, Document};
use std::cell::RefCell;
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// The folder of one linted file.
pub(super) struct Folder {
    path: PathBuf,
    /// The files that were asked for; `None` for one that cannot be read.
    sheets: RefCell<HashMap<PathBuf, Option<Rc<Datasheet>>>>,
}

impl Folder {
    /// The folder of the file at `path`.
    pub(super) fn of(path: &Path) -> Self {
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        Self { path: parent.unwrap_or(Path::new(".")).to_owned(), sheets: RefCell::default() }
    }

    /// The file that a relative name names: exactly, or in another case, which makes no difference where most such
    /// files are written. `None` for names that mean nothing beside this file.
    fn find(&self, relative: &str) -> Option<Result<PathBuf, NotFound>> {
        let relative = relative.trim().replace('\\', "/");
        let has_drive = relative.as_bytes().get(1) == Some(&b':');
        if relative.is_empty() || relative.starts_with('/') || has_drive {
            return None;
        }
        let exact = self.path.join(&relative);
        if exact.is_file() {
            return Some(Ok(exact));
        }
        let mut found = self.path.clone();
        for part in relative.split('/').filter(|part| !part.is_empty() && *part != ".") {
            let Some(next) = child(&found, part) else { return Some(Err(NotFound)) };
            found = next;
        }
        Some(if found.is_file() { Ok(found) } else { Err(NotFound) })
    }
}

/// There is no such file.
struct NotFound;

/// The file or folder of this name in `folder`, in whatever case.
fn child(folder: &Path, name: &str) -> Option<PathBuf> {
    let exact = folder.join(name);
    if name == ".." || exact.exists() {
        return Some(exact);
    }
    let mut names: Vec<PathBuf> = fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.file_name().is_some_and(|file| file.eq_ignore_ascii_case(name)))
        .collect();
    // The order of a folder is not fixed, that of the output is.
    names.sort();
    names.into_iter().next()
}

impl Neighbours for Folder {
    fn exists(&self, relative: &str) -> Option<bool> {
        Some(self.find(relative)?.is_ok())
    }

    fn sheet(&self, relative: &str) -> Option<Rc<Datasheet>> {
        let path = self.find(relative)?.ok()?;
        let mut sheets = self.sheets.borrow_mut();
        let read = |path: &Path| Some(Rc::new(Datasheet::new(Document::from_vec(fs::read(path).ok()?))));
        sheets.entry(path.clone()).or_insert_with(|| read(&path)).clone()
    }
}
