//! The formats of the findings: each writes one file after the other, so that a run of any size needs little memory.

use super::report::{FileReport, Summary};
use super::{concise, github, human, json, junit, sarif, statistics};
use crate::cli::{LintArguments, LintFormat};
use std::io::{self, Write};

/// One format.
pub(super) trait Format {
    /// What stands before the first file.
    fn begin(&mut self, _: &mut dyn Write) -> io::Result<()> {
        Ok(())
    }

    /// The findings of a file.
    fn file(&mut self, file: &FileReport, out: &mut dyn Write) -> io::Result<()>;

    /// What stands behind the last file.
    fn end(&mut self, summary: &Summary, out: &mut dyn Write) -> io::Result<()>;
}

/// The format that the command line asks for.
pub(super) fn of(arguments: &LintArguments) -> Box<dyn Format> {
    let quiet = arguments.quiet;
    match arguments.format {
        LintFormat::Human if arguments.statistics => Box::new(statistics::Human::default()),
        LintFormat::Json if arguments.statistics => Box::new(statistics::Json::default()),
        LintFormat::Human => Box::new(human::Human { quiet }),
        LintFormat::Concise => Box::new(concise::Concise { quiet }),
        LintFormat::Json => Box::new(json::Json::default()),
        LintFormat::Sarif => Box::new(sarif::Sarif::default()),
        LintFormat::Github => Box::new(github::Github),
        LintFormat::Junit => Box::new(junit::Junit::default()),
    }
}
