//! Paths as they are compared: the same file is the same path, however it is typed.

use std::path::{Component, Path, PathBuf, absolute};

/// The whole path of a file. The folder is the one that links lead to; the file keeps its own name.
pub(crate) fn whole(path: &Path) -> PathBuf {
    match (path.parent(), path.file_name()) {
        (Some(parent), Some(name)) => folder(parent).join(name),
        _ => folder(path),
    }
}

/// The whole path of a folder, without links where it exists; the empty path is the current one.
pub(crate) fn folder(path: &Path) -> PathBuf {
    let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
    path.canonicalize()
        .unwrap_or_else(|_| without_dots(&absolute(path).unwrap_or_else(|_| path.to_path_buf())))
}

/// A whole path as it is written from a folder, with `..` where it is not below it.
pub(crate) fn relative(from: &Path, to: &Path) -> PathBuf {
    let common = from.components().zip(to.components()).take_while(|(left, right)| left == right).count();
    if common == 0 {
        // Another drive.
        return to.to_path_buf();
    }
    let up = from.components().skip(common).map(|_| Component::ParentDir);
    up.chain(to.components().skip(common)).collect()
}

/// A path as text, with `/` between its parts on every system.
pub(crate) fn text(path: &Path) -> String {
    let text = path.to_string_lossy();
    if cfg!(windows) { text.replace('\\', "/") } else { text.into_owned() }
}

fn without_dots(path: &Path) -> PathBuf {
    let mut clean = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                clean.pop();
            }
            Component::CurDir => {}
            _ => clean.push(part),
        }
    }
    clean
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_the_same_however_it_is_typed() {
        let plain = whole(Path::new("nowhere/a.eds"));
        for typed in ["./nowhere/a.eds", "nowhere/../nowhere/a.eds", "nowhere//./a.eds"] {
            assert_eq!(whole(Path::new(typed)), plain);
        }
        assert_eq!(whole(Path::new("src/../src/lib.rs")), whole(Path::new("src/lib.rs")));
        assert_ne!(plain, whole(Path::new("a.eds")));
    }

    #[test]
    fn a_path_is_written_from_a_folder() {
        for (from, to, written) in [
            ("/a/b", "/a/b/c.eds", "c.eds"),
            ("/a/b", "/a/c/d.eds", "../c/d.eds"),
            ("/a", "/a/b/c.eds", "b/c.eds"),
        ] {
            assert_eq!(text(&relative(Path::new(from), Path::new(to))), written);
        }
    }
}
