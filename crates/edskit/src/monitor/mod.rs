use crate::cli::MonitorArguments;
use crate::{Exit, Streams};
use std::io;
pub(crate) fn run(arguments: &MonitorArguments, streams: &mut Streams) -> io::Result<Exit> {
    Ok(Exit::Clean)
}
