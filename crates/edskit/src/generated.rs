//! What clap makes of the grammar: completions and the manual page.

use crate::cli::Cli;
use crate::{Exit, Streams};
use clap::{Command, CommandFactory};
use clap_complete::Shell;
use std::io::{self, Write};

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
    pages(&command, &mut *streams.stdout)?;
    streams.stdout.flush()?;
    Ok(Exit::Clean)
}

/// The page of a command, and those of the commands below it.
fn pages(command: &Command, out: &mut dyn Write) -> io::Result<()> {
    clap_mangen::Man::new(command.clone()).render(out)?;
    let below = command.get_subcommands().filter(|subcommand| subcommand.get_name() != "help");
    below.into_iter().try_for_each(|subcommand| pages(subcommand, out))
}
