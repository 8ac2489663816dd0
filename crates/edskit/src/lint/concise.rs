//! One line for each finding, as compilers print them.

use super::format::Format;
use super::report::{FileReport, Summary};
use std::io::{self, Write};

pub(super) struct Concise {
    pub(super) quiet: bool,
}

impl Format for Concise {
    fn file(&mut self, file: &FileReport, out: &mut dyn Write) -> io::Result<()> {
        for finding in file.findings() {
            let place = finding.region().start;
            writeln!(
                out,
                "{}:{place}: {}[{}] {}",
                file.name, finding.severity, finding.rule.code, finding.message
            )?;
        }
        Ok(())
    }

    fn end(&mut self, summary: &Summary, out: &mut dyn Write) -> io::Result<()> {
        if self.quiet { Ok(()) } else { writeln!(out, "{summary}") }
    }
}
