//! One line for each finding, as compilers print them.

use super::report::Report;
use std::io::{self, Write};

pub(super) fn write(report: &Report, quiet: bool, out: &mut dyn Write) -> io::Result<()> {
    for (file, finding) in report.findings() {
        let place = finding.region().start;
        writeln!(
            out,
            "{}:{place}: {}[{}] {}",
            file.name, finding.severity, finding.rule.code, finding.message
        )?;
    }
    if quiet { Ok(()) } else { writeln!(out, "{}", report.summary()) }
}
