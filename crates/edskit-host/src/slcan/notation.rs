//! Frames as lines: `tIIIL<data>`, `TIIIIIIIIL<data>`, `rIIIL`, `RIIIIIIIIL`.

use edskit_runtime::{Frame, MOST_DATA};
use edskit_types::CanId;
use std::io::Write;

/// The frame of a line without its end, or `None` where it is no frame. What follows the data is a time stamp and
/// ignored.
pub(crate) fn decode(line: &[u8]) -> Option<Frame> {
    let (kind, rest) = line.split_first()?;
    let (width, is_remote) = match kind {
        b't' => (3, false),
        b'T' => (8, false),
        b'r' => (3, true),
        b'R' => (8, true),
        _ => return None,
    };
    let (id, rest) = rest.split_at_checked(width)?;
    let id = number(id)?;
    let can_id = if width == 8 { CanId::extended(id) } else { CanId::standard(u16::try_from(id).ok()?) }?;
    let (length, rest) = rest.split_at_checked(1)?;
    let length = usize::try_from(number(length)?).ok().filter(|length| *length <= MOST_DATA)?;
    if is_remote {
        return Some(Frame::remote(can_id, length as u8));
    }
    let digits = rest.get(..2 * length)?;
    let mut data = [0; MOST_DATA];
    for (place, pair) in data.iter_mut().zip(digits.chunks(2)) {
        *place = number(pair)? as u8;
    }
    data.get(..length).map(|data| Frame::new(can_id, data))
}

/// Writes a frame as a line.
pub(crate) fn encode(frame: &Frame, out: &mut Vec<u8>) {
    let (kind, width) = match (frame.can_id().is_extended(), frame.is_remote()) {
        (false, false) => ('t', 3),
        (true, false) => ('T', 8),
        (false, true) => ('r', 3),
        (true, true) => ('R', 8),
    };
    // Writing to memory does not fail.
    let _ = write!(out, "{kind}{:0width$X}{}", frame.can_id().raw(), frame.length());
    for byte in frame.data() {
        let _ = write!(out, "{byte:02X}");
    }
    out.push(b'\r');
}

/// A hexadecimal number of up to eight digits.
fn number(digits: &[u8]) -> Option<u32> {
    let digits = digits.iter().map(|byte| char::from(*byte).to_digit(16));
    digits.into_iter().try_fold(0, |number: u32, digit| Some(number << 4 | digit?))
}
