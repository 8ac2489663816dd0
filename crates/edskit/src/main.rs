//! The `edskit` command.

use edskit::Streams;
use std::process::ExitCode;

fn main() -> ExitCode {
    edskit::run(std::env::args_os(), &mut Streams::of_process()).into()
}
