//! Times each stage over the files of a folder: `throughput FOLDER`.
//!
//! Prints one JSON object for each stage: its name, the bytes of all files, and the median of the seconds of a pass.

use edskit_benches::{Input, Stage};
use std::env;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// How often each stage runs; the stages take turns, so that a disturbance hits all of them.
const PASSES: usize = 15;

fn main() -> ExitCode {
    let mut arguments = env::args_os().skip(1);
    let (Some(folder), None) = (arguments.next(), arguments.next()) else {
        return fail("give one argument: a folder of EDS and DCF files");
    };
    let input = Input::of_folder(&PathBuf::from(folder));
    if input.is_empty() {
        return fail("the folder has no EDS or DCF file");
    }
    match print(&input) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => fail(&error.to_string()),
    }
}

fn print(input: &Input) -> io::Result<()> {
    let mut seconds = Stage::ALL.map(|_| Vec::with_capacity(PASSES));
    for _ in 0..PASSES {
        for (stage, seconds) in Stage::ALL.into_iter().zip(&mut seconds) {
            seconds.push(time(stage, input));
        }
    }
    let mut out = io::stdout().lock();
    for (stage, mut seconds) in Stage::ALL.into_iter().zip(seconds) {
        seconds.sort();
        let (name, bytes, median) = (stage.name(), input.bytes(), seconds[PASSES / 2].as_secs_f64());
        writeln!(out, r#"{{"stage":"{name}","bytes":{bytes},"seconds":{median}}}"#)?;
    }
    Ok(())
}

fn time(stage: Stage, input: &Input) -> Duration {
    let start = Instant::now();
    stage.run(input);
    start.elapsed()
}

fn fail(message: &str) -> ExitCode {
    let _ = writeln!(io::stderr(), "throughput: {message}");
    ExitCode::FAILURE
}
