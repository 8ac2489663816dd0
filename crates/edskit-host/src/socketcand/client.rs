//! The side of who attaches to a hub or to a socketcand daemon.

use super::commands::{hexadecimal, identifier};
use crate::BusError;
use crate::client::{Greeter, Incoming};
use edskit_runtime::{Frame, MOST_DATA};
use edskit_types::CobId;
use std::io::Write;

/// The name for people.
const PROTOCOL: &str = "socketcand";

/// Opens `channel` in raw mode.
pub(crate) fn handshake(greeter: &mut Greeter<'_>, channel: &str) -> Result<(), BusError> {
    expect(greeter, "< hi >")?;
    greeter.say(format!("< open {channel} >").as_bytes())?;
    expect(greeter, "< ok >")?;
    greeter.say(b"< rawmode >")?;
    expect(greeter, "< ok >")
}

fn expect(greeter: &mut Greeter<'_>, expected: &'static str) -> Result<(), BusError> {
    let found = greeter.hear(PROTOCOL, expected, b">")?;
    let text = String::from_utf8_lossy(&found);
    let words: Vec<&str> = text.split(|c: char| c.is_whitespace() || c == '<' || c == '>').collect();
    let said = words.iter().filter(|word| !word.is_empty()).copied().collect::<Vec<_>>().join(" ");
    match said.strip_prefix("error") {
        _ if expected.trim_matches(['<', '>', ' ']) == said => Ok(()),
        Some(reason) => Err(greeter.refused(reason.trim())),
        None => Err(greeter.other_protocol(PROTOCOL, expected, &found)),
    }
}

/// What the words of a command mean: a frame, an error frame, or nothing to us.
pub(crate) fn decode(words: &[&[u8]]) -> Option<Incoming> {
    match words {
        // Daemons write the data in one piece in raw mode and byte by byte elsewhere.
        [b"frame", id, _time, data @ ..] => frame(id, &data.concat()).map(Incoming::Frame),
        [b"error", class, _time, ..] => {
            hexadecimal(class).map(|class| Incoming::ErrorFrame(class & CobId::EXTENDED_MASK))
        }
        _ => None,
    }
}

fn frame(id: &[u8], digits: &[u8]) -> Option<Frame> {
    let can_id = identifier(id)?;
    let mut data = [0; MOST_DATA];
    let length = digits.len() / 2;
    if !digits.len().is_multiple_of(2) || length > MOST_DATA {
        return None;
    }
    for (place, pair) in data.iter_mut().zip(digits.chunks(2)) {
        *place = hexadecimal(pair)? as u8;
    }
    data.get(..length).map(|data| Frame::new(can_id, data))
}

/// `< send ID LENGTH BYTE... >`, without data `< send ID 0  >`. Remote frames cannot be said.
pub(crate) fn encode(frame: &Frame, out: &mut Vec<u8>) {
    let width = if frame.can_id().is_extended() { 8 } else { 3 };
    // Writing to memory does not fail.
    let _ = write!(out, "< send {:0width$X} {} ", frame.can_id().raw(), frame.length());
    for byte in frame.data() {
        let _ = write!(out, "{byte:x} ");
    }
    out.extend_from_slice(if frame.data().is_empty() { b" >" } else { b">" });
}
