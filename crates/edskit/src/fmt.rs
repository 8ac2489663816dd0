//! x
use crate::cli::FmtArguments;
use crate::{Exit, Streams};
use std::io;
pub(crate) fn run(_arguments: &FmtArguments, _streams: &mut Streams) -> io::Result<Exit> {
    Ok(Exit::Clean)
}
