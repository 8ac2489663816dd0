//! What clap makes of the grammar: completions and the manual page.

use crate::cli::Cli;
use crate::{Exit, Streams};
use clap::CommandFactory;
use clap_complete::Shell;
use std::io;

pub(crate) fn completions(shell: Shell, streams: &mut Streams) -> io::Result<Exit> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "edskit", &mut script);
    streams.stdout.write_all(&script)?;
    streams.stdout.flush()?;
    Ok(Exit::Clean)
}

/// The main page, then one page for each command, in one stream as `man -l -` reads it.
pub(crate) fn man(streams: &mut Streams) -> io::Result<Exit> {
    let mut command = Cli::command();
    command.build();
    clap_mangen::Man::new(command.clone()).render(&mut streams.stdout)?;
    for subcommand in command.get_subcommands().filter(|subcommand| subcommand.get_name() != "help") {
        clap_mangen::Man::new(subcommand.clone()).render(&mut streams.stdout)?;
    }
    streams.stdout.flush()?;
    Ok(Exit::Clean)
}
