//! x
use crate::cli::ShowArguments;
use crate::{Exit, Streams};
use std::io;
pub(crate) fn run(_arguments: &ShowArguments, _streams: &mut Streams) -> io::Result<Exit> {
    Ok(Exit::Clean)
}
