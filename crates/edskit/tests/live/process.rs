//! A command in a process of its own.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// How long a line may take to appear.
const PATIENCE: Duration = Duration::from_secs(20);

/// A command that has been started; it is killed when this is dropped.
pub(crate) struct Process {
    child: Child,
    lines: Arc<Mutex<Vec<String>>>,
    reader: Option<JoinHandle<()>>,
}

/// What a command printed, and how it ended.
pub(crate) struct Output {
    pub(crate) stdout: String,
    pub(crate) stderr: String,
    pub(crate) code: i32,
}

impl Output {
    /// Everything in one text, for snapshots.
    pub(crate) fn all(&self) -> String {
        let stream = |name: &str, text: &str| {
            if text.is_empty() { String::new() } else { format!("--- {name}\n{text}") }
        };
        let (stdout, stderr) = (stream("stdout", &self.stdout), stream("stderr", &self.stderr));
        format!("{stdout}{stderr}--- exit {}", self.code)
    }
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_edskit"));
    command.args(arguments).current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests"));
    command
}

/// Runs a command to its end.
pub(crate) fn edskit(arguments: &[&str]) -> Output {
    let output = command(arguments).stdin(Stdio::null()).output().expect("the command can be started");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the command prints UTF-8");
    Output {
        stdout: text(output.stdout),
        stderr: text(output.stderr),
        code: output.status.code().expect("the command ends by itself"),
    }
}

impl Process {
    pub(crate) fn start(arguments: &[&str]) -> Self {
        let mut child = command(arguments)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit())
            .spawn()
            .expect("the command can be started");
        let output = BufReader::new(child.stdout.take().expect("the output is a pipe"));
        let lines = Arc::new(Mutex::new(Vec::new()));
        let collected = Arc::clone(&lines);
        let reader = thread::spawn(move || {
            for line in output.lines().map_while(Result::ok) {
                collected.lock().expect("nobody panics with the lines").push(line);
            }
        });
        Self { child, lines, reader: Some(reader) }
    }

    /// What has been printed so far.
    pub(crate) fn lines(&self) -> Vec<String> {
        self.lines.lock().expect("nobody panics with the lines").clone()
    }

    /// Waits for a line that holds `text`, and gives it.
    pub(crate) fn wait_for(&self, text: &str) -> String {
        let start = Instant::now();
        loop {
            if let Some(line) = self.lines().into_iter().find(|line| line.contains(text)) {
                return line;
            }
            assert!(start.elapsed() < PATIENCE, "no line has `{text}`: {:#?}", self.lines());
            thread::sleep(Duration::from_millis(10));
        }
    }

    /// The bus that the hub of this process offers.
    pub(crate) fn bus(&self, protocol: &str) -> String {
        let line = self.wait_for(&format!("{protocol} "));
        line.replacen(' ', ":", 1)
    }

    /// Asks the process to end by a signal (Ctrl-C sends `INT`), and gives its exit code.
    #[cfg(unix)]
    pub(crate) fn end(&mut self, signal: &str) -> i32 {
        let kill = Command::new("kill").args(["-s", signal, &self.child.id().to_string()]).status();
        assert!(kill.expect("kill can be started").success());
        let status = self.child.wait().expect("the process ends");
        if let Some(reader) = self.reader.take() {
            reader.join().expect("the reader does not panic");
        }
        status.code().expect("the process ends by itself")
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = self.reader.take().map(JoinHandle::join);
    }
}
