//! The edskit command line as a library, so that tests run it without a process.
//!
//! This is the only crate of the desk half that opens files, knows a terminal and knows JSON.

mod bus;
mod cli;
mod config;
mod device_file;
mod difference;
mod explain;
mod files;
mod fmt;
mod generate;
mod generated;
mod lint;
mod live;
mod monitor;
mod nmt;
mod paths;
mod positions;
mod printable;
mod profiles;
mod run;
mod sdo;
mod settings;
mod show;
mod streams;
mod value;

pub use cli::Cli;
pub use streams::{Exit, Streams};

use clap::Parser;
use std::ffi::OsString;
use std::io;

/// Runs one command line and says how it ended.
pub fn run(arguments: impl IntoIterator<Item = OsString>, streams: &mut Streams) -> Exit {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => return usage(&error, streams),
    };
    let result = match cli.command {
        cli::Command::Lint(arguments) => lint::run(&arguments, streams),
        cli::Command::Fmt(arguments) => fmt::run(&arguments, streams),
        cli::Command::Show(arguments) => show::run(&arguments, streams),
        cli::Command::Config(arguments) => config::run(&arguments, streams),
        cli::Command::Generate(arguments) => generate::run(&arguments, streams),
        cli::Command::Run(arguments) => run::run(&arguments, streams),
        cli::Command::Bus(arguments) => bus::run(&arguments, streams),
        cli::Command::Monitor(arguments) => monitor::run(&arguments, streams),
        cli::Command::Nmt(arguments) => nmt::run(&arguments, streams),
        cli::Command::Sdo(arguments) => sdo::run(&arguments, streams),
        cli::Command::Explain(arguments) => explain::run(&arguments, streams),
        cli::Command::Completions { shell } => generated::completions(shell, streams),
        cli::Command::Man => generated::man(streams),
    };
    match result {
        Ok(exit) => exit,
        // Whoever reads the output has seen enough, as `head` does.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Exit::Clean,
        Err(error) => {
            streams.complain(format_args!("{error}"));
            Exit::Failed
        }
    }
}

/// Help and version are no failures; anything else is.
fn usage(error: &clap::Error, streams: &mut Streams) -> Exit {
    let failed = error.use_stderr();
    let styled = error.render();
    let text = if streams.is_terminal { styled.ansi().to_string() } else { styled.to_string() };
    let stream = if failed { &mut streams.stderr } else { &mut streams.stdout };
    match stream.write_all(text.as_bytes()) {
        Ok(()) if !failed => Exit::Clean,
        _ => Exit::Failed,
    }
}
