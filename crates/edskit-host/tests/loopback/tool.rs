//! What the tests over loopback share.

use edskit_host::{Bus, Received, system_now};
use edskit_runtime::{Frame, Instant, Microseconds};
use edskit_types::CanId;
use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::Duration;

/// Long enough for a machine that has much else to do.
pub(crate) fn patience() -> Instant {
    system_now() + Microseconds::from_milliseconds(10_000)
}

pub(crate) fn frame(id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(id).unwrap(), data)
}

/// The next frame, waited for.
pub(crate) fn next(bus: &mut impl Bus) -> Frame {
    let deadline = patience();
    while system_now() < deadline {
        if let Some(Received { frame, .. }) = bus.receive().unwrap() {
            return frame;
        }
        bus.wait(deadline).unwrap();
    }
    panic!("no frame has come");
}

pub(crate) fn until(what: &str, mut is_so: impl FnMut() -> bool) {
    let deadline = patience();
    while !is_so() {
        assert!(system_now() < deadline, "waited in vain: {what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// A tool that speaks to the hub byte by byte.
pub(crate) struct Tool(pub(crate) TcpStream);

impl Tool {
    pub(crate) fn new(address: Option<SocketAddr>) -> Self {
        let stream = TcpStream::connect(address.unwrap()).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
        Self(stream)
    }

    /// As python-can shakes hands: one read for each word, compared exactly.
    pub(crate) fn socketcand(address: Option<SocketAddr>) -> Self {
        let mut tool = Self::new(address);
        assert_eq!(tool.read_once(), "< hi >");
        tool.say("< open can0 >");
        assert_eq!(tool.read_once(), "< ok >");
        tool.say("< rawmode >");
        assert_eq!(tool.read_once(), "< ok >");
        tool
    }

    pub(crate) fn slcan(address: Option<SocketAddr>) -> Self {
        let mut tool = Self::new(address);
        tool.say("O\r");
        assert_eq!(tool.hear("\r"), "\r");
        tool
    }

    pub(crate) fn say(&mut self, words: &str) {
        self.0.write_all(words.as_bytes()).unwrap();
    }

    /// What one read gives.
    pub(crate) fn read_once(&mut self) -> String {
        let mut bytes = [0; 256];
        let count = self.0.read(&mut bytes).unwrap();
        String::from_utf8_lossy(&bytes[..count]).into_owned()
    }

    /// What comes until `end`, with it.
    pub(crate) fn hear(&mut self, end: &str) -> String {
        let mut heard = String::new();
        while !heard.ends_with(end) {
            let mut byte = [0];
            self.0.read_exact(&mut byte).unwrap_or_else(|error| panic!("{error} after {heard:?}"));
            heard.push(char::from(byte[0]));
        }
        heard
    }
}
