//! Cutting a stream of bytes into lines.

/// The longest line that is understood. The longest useful one is an extended frame with a time stamp: 30 characters.
const MOST: usize = 64;

/// What stood before a carriage return or a bell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Line<'a> {
    /// Before a carriage return.
    Text(&'a [u8]),
    /// Before a carriage return, too long to be anything.
    TooLong,
    /// A bell: an adapter's no.
    Bell,
}

/// Finds lines, however the bytes are cut. Line feeds do not count.
#[derive(Default)]
pub(crate) struct Lines {
    line: Vec<u8>,
    is_too_long: bool,
}

impl Lines {
    /// Takes further bytes and calls `each` with each line that they complete.
    pub(crate) fn feed(&mut self, bytes: &[u8], mut each: impl FnMut(Line<'_>)) {
        for byte in bytes {
            match byte {
                b'\r' | b'\x07' => {
                    each(match byte {
                        b'\x07' => Line::Bell,
                        _ if self.is_too_long => Line::TooLong,
                        _ => Line::Text(&self.line),
                    });
                    self.line.clear();
                    self.is_too_long = false;
                }
                b'\n' => {}
                _ if self.line.len() < MOST => self.line.push(*byte),
                _ => self.is_too_long = true,
            }
        }
    }
}
