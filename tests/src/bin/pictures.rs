//! Writes the pictures of the README again; `cargo xtask docs` calls it.

use edskit_tests::picture::PICTURES;
use edskit_tests::root;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    env::set_current_dir(root().join("tests"))?;
    for picture in PICTURES {
        fs::write(root().join("docs/pictures").join(picture.file_name), picture.render())?;
    }
    Ok(())
}
