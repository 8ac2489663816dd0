//! The pictures of the README are what the command line prints.

use edskit_tests::picture::PICTURES;
use edskit_tests::root;
use std::fs;

#[test]
fn the_pictures_are_current_and_the_readme_shows_them() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    for picture in PICTURES {
        let path = format!("docs/pictures/{}", picture.file_name);
        let written = fs::read_to_string(root().join(&path)).unwrap();
        assert!(picture.render() == written, "{path} is stale; `cargo xtask docs` writes it again");
        assert!(readme.contains(&format!("({path})")), "the README does not show {path}");
    }
}
