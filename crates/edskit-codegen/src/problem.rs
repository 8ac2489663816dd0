//! What stands against a dictionary, or is worth knowing about it.

use core::fmt;
use edskit_lint::{Finding, Severity};
use edskit_model::{Document, Position, Span};

/// The code of problems that the generator itself reports.
const OWN_CODE: &str = "GEN";

/// One of the files that a dictionary is made from.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum InputFile {
    /// The EDS or DCF.
    Eds,
    /// The side-file.
    SideFile,
}

/// Something that stands against a dictionary, or is worth knowing about it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Problem {
    /// An error stops the generation.
    pub severity: Severity,
    /// The code of the linter's rule, `GEN` for what the generator itself reports.
    pub code: &'static str,
    /// In which file.
    pub file: InputFile,
    /// At which bytes of it.
    pub span: Span,
    /// At which line and column of it.
    pub position: Position,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}

impl Problem {
    pub(crate) fn in_eds(document: &Document, severity: Severity, span: Span, message: String) -> Self {
        let position = document.position(span.start);
        Self { severity, code: OWN_CODE, file: InputFile::Eds, span, position, message, help: None }
    }

    pub(crate) fn in_side_file(text: &str, severity: Severity, span: Span, message: String) -> Self {
        let before = text.get(..span.start as usize).unwrap_or(text);
        let start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let position = Position {
            line: before.matches('\n').count() as u32 + 1,
            column: before[start..].chars().count() as u32 + 1,
        };
        Self { severity, code: OWN_CODE, file: InputFile::SideFile, span, position, message, help: None }
    }

    pub(crate) fn of_finding(document: &Document, finding: Finding) -> Self {
        let span = finding.span();
        Self {
            code: finding.rule.code,
            message: finding.message,
            help: finding.help,
            ..Self::in_eds(document, finding.severity, span, String::new())
        }
    }

    /// The problem in one line: `eds/Device.eds:12:5: OBJ003 what is wrong`.
    pub fn line<'a>(&'a self, eds: &'a str, side_file: &'a str) -> impl fmt::Display + 'a {
        let name = match self.file {
            InputFile::Eds => eds,
            InputFile::SideFile => side_file,
        };
        Line { name, problem: self }
    }
}

/// A problem with the name of its file.
struct Line<'a> {
    name: &'a str,
    problem: &'a Problem,
}

impl fmt::Display for Line<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Problem { position, code, message, help, .. } = self.problem;
        write!(f, "{}:{position}: {code} {message}", self.name)?;
        match help {
            Some(help) => write!(f, " ({help})"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_in_a_side_file_are_counted_in_characters() {
        let text = "a = 1\n\u{e4}\u{e4} = 2\n";
        let problem = Problem::in_side_file(text, Severity::Error, Span::new(10, 11), "wrong".into());
        assert_eq!(problem.line("a.eds", "a.toml").to_string(), "a.toml:2:3: GEN wrong");
    }
}
