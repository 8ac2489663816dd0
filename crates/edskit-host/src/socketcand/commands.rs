//! Cutting a stream of bytes into commands.

use edskit_types::{CanId, CobId};

/// The longest command that is understood. The longest useful one has eight sign-extended bytes: about 170 characters.
const MOST: usize = 512;

/// Finds what stands between `<` and `>`, however the bytes are cut. What stands outside is skipped, and so is a command
/// that is too long; a second `<` begins anew.
#[derive(Default)]
pub(crate) struct Commands {
    command: Vec<u8>,
    is_inside: bool,
}

impl Commands {
    /// Takes further bytes and calls `each` with the words of each command that they complete.
    pub(crate) fn feed(&mut self, bytes: &[u8], mut each: impl FnMut(&[&[u8]])) {
        for byte in bytes {
            match byte {
                b'<' => {
                    self.command.clear();
                    self.is_inside = true;
                }
                b'>' if self.is_inside => {
                    let words: Vec<&[u8]> =
                        self.command.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect();
                    each(&words);
                    self.is_inside = false;
                }
                _ if self.is_inside => {
                    self.command.push(*byte);
                    self.is_inside = self.command.len() < MOST;
                }
                _ => {}
            }
        }
    }
}

/// An identifier. One of more than three digits is an extended one, whatever its value; it may be sign-extended.
pub(crate) fn identifier(word: &[u8]) -> Option<CanId> {
    let number = hexadecimal(word)?;
    if word.len() > 3 {
        CanId::extended(number & CobId::EXTENDED_MASK)
    } else {
        CanId::standard(u16::try_from(number).ok()?)
    }
}

/// A hexadecimal number of which only the lowest 32 bits count. Senders that sign-extend write up to 16 digits.
pub(crate) fn hexadecimal(word: &[u8]) -> Option<u32> {
    if !(1..=16).contains(&word.len()) {
        return None;
    }
    let digits = word.iter().map(|byte| char::from(*byte).to_digit(16));
    digits.into_iter().try_fold(0, |number: u32, digit| Some(number << 4 | digit?))
}
