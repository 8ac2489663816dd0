//! Writes seeded defects for other tools: `seeded_mutants FOLDER`.
//!
//! `bases/` gets the clean files, and each other folder one kind of defect, in the first place that each base has for
//! it. `kinds.tsv` names the folders: number, rule, kind.

use edskit_tests::seeded::{Base, Defect, bases, defects};
use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs};

fn main() -> ExitCode {
    let mut arguments = env::args_os().skip(1);
    let (Some(folder), None) = (arguments.next(), arguments.next()) else {
        return fail("give one argument: the folder to write to");
    };
    match write(&PathBuf::from(folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => fail(&error.to_string()),
    }
}

fn write(folder: &Path) -> io::Result<()> {
    let bases = bases();
    fs::create_dir_all(folder.join("bases"))?;
    for base in &bases {
        fs::write(folder.join("bases").join(file_name(&bases, base)), base.text())?;
    }
    let mut table = String::new();
    for (number, defect) in defects().iter().enumerate() {
        let _ = writeln!(table, "{number}\t{}\t{}", defect.rule, defect.kind);
        write_kind(&folder.join(number.to_string()), &bases, defect)?;
    }
    fs::write(folder.join("kinds.tsv"), table)
}

fn write_kind(folder: &Path, bases: &[Base], defect: &Defect) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    for base in bases {
        if let Some(mutant) = defect.mutants(base).first() {
            fs::write(folder.join(file_name(bases, base)), mutant.bytes())?;
        }
    }
    Ok(())
}

/// The file's own name; bases have different ones.
fn file_name<'a>(bases: &[Base], base: &'a Base) -> &'a str {
    let same = bases.iter().filter(|other| other.name == base.name).count();
    assert_eq!(same, 1, "{}: give the bases different names", base.name);
    &base.name
}

fn fail(message: &str) -> ExitCode {
    let _ = writeln!(io::stderr(), "seeded_mutants: {message}");
    ExitCode::FAILURE
}
