//! Names of parameters.

use super::Parameter;
use super::series::Naming;
use core::fmt::{self, Write};

/// The name of a parameter, as the manual spells it: `CanOpTPDO4Assign(0)`.
#[derive(Clone, Copy, Debug)]
pub struct Name {
    stem: &'static str,
    /// Between the stem and the next part.
    number: Option<u16>,
    middle: &'static str,
    /// In parentheses at the end.
    index: Option<u16>,
}

impl Name {
    pub(super) fn of(parameter: Parameter) -> Option<Name> {
        let offset = parameter.offset;
        let plain = |stem, index| Some(Name { stem, number: None, middle: "", index });
        match parameter.series.naming {
            Naming::Single(stem) => plain(stem, None),
            Naming::Indexed(stem) => plain(stem, Some(offset)),
            Naming::TpdoAssignment => Some(Name {
                stem: "CanOpTPDO",
                number: Some(4 + offset / 4),
                middle: "Assign",
                index: Some(offset % 4),
            }),
            Naming::Some(names) => {
                let (_, stem) = names.iter().find(|(nth, _)| *nth == offset)?;
                plain(stem, None)
            }
        }
    }

    /// Whether `text` is this name, in any case.
    pub(super) fn is(self, text: &str) -> bool {
        let mut rest = Rest(text.as_bytes());
        write!(rest, "{self}").is_ok() && rest.0.is_empty()
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.stem)?;
        if let Some(number) = self.number {
            write!(f, "{number}")?;
        }
        f.write_str(self.middle)?;
        match self.index {
            Some(index) => write!(f, "({index})"),
            None => Ok(()),
        }
    }
}

/// What of a text is still to come; writing fails where something else comes.
struct Rest<'a>(&'a [u8]);

impl Write for Rest<'_> {
    fn write_str(&mut self, expected: &str) -> fmt::Result {
        match self.0.split_at_checked(expected.len()) {
            Some((start, rest)) if start.eq_ignore_ascii_case(expected.as_bytes()) => {
                self.0 = rest;
                Ok(())
            }
            _ => Err(fmt::Error),
        }
    }
}
