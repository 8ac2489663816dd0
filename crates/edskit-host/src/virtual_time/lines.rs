//! The protocol: lines of ASCII, each ended by a line feed.

use crate::Received;
use edskit_runtime::{Frame, Instant, MOST_DATA, Microseconds};
use edskit_types::CanId;
use std::fmt;
use std::io::Write;

/// The longest line that is understood. The longest useful one is a wait of 20 digits: 25 characters.
const MOST: usize = 64;

/// What a client asks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Request {
    /// `send ID DATA`: the frame is handed over for sending.
    Send(Frame),
    /// `wait MICROSECONDS`: time may pass.
    Wait(Microseconds),
}

/// What the server says.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Reply {
    /// `now TIME`: the greeting, or the end of a wait.
    Now(Instant),
    /// `frame TIME ID DATA`: a frame has arrived.
    Frame(Received),
    /// `refused send ID DATA`: a frame has found no room.
    Refused(Frame),
}

/// Why a line is none, in words for the one who wrote it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Mistake {
    TooLong,
    Unknown,
    Identifier,
    Data,
    Time,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLong => write!(f, "a line has up to {MOST} characters"),
            Self::Unknown => f.write_str("expected `send ID DATA` or `wait MICROSECONDS`"),
            Self::Identifier => f.write_str(
                "an identifier has 3 hexadecimal digits (000 to 7FF), or 8 in an extended frame (up to 1FFFFFFF)",
            ),
            Self::Data => f.write_str(
                "data are up to 8 bytes of two hexadecimal digits without blanks, or R and the length of a remote frame \
                 (R0 to R8)",
            ),
            Self::Time => f.write_str("a time is a whole number of microseconds"),
        }
    }
}

/// Understands a line without its end.
pub(super) fn request(line: &[u8]) -> Result<Request, Mistake> {
    let line = std::str::from_utf8(line).map_err(|_| Mistake::Unknown)?;
    let mut words = line.split_ascii_whitespace();
    let request = match words.next() {
        Some("send") => {
            let id = words.next().and_then(identifier).ok_or(Mistake::Identifier)?;
            Request::Send(frame(id, words.next().unwrap_or_default()).ok_or(Mistake::Data)?)
        }
        Some("wait") => Request::Wait(Microseconds(words.next().and_then(number).ok_or(Mistake::Time)?)),
        _ => return Err(Mistake::Unknown),
    };
    match (words.next(), request) {
        (None, _) => Ok(request),
        (Some(_), Request::Send(_)) => Err(Mistake::Data),
        (Some(_), Request::Wait(_)) => Err(Mistake::Time),
    }
}

/// Understands a line of the server; `None` for an error, and for what is no line of this protocol.
pub(super) fn reply(line: &str) -> Option<Reply> {
    let mut words = line.split_ascii_whitespace();
    let reply = match words.next()? {
        "now" => Reply::Now(Instant(number(words.next()?)?)),
        "frame" => {
            let time = Instant(number(words.next()?)?);
            let id = identifier(words.next()?)?;
            Reply::Frame(Received { time, frame: frame(id, words.next().unwrap_or_default())? })
        }
        "refused" if words.next() == Some("send") => {
            let id = identifier(words.next()?)?;
            Reply::Refused(frame(id, words.next().unwrap_or_default())?)
        }
        _ => return None,
    };
    words.next().is_none().then_some(reply)
}

/// `ID`, and ` DATA` where there is any. Writing to memory does not fail.
fn write_frame(frame: &Frame, out: &mut Vec<u8>) {
    let width = if frame.can_id().is_extended() { 8 } else { 3 };
    let _ = write!(out, "{:0width$X}", frame.can_id().raw());
    if frame.is_remote() {
        let _ = write!(out, " R{}", frame.length());
    } else if !frame.data().is_empty() {
        out.push(b' ');
        for byte in frame.data() {
            let _ = write!(out, "{byte:02X}");
        }
    }
    out.push(b'\n');
}

impl Request {
    pub(super) fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Send(frame) => {
                out.extend_from_slice(b"send ");
                write_frame(frame, out);
            }
            Self::Wait(time) => {
                let _ = writeln!(out, "wait {}", time.0);
            }
        }
    }
}

