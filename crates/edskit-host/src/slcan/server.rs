//! The side of the hub.

use super::{Line, Lines, decode, encode};
use crate::Received;
use crate::hub::{Answer, Dialect};
use std::time::Duration;

const OK: &[u8] = b"\r";
const ERROR: &[u8] = b"\x07";

/// One client's conversation. Bit rates are accepted and have no meaning.
#[derive(Default)]
pub(crate) struct Server {
    lines: Lines,
    channel: Channel,
}

#[derive(Clone, Copy, PartialEq, Eq, Default)]
enum Channel {
    #[default]
    Closed,
    Open,
    ListenOnly,
}

impl Dialect for Server {
    fn greeting(&self) -> Option<&'static [u8]> {
        None
    }

    fn feed(&mut self, bytes: &[u8], answer: &mut dyn FnMut(Answer)) {
        let channel = &mut self.channel;
        self.lines.feed(bytes, |line| match line {
            Line::Text(text) => obey(channel, text, answer),
            Line::TooLong => answer(Answer::Reply(ERROR)),
            // A client that says no to us: it has no question.
            Line::Bell => {}
        });
    }

    fn carries_remote_frames(&self) -> bool {
        true
    }

    fn encoder(&self) -> fn(&Received, &mut Vec<u8>) {
        |received, out| encode(&received.frame, out)
    }
}

fn obey(channel: &mut Channel, text: &[u8], answer: &mut dyn FnMut(Answer)) {
    let reply: &[u8] = match text {
        b"O" | b"L" => {
            *channel = if text == b"O" { Channel::Open } else { Channel::ListenOnly };
            return answer(Answer::Join(OK, Duration::ZERO));
        }
        b"C" => {
            *channel = Channel::Closed;
            answer(Answer::Leave);
            OK
        }
        b"" | [b'S', b'0'..=b'9'] => OK,
        [b's', timing @ ..] if timing.len() == 4 && timing.iter().all(u8::is_ascii_hexdigit) => OK,
        b"V" => b"V1013\r",
        b"N" => b"NA001\r",
        b"F" => b"F00\r",
        _ => match decode(text) {
            Some(frame) if *channel == Channel::Open => {
                answer(Answer::Frame(frame));
                if frame.can_id().is_extended() { b"Z\r" } else { b"z\r" }
            }
            _ => ERROR,
        },
    };
    answer(Answer::Reply(reply));
}
