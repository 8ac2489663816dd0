//! Does what a page for users says, and compares what it shows.

use crate::conformance::binaries;
use crate::python;
use crate::root;
use crate::say;
use crate::step::{Outcome, cargo, run};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;
use std::{env, fs};

const OF_GATEWAY: &str = "docs/gateway-tutorial.md";
const OF_VIRTUAL_TIME: &str = "docs/virtual-time.md";
/// What the reader is told to copy.
const COPIED: &str = "eds/CANopenGateway.eds";
/// In expected output: anything within a line, or any lines where it stands alone.
const ANYTHING: &str = "…";
/// How long a command that goes on may take for the output that is shown.
const PATIENCE: Duration = Duration::from_secs(30);

/// What a tutorial has its reader do.
#[derive(Debug, PartialEq)]
enum Step {
    /// A file to write.
    File { name: String, text: String },
    /// A command, and its output.
    Command { line: String, output: Vec<String> },
}

/// Whether the tutorial is true.
pub(crate) fn of_gateway() -> Outcome {
    is_true(OF_GATEWAY)
}

/// Whether the page on virtual time is true, the program in Rust included, which it shows whole.
pub(crate) fn of_virtual_time() -> Outcome {
    match run(&mut cargo(&["build", "--quiet", "--workspace", "--examples"])) {
        Outcome::Passed => is_true(OF_VIRTUAL_TIME),
        outcome => outcome,
    }
}

fn is_true(page: &str) -> Outcome {
    let python = match python::installed(crate::conformance::VENV, crate::conformance::REQUIREMENTS) {
        Ok(python) => python,
        Err(reason) => return Outcome::LeftOut(reason),
    };
    if let Err(reason) = crate::conformance::build_edskit() {
        return Outcome::Failed(reason);
    }
    match follow(page, &python) {
        Ok(count) => {
            say(format_args!("{page}: {count} files and commands"));
            Outcome::Passed
        }
        Err(reason) => Outcome::Failed(format!("{page}: {reason}")),
    }
}

fn follow(page: &str, python: &Path) -> Result<usize, String> {
    let wrong = |error: std::io::Error| error.to_string();
    let text = fs::read_to_string(root().join(page)).map_err(wrong)?;
    let folder = root().join("target").join(Path::new(page).file_stem().unwrap_or_default());
    fs::create_dir_all(&folder).map_err(wrong)?;
    fs::copy(root().join(COPIED), folder.join("CANopenGateway.eds")).map_err(wrong)?;
    let steps = steps(&text);
    // Programs that go on until the tutorial ends.
    let mut running = Vec::new();
    for step in &steps {
        match step {
            Step::File { name, text } => fs::write(folder.join(name), text).map_err(wrong)?,
            Step::Command { line, output } => {
                let mut program = Program::start(line, &folder, python)?;
                program.shows(output).map_err(|reason| format!("`{line}`: {reason}"))?;
                running.push(program);
            }
        }
    }
    if steps.is_empty() { Err("there is nothing to do".to_owned()) } else { Ok(steps.len()) }
}

/// Fenced blocks that begin with `# NAME` are files; in indented blocks a line after `$` is a command.
fn steps(text: &str) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        if line.starts_with("```") {
            let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
            if let Some(name) = block.first().and_then(|first| first.strip_prefix("# ")) {
                steps.push(Step::File { name: name.to_owned(), text: block.join("\n") + "\n" });
            }
        } else if let Some(command) = line.strip_prefix("    $ ") {
            let mut output = Vec::new();
            let is_output = |line: &&str| !line.starts_with("$ ");
            while let Some(shown) = lines.peek().and_then(|line| line.strip_prefix("    ")).filter(is_output)
            {
                output.push(shown.to_owned());
                lines.next();
            }
            steps.push(Step::Command { line: command.to_owned(), output });
        }
    }
    steps
}

/// A command of the tutorial; it ends with this value.
struct Program {
    process: Child,
    lines: Receiver<String>,
    /// Whether it goes on by itself.
    goes_on: bool,
}