impl Reply {
    pub(super) fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Now(time) => {
                let _ = writeln!(out, "now {}", time.0);
            }
            Self::Frame(Received { time, frame }) => {
                let _ = write!(out, "frame {} ", time.0);
                write_frame(frame, out);
            }
            Self::Refused(frame) => {
                out.extend_from_slice(b"refused send ");
                write_frame(frame, out);
            }
        }
    }
}

/// `error TEXT`, for the author of a line.
pub(super) fn write_error(text: impl fmt::Display, out: &mut Vec<u8>) {
    let _ = writeln!(out, "error {text}");
}

fn identifier(word: &str) -> Option<CanId> {
    let id = hexadecimal(word)?;
    match word.len() {
        3 => CanId::standard(u16::try_from(id).ok()?),
        8 => CanId::extended(id),
        _ => None,
    }
}

fn frame(id: CanId, data: &str) -> Option<Frame> {
    if let Some(length) = data.strip_prefix(['R', 'r']) {
        let length = length.parse().ok().filter(|length| usize::from(*length) <= MOST_DATA)?;
        return (data.len() == 2).then(|| Frame::remote(id, length));
    }
    let mut bytes = [0; MOST_DATA];
    let pairs = data.as_bytes().chunks(2);
    let used = bytes.get_mut(..pairs.len())?;
    for (place, pair) in used.iter_mut().zip(pairs) {
        let pair = std::str::from_utf8(pair).ok().filter(|pair| pair.len() == 2)?;
        *place = u8::try_from(hexadecimal(pair)?).ok()?;
    }
    Some(Frame::new(id, used))
}

/// Digits alone: `from_str_radix` would take a sign.
fn hexadecimal(word: &str) -> Option<u32> {
    let is_plain = word.bytes().all(|byte| byte.is_ascii_hexdigit());
    is_plain.then(|| u32::from_str_radix(word, 16).ok()).flatten()
}

fn number(word: &str) -> Option<u64> {
    word.bytes().all(|byte| byte.is_ascii_digit()).then(|| word.parse().ok()).flatten()
}

/// Cuts a stream of bytes into lines, and keeps what has not been asked for.
#[derive(Default)]
pub(super) struct Lines {
    bytes: Vec<u8>,
    /// How many of the bytes have been given already.
    taken: usize,
    /// The line under way is too long; the rest of it is passed over.
    is_too_long: bool,
}

impl Lines {
    pub(super) fn feed(&mut self, bytes: &[u8]) {
        self.bytes.drain(..self.taken);
        self.taken = 0;
        self.bytes.extend_from_slice(bytes);
    }

