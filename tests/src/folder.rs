//! Folders of single tests.

use crate::Output;
use std::fs;
use std::path::PathBuf;

/// A folder of one test, gone when the test is.
pub struct Folder(PathBuf);

impl Folder {
    /// An empty folder, whose name holds that of the test.
    ///
    /// # Panics
    /// Where it cannot be made.
    pub fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("edskit-{}-{name}", std::process::id()));
        // What an earlier run of the same number may have left.
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).expect("the folder of a test can be made");
        Self(path)
    }

    /// Writes a file, with the folders it needs, and gives its path.
    ///
    /// # Panics
    /// Where that fails.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        let path = self.0.join(name);
        let parent = path.parent().expect("a file has a folder");
        fs::create_dir_all(parent).expect("the folder of a test can be made");
        fs::write(&path, content).expect("the file of a test can be written");
        path.to_str().expect("temporary paths are UTF-8").to_owned()
    }

    /// What a file holds.
    ///
    /// # Panics
    /// Where it cannot be read.
    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.join(name)).expect("the file of a test can be read")
    }

    /// The path of the folder.
    ///
    /// # Panics
    /// Where the path is not UTF-8.
    pub fn path(&self) -> &str {
        self.0.to_str().expect("temporary paths are UTF-8")
    }

    /// An output with the folder's own path taken out.
    pub fn clean(&self, output: &Output) -> String {
        output.all().replace(self.path(), "<folder>")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that stays behind harms nobody.
        let _ = fs::remove_dir_all(&self.0);
    }
}
