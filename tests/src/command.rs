//! The command line, run inside the test.

use edskit::{Exit, Streams};
use std::ffi::OsString;
use std::io::{self, Write};
use std::sync::{Arc, Mutex};

/// What a command printed, and how it ended.
pub struct Output {
    /// How it ended.
    pub exit: Exit,
    /// What went to standard output.
    pub stdout: String,
    /// What went to standard error.
    pub stderr: String,
}

impl Output {
    /// Everything in one text, for snapshots.
    pub fn all(&self) -> String {
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
pub fn edskit(arguments: &[&str]) -> Output {
    edskit_with_input(arguments, b"")
}

/// The same with something on standard input.
pub fn edskit_with_input(arguments: &[&str], input: &[u8]) -> Output {
    let (stdout, stderr) = (Buffer::default(), Buffer::default());
    let mut streams = Streams::of_buffers(input.to_vec(), Box::new(stdout.clone()), Box::new(stderr.clone()));
    let arguments = std::iter::once("edskit").chain(arguments.iter().copied()).map(OsString::from);
    let exit = edskit::run(arguments, &mut streams);
    Output { exit, stdout: stdout.text(), stderr: stderr.text() }
}

/// Runs `edskit` in the same way, and gives the bytes of standard output as they are.
pub fn edskit_bytes(arguments: &[&str]) -> Vec<u8> {
    let stdout = Buffer::default();
    let mut streams = Streams::of_buffers(Vec::new(), Box::new(stdout.clone()), Box::new(io::sink()));
    let arguments = std::iter::once("edskit").chain(arguments.iter().copied()).map(OsString::from);
    edskit::run(arguments, &mut streams);
    stdout.0.lock().expect("no writer panics").clone()
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