    /// The request in the next whole line, or what is wrong with it; empty lines say nothing.
    pub(super) fn next(&mut self) -> Option<Result<Request, Mistake>> {
        loop {
            let rest = &self.bytes[self.taken..];
            let Some(length) = rest.iter().position(|byte| *byte == b'\n') else {
                if rest.len() > MOST {
                    self.is_too_long = true;
                    self.taken = self.bytes.len();
                }
                return None;
            };
            let line = &rest[..length];
            self.taken += length + 1;
            if std::mem::take(&mut self.is_too_long) || length > MOST {
                return Some(Err(Mistake::TooLong));
            }
            if !line.trim_ascii().is_empty() {
                return Some(request(line));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn standard(id: u16, data: &[u8]) -> Frame {
        Frame::new(CanId::standard(id).unwrap(), data)
    }

    #[test]
    fn requests() {
        let extended = |id| CanId::extended(id).unwrap();
        let requests = [
            ("send 605 4000100000000000", Request::Send(standard(0x605, &[0x40, 0, 0x10, 0, 0, 0, 0, 0]))),
            ("send 7ff abCD\r", Request::Send(standard(0x7FF, &[0xAB, 0xCD]))),
            ("send 080", Request::Send(standard(0x80, &[]))),
            ("send 705 R1", Request::Send(Frame::remote(CanId::standard(0x705).unwrap(), 1))),
            ("send 00000605 01", Request::Send(Frame::new(extended(0x605), &[1]))),
            ("send 1FFFFFFF r8", Request::Send(Frame::remote(extended(0x1FFF_FFFF), 8))),
            ("wait 0", Request::Wait(Microseconds(0))),
            (" wait  18446744073709551615 ", Request::Wait(Microseconds(u64::MAX))),
        ];
        for (line, wanted) in requests {
            assert_eq!(request(line.as_bytes()), Ok(wanted), "{line}");
        }
    }

    #[test]
    fn mistakes() {
        let mistakes = [
            ("hello", Mistake::Unknown),
            ("WAIT 5", Mistake::Unknown),
            ("now 5", Mistake::Unknown),
            ("send", Mistake::Identifier),
            ("send 5", Mistake::Identifier),
            ("send 800 01", Mistake::Identifier),
            ("send 20000000 01", Mistake::Identifier),
            ("send +05 01", Mistake::Identifier),
            ("send 605 1", Mistake::Data),
            ("send 605 010", Mistake::Data),
            ("send 605 01 02", Mistake::Data),
            ("send 605 010203040506070809", Mistake::Data),
            ("send 605 0g", Mistake::Data),
            ("send 605 +1", Mistake::Data),
            ("send 605 R", Mistake::Data),
            ("send 605 R9", Mistake::Data),
            ("send 605 R01", Mistake::Data),
            ("send 605 \u{e4}\u{f6}", Mistake::Data),
            ("wait", Mistake::Time),
            ("wait -1", Mistake::Time),
            ("wait 1.5", Mistake::Time),
            ("wait 18446744073709551616", Mistake::Time),
            ("wait 5 6", Mistake::Time),
        ];
        for (line, wanted) in mistakes {
            assert_eq!(request(line.as_bytes()), Err(wanted), "{line}");
        }
        assert_eq!(request(b"\xFF"), Err(Mistake::Unknown));
    }

    #[test]
    fn a_line_that_is_too_long_is_one_mistake_and_takes_no_memory() {
        let mut lines = Lines::default();
        for _ in 0..1000 {
            lines.feed(&[b'x'; 4096]);
            assert_eq!(lines.next(), None);
        }
        lines.feed(b"x\n\nwait 5\n");
        assert!(lines.bytes.len() < 100);
        assert_eq!(lines.next(), Some(Err(Mistake::TooLong)));
        assert_eq!(lines.next(), Some(Ok(Request::Wait(Microseconds(5)))));
        assert_eq!(lines.next(), None);
    }

    fn any_frame() -> impl Strategy<Value = Frame> {
        let data = proptest::collection::vec(any::<u8>(), 0..=8);
        (0u32..0x2000_0000, any::<bool>(), any::<bool>(), data).prop_map(
            |(id, is_extended, is_remote, data)| {
                let id = if is_extended {
                    CanId::extended(id).unwrap()
                } else {
                    CanId::standard((id & 0x7FF) as u16).unwrap()
                };
                if is_remote { Frame::remote(id, data.len() as u8) } else { Frame::new(id, &data) }
            },
        )
    }

    proptest! {
        #[test]
        fn what_is_written_is_read_again(sent in any_frame(), time: u64, cut in 0usize..60) {
            let mut bytes = Vec::new();
            Request::Send(sent).write(&mut bytes);
            Request::Wait(Microseconds(time)).write(&mut bytes);
            let mut lines = Lines::default();
            let (first, second) = bytes.split_at(cut.min(bytes.len()));
            let mut read = Vec::new();
            for piece in [first, second] {
                lines.feed(piece);
                read.extend(std::iter::from_fn(|| lines.next()));
            }
            prop_assert_eq!(read, [Ok(Request::Send(sent)), Ok(Request::Wait(Microseconds(time)))]);

            let received = Received { time: Instant(time), frame: sent };
            for wanted in [Reply::Now(Instant(time)), Reply::Frame(received), Reply::Refused(sent)] {
                let mut bytes = Vec::new();
                wanted.write(&mut bytes);
                prop_assert_eq!(reply(std::str::from_utf8(&bytes).unwrap()), Some(wanted));
            }
        }

        #[test]
        fn nothing_is_too_strange(bytes: Vec<u8>) {
            let mut lines = Lines::default();
            lines.feed(&bytes);
            let line_feeds = bytes.iter().filter(|byte| **byte == b'\n').count();
            prop_assert!(std::iter::from_fn(|| lines.next()).count() <= line_feeds);
            let _ = reply(&String::from_utf8_lossy(&bytes));
        }
    }
}
