//! What the protocols have in common from the client's side.

use super::Greeter;
use crate::slcan::{Line, Lines};
use crate::socketcand::Commands;
use crate::{BusError, slcan, socketcand};
use edskit_runtime::Frame;

/// What the other side says.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Incoming {
    Frame(Frame),
    ErrorFrame(u32),
}

pub(super) enum Protocol {
    Socketcand { channel: String },
    Slcan,
}

impl Protocol {
    /// What has to be said before frames go both ways.
    pub(super) fn handshake(&self, greeter: &mut Greeter<'_>) -> Result<(), BusError> {
        match self {
            Self::Socketcand { channel } => socketcand::handshake(greeter, channel),
            Self::Slcan => slcan::handshake(greeter),
        }
    }

    pub(super) fn carries_remote_frames(&self) -> bool {
        matches!(self, Self::Slcan)
    }

    /// Reads one connection.
    pub(super) fn decoder(&self) -> Decoder {
        match self {
            Self::Socketcand { .. } => Decoder::Socketcand(Commands::default()),
            Self::Slcan => Decoder::Slcan(Lines::default()),
        }
    }

    /// What writes a frame.
    pub(super) fn encoder(&self) -> fn(&Frame, &mut Vec<u8>) {
        match self {
            Self::Socketcand { .. } => socketcand::encode,
            Self::Slcan => slcan::encode,
        }
    }
}

pub(super) enum Decoder {
    Socketcand(Commands),
    Slcan(Lines),
}

impl Decoder {
    /// Takes further bytes and calls `each` with what they complete. Anything else that the other side says is ignored.
    pub(super) fn feed(&mut self, bytes: &[u8], mut each: impl FnMut(Incoming)) {
        match self {
            Self::Socketcand(commands) => commands.feed(bytes, |words| {
                if let Some(incoming) = socketcand::decode(words) {
                    each(incoming);
                }
            }),
            Self::Slcan(lines) => lines.feed(bytes, |line| {
                if let Line::Text(text) = line
                    && let Some(frame) = slcan::decode(text)
                {
                    each(Incoming::Frame(frame));
                }
            }),
        }
    }
}
