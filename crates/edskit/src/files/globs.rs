//! Globs that no shell has expanded: those of Windows do not, and quotes keep the others from it.

use crate::paths;
use globset::GlobBuilder;
use std::path::{Path, PathBuf};

/// Whether a path is meant as a glob: it has a character of globs, and there is no file of that name.
pub(super) fn is_glob(path: &Path) -> bool {
    has_mark(&path.to_string_lossy()) && !path.exists()
}

fn has_mark(text: &str) -> bool {
    text.contains(['*', '?', '[', '{'])
}

/// The files and folders that a glob means, sorted, as a shell gives them: `**` crosses folders, and a name that begins
/// with a dot is only meant by one that does.
///
/// # Errors
/// Where the glob is broken, or means nothing.
pub(super) fn expand(path: &Path) -> Result<Vec<PathBuf>, String> {
    let pattern = paths::text(path);
    let glob = GlobBuilder::new(&pattern).literal_separator(true).build();
    let matcher = glob.map_err(|error| error.to_string())?.compile_matcher();
    // What stands before the first part with a mark is a folder.
    let parts: Vec<&str> = pattern.split('/').collect();
    let fixed = parts.iter().take_while(|part| !has_mark(part)).count();
    let mut folder: PathBuf = parts[..fixed].join("/").into();
    if fixed == 1 && parts[0].is_empty() {
        folder = PathBuf::from("/");
    }
    let start = if fixed == 0 { Path::new(".") } else { &folder };
    let depth = if pattern.contains("**") { None } else { Some(parts.len() - fixed) };
    let wants_hidden = parts.iter().any(|part| part.starts_with('.') && has_mark(part));
    let walk = ignore::WalkBuilder::new(start)
        .standard_filters(false)
        .hidden(!wants_hidden)
        .follow_links(true)
        .max_depth(depth)
        .build();
    let found = walk.filter_map(Result::ok).skip(1).map(ignore::DirEntry::into_path);
    let named = found.map(|path| path.strip_prefix("./").map(Path::to_path_buf).unwrap_or(path));
    let mut files: Vec<PathBuf> = named.filter(|path| matcher.is_match(path)).collect();
    if files.is_empty() {
        return Err(format!("{pattern}: there is no file that this glob means"));
    }
    files.sort();
    Ok(files)
}
