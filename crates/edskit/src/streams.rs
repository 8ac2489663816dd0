//! Where a command reads, writes and complains, and how it ends.

use std::fmt;
use std::io::{self, IsTerminal, Read, Write};
use std::process::ExitCode;

/// The three streams of a command.
pub struct Streams {
    /// What `-` reads.
    pub stdin: Box<dyn Read>,
    /// Results.
    pub stdout: Box<dyn Write>,
    /// Complaints and progress.
    pub stderr: Box<dyn Write>,
    /// Whether results go to a terminal, so that colour and progress make sense.
    pub is_terminal: bool,
    /// Columns of the terminal.
    pub width: usize,
}

/// Columns where no terminal says otherwise.
const DEFAULT_WIDTH: usize = 110;

impl Streams {
    /// The streams of this process.
    pub fn of_process() -> Self {
        let columns = std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
        Self {
            stdin: Box::new(io::stdin()),
            stdout: Box::new(io::BufWriter::new(io::stdout())),
            stderr: Box::new(io::stderr()),
            is_terminal: io::stdout().is_terminal(),
            width: columns.unwrap_or(DEFAULT_WIDTH).clamp(60, 160),
        }
    }

    /// Streams that read `stdin` and write into buffers.
    pub fn of_buffers(stdin: Vec<u8>, stdout: Box<dyn Write>, stderr: Box<dyn Write>) -> Self {
        Self {
            stdin: Box::new(io::Cursor::new(stdin)),
            stdout,
            stderr,
            is_terminal: false,
            width: DEFAULT_WIDTH,
        }
    }

    /// Says why something could not be done.
    pub(crate) fn complain(&mut self, message: fmt::Arguments<'_>) {
        // Nothing is left to tell it to where even the error stream is gone.
        let _ = writeln!(self.stderr, "edskit: {message}");
    }
}

/// How a command ended.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Exit {
    /// 0: nothing to report.
    Clean,
    /// 1: findings, or files that are not formatted.
    Findings,
    /// 2: something could not be done.
    Failed,
}

impl Exit {
    /// The number that the process ends with.
    pub const fn code(self) -> u8 {
        match self {
            Self::Clean => 0,
            Self::Findings => 1,
            Self::Failed => 2,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}
