//! The side of the hub.

use super::commands::{Commands, hexadecimal, identifier};
use crate::Received;
use crate::hub::{Answer, Dialect};
use edskit_runtime::{Frame, MOST_DATA};
use std::io::Write;
use std::time::Duration;

/// How long frames are held back after the last word of the handshake: python-can reads that word with a single `recv` and
/// compares it exactly, so nothing may follow it in the same segment.
const HOLD_BACK: Duration = Duration::from_millis(20);

/// One client's conversation.
#[derive(Default)]
pub(crate) struct Server {
    commands: Commands,
    is_raw: bool,
}

impl Dialect for Server {
    fn greeting(&self) -> Option<&'static [u8]> {
        Some(b"< hi >")
    }

    /// Unknown commands are ignored, and nothing is ever answered with an error: python-can breaks on a text in raw mode.
    fn feed(&mut self, bytes: &[u8], answer: &mut dyn FnMut(Answer)) {
        let is_raw = &mut self.is_raw;
        self.commands.feed(bytes, |words| match words {
            [b"open", ..] if !*is_raw => answer(Answer::Reply(b"< ok >")),
            [b"rawmode", ..] if *is_raw => answer(Answer::Reply(b"< ok >")),
            [b"rawmode", ..] => {
                answer(Answer::Join(b"< ok >", HOLD_BACK));
                *is_raw = true;
            }
            [b"echo", ..] => answer(Answer::Reply(b"< echo >")),
            [b"send", id, length, data @ ..] if *is_raw => {
                if let Some(frame) = sent(id, length, data) {
                    answer(Answer::Frame(frame));
                }
            }
            _ => {}
        });
    }

    fn carries_remote_frames(&self) -> bool {
        false
    }

    fn encoder(&self) -> fn(&Received, &mut Vec<u8>) {
        encode
    }
}

/// The frame of `send ID LENGTH BYTE...`. Identifiers and bytes may be sign-extended, as SavvyCAN writes them.
fn sent(id: &[u8], length: &[u8], data: &[&[u8]]) -> Option<Frame> {
    let can_id = identifier(id)?;
    let length = usize::try_from(hexadecimal(length)?).ok()?;
    if length > MOST_DATA || length != data.len() {
        return None;
    }
    let mut bytes = [0; MOST_DATA];
    for (place, word) in bytes.iter_mut().zip(data) {
        *place = (hexadecimal(word)? & 0xFF) as u8;
    }
    bytes.get(..length).map(|data| Frame::new(can_id, data))
}

/// `< frame ID SECONDS.MICROSECONDS DATA >`. Without data both blanks stay, python-can needs them.
fn encode(received: &Received, out: &mut Vec<u8>) {
    let Received { time, frame } = received;
    let width = if frame.can_id().is_extended() { 8 } else { 3 };
    let (seconds, rest) = (time.0 / 1_000_000, time.0 % 1_000_000);
    // Writing to memory does not fail.
    let _ = write!(out, "< frame {:0width$X} {seconds}.{rest:06} ", frame.can_id().raw());
    for byte in frame.data() {
        let _ = write!(out, "{byte:02X}");
    }
    out.extend_from_slice(b" >");
}
