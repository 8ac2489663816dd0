//! The command line as its users see it: what it prints, where, and how it ends.

mod bad_input;
mod explain;
mod fix;
mod fmt;
mod help;
mod lint;
mod neighbours;
mod profiles;
mod settings;
mod show;

use edskit::{Exit, Streams};
use std::ffi::OsString;
use std::io::{self, Write};
use std::sync::{Arc, Mutex};

/// What a command printed, and how it ended.
struct Output {
    exit: Exit,
    stdout: String,
    stderr: String,
}

impl Output {
    /// Everything in one text, for snapshots.
    fn all(&self) -> String {
        let stream = |name: &str, text: &str| {
            if text.is_empty() { String::new() } else { format!("--- {name}\n{text}") }
        };
        format!(
            "{}{}--- exit {}",
            stream("stdout", &self.stdout),
            stream("stderr", &self.stderr),
            self.exit.code()
        )
    }
}

/// Runs `edskit` with these arguments in the folder `tests/`.
fn edskit(arguments: &[&str]) -> Output {
    edskit_with_input(arguments, b"")
}

/// The same with something on standard input.
fn edskit_with_input(arguments: &[&str], input: &[u8]) -> Output {
    let (stdout, stderr) = (Buffer::default(), Buffer::default());
    let mut streams = Streams::of_buffers(input.to_vec(), Box::new(stdout.clone()), Box::new(stderr.clone()));
    let arguments = std::iter::once("edskit").chain(arguments.iter().copied()).map(OsString::from);
    let exit = edskit::run(arguments, &mut streams);
    Output { exit, stdout: stdout.text(), stderr: stderr.text() }
}

/// A stream that can still be read when the command is done with it.
#[derive(Clone, Default)]
struct Buffer(Arc<Mutex<Vec<u8>>>);

impl Buffer {
    fn text(&self) -> String {
        String::from_utf8(self.0.lock().expect("no writer panics").clone())
            .expect("the command line prints UTF-8")
    }
}

impl Write for Buffer {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().expect("no writer panics").write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A folder of one test, gone when the test is.
struct Folder(std::path::PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("edskit-{}-{name}", std::process::id()));
        // What an earlier run of the same number may have left.
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).expect("the folder of a test can be made");
        Self(path)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        let path = self.0.join(name);
        let parent = path.parent().expect("a file has a folder");
        std::fs::create_dir_all(parent).expect("the folder of a test can be made");
        std::fs::write(&path, content).expect("the file of a test can be written");
        path.to_str().expect("temporary paths are UTF-8").to_owned()
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.0.join(name)).expect("the file of a test can be read")
    }

    fn path(&self) -> &str {
        self.0.to_str().expect("temporary paths are UTF-8")
    }

    /// An output with the folder's own path taken out.
    fn clean(&self, output: &Output) -> String {
        output.all().replace(self.path(), "<folder>")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // A folder that stays behind harms nobody.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