impl Program {
    fn start(line: &str, folder: &Path, python: &Path) -> Result<Self, String> {
        let mut words = line.split_whitespace();
        let program = match words.next() {
            Some("edskit") => binaries().join("edskit"),
            Some("python") => python.to_owned(),
            Some("cargo") => example(&mut words)?,
            other => return Err(format!("`{line}`: {other:?} is no program of the tutorial")),
        };
        let mut command = Command::new(absolute(&program));
        command.args(words).current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut process = command.spawn().map_err(|error| format!("`{line}`: {error}"))?;
        let output = process.stdout.take().ok_or("a program has no output")?;
        let (sender, lines) = channel();
        std::thread::spawn(move || {
            BufReader::new(output).lines().map_while(Result::ok).try_for_each(|line| sender.send(line))
        });
        let goes_on = line.starts_with("edskit run") && !line.contains("--simulate");
        Ok(Self { process, lines, goes_on })
    }

    /// Compares the output: all of a program that ends, the beginning of one that goes on.
    fn shows(&mut self, expected: &[String]) -> Result<(), String> {
        let mut shown = Vec::new();
        loop {
            if self.goes_on && matches(expected, &shown) {
                return Ok(());
            }
            match self.lines.recv_timeout(PATIENCE) {
                Ok(line) => shown.push(line),
                Err(_) => break,
            }
        }
        if matches(expected, &shown) { Ok(()) } else { Err(format!("the output is\n{}", shown.join("\n"))) }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // A process that has ended already cannot be ended again, and that is no matter.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// The example that `cargo run -p PACKAGE --example NAME` runs.
fn example<'a>(words: &mut impl Iterator<Item = &'a str>) -> Result<PathBuf, String> {
    let name = words.skip_while(|word| *word != "--example").nth(1);
    name.map(|name| binaries().join("examples").join(name)).ok_or("cargo runs an example".to_owned())
}

/// The program, wherever the command is started.
fn absolute(program: &Path) -> PathBuf {
    if program.is_absolute() {
        program.to_owned()
    } else {
        env::current_dir().unwrap_or_default().join(program)
    }
}

/// Whether the output is as it is expected.
fn matches(expected: &[String], shown: &[String]) -> bool {
    match expected.split_first() {
        None => shown.is_empty(),
        Some((line, rest)) if line.trim() == ANYTHING => {
            (0..=shown.len()).any(|skipped| matches(rest, &shown[skipped..]))
        }
        Some((line, rest)) => match shown.split_first() {
            Some((first, others)) => line_matches(line.trim(), first.trim()) && matches(rest, others),
            None => false,
        },
    }
}

/// Whether a line is as it is expected.
fn line_matches(expected: &str, shown: &str) -> bool {
    match expected.split_once(ANYTHING) {
        None => expected == shown,
        Some((before, after)) => shown.strip_prefix(before).is_some_and(|rest| {
            rest.char_indices()
                .map(|(place, _)| place)
                .chain([rest.len()])
                .any(|place| line_matches(after, &rest[place..]))
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<String> {
        text.lines().map(str::to_owned).collect()
    }

    #[test]
    fn files_and_commands() {
        let text = "Text.\n\n```toml\n# a.toml\nx = 1\n```\n\n```toml\nx = 2\n```\n\n    $ edskit fmt a\n    one\n      two\n    $ edskit lint a\n\nMore.\n";
        let expected = [
            Step::File { name: "a.toml".to_owned(), text: "# a.toml\nx = 1\n".to_owned() },
            Step::Command { line: "edskit fmt a".to_owned(), output: lines("one\n  two") },
            Step::Command { line: "edskit lint a".to_owned(), output: Vec::new() },
        ];
        assert_eq!(steps(text), expected);
    }

    #[test]
    fn an_ellipsis_stands_for_anything() {
        let is_as = |expected: &str, shown: &str| matches(&lines(expected), &lines(shown));
        assert!(is_as("a\n…\nz", "a\nb\nc\nz") && is_as("…\nz", "z") && is_as("a\n…", "a"));
        assert!(!is_as("a\n…\nz", "a\nb\nc") && !is_as("a", "a\nb") && !is_as("a\nb", "a"));
        assert!(is_as("…  started, … kbit/s", "0.2  started, 125 kbit/s") && !is_as("x … y", "x y"));
    }
}
