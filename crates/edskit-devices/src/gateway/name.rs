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
        let plain = |stem, index| Some(Name { index, ..Name::plain(stem) });
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

    /// A name that the manual prints as it is.
    pub(super) const fn plain(stem: &'static str) -> Name {
        Name { stem, number: None, middle: "", index: None }
    }

    /// Whether `text` is this name as people write it: in any case, and with or without blanks and underscores
    /// (GW-NOTE-43).
    pub(super) fn is(self, text: &str) -> bool {
        let mut rest = Rest(text);
        write!(rest, "{self}").is_ok() && rest.next().is_none()
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
struct Rest<'a>(&'a str);

impl Rest<'_> {
    /// The next character that counts.
    fn next(&mut self) -> Option<char> {
        let mut characters = self.0.chars();
        let next = characters.find(|character| counts(*character));
        self.0 = characters.as_str();
        next
    }
}

impl Write for Rest<'_> {
    fn write_str(&mut self, expected: &str) -> fmt::Result {
        let is_next = |expected: char| self.next().is_some_and(|next| next.eq_ignore_ascii_case(&expected));
        if expected.chars().filter(|expected| counts(*expected)).all(is_next) {
            Ok(())
        } else {
            Err(fmt::Error)
        }
    }
}

/// Whether a character of a name tells it from others.
fn counts(character: char) -> bool {
    !character.is_whitespace() && !"_\\".contains(character)
}
