//! The checks that need Python: what python-canopen and the plain reader find in the corpus.

use crate::root;
use crate::step::{Outcome, command, run};
use std::env;
use std::path::PathBuf;

/// Where the pinned packages are installed; `benches/compare` has the same place.
const VENV: &str = "target/compare-venv";
const REQUIREMENTS: &str = "tests/corpus/requirements.txt";

/// Whether `tests/corpus/independent.tsv` is what the two readers find today.
pub(crate) fn independent_reading() -> Outcome {
    let corpus = shared().join("corpus/files");
    if !corpus.is_dir() {
        return Outcome::LeftOut(format!("{} is no folder", corpus.display()));
    }
    let python = match installed(VENV, REQUIREMENTS) {
        Ok(python) => python,
        Err(reason) => return Outcome::LeftOut(reason),
    };
    run(command(python, &["tests/corpus/independent_reading.py", "--check"]).arg(corpus))
}

/// The shared folder, whether or not it is there.
pub(crate) fn shared() -> PathBuf {
    env::var_os("EDSKIT_SHARED").map_or_else(|| root().join("../shared"), PathBuf::from)
}

/// The interpreter of a virtual environment with these packages; it is made where it is missing.
pub(crate) fn installed(venv: &str, requirements: &str) -> Result<PathBuf, String> {
    let python = root().join(venv).join("bin/python");
    if !python.exists() {
        needed("python3 cannot make a virtual environment", "python3".into(), &["-m", "venv", venv])?;
    }
    let install = ["-m", "pip", "--quiet", "--disable-pip-version-check", "install", "-r"];
    let install = [&install[..], &[requirements]].concat();
    needed(&format!("{requirements} cannot be installed"), python.clone(), &install)?;
    Ok(python)
}

fn needed(reason: &str, program: PathBuf, arguments: &[&str]) -> Result<(), String> {
    match run(&mut command(program, arguments)) {
        Outcome::Passed => Ok(()),
        outcome => Err(format!("{reason} ({outcome})")),
    }
}
