//! The side of who attaches to a hub or to an adapter.

use super::decode;
use crate::BusError;
use crate::client::Greeter;

/// The name for people.
const PROTOCOL: &str = "SLCAN";

/// Opens the channel, and closes it before, should it be open. The bit rate stays as the adapter has it.
pub(crate) fn handshake(greeter: &mut Greeter<'_>) -> Result<(), BusError> {
    greeter.say(b"C\r")?;
    // An adapter may say no here: its channel was closed already.
    answer(greeter, "an answer to `C`")?;
    greeter.say(b"O\r")?;
    if answer(greeter, "an answer to `O`")? {
        Ok(())
    } else {
        Err(greeter.refused("its answer to `O` is the error character"))
    }
}

/// Whether the answer is a yes. Frames that come before it are from an open channel and skipped.
fn answer(greeter: &mut Greeter<'_>, expected: &'static str) -> Result<bool, BusError> {
    loop {
        let line = greeter.hear(PROTOCOL, expected, b"\r\x07")?;
        match line.as_slice() {
            b"\r" => return Ok(true),
            [.., b'\x07'] => return Ok(false),
            [text @ .., _] if decode(text).is_some() => {}
            _ => return Err(greeter.other_protocol(PROTOCOL, expected, &line)),
        }
    }
}
