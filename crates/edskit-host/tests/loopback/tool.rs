//! What the tests over loopback share.

use edskit_host::{Bus, Hub, HubOptions, Received, system_now};
use edskit_runtime::{Frame, Instant, Microseconds};
use edskit_types::CanId;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::Duration;

/// Long enough for a machine that has much else to do.
pub(crate) fn patience() -> Instant {
    system_now() + Microseconds::from_milliseconds(20_000)
}

pub(crate) fn hub() -> Hub {
    Hub::start(&HubOptions::with_free_ports()).expect("there are free ports")
}

pub(crate) fn frame(id: u16, data: &[u8]) -> Frame {
    Frame::new(CanId::standard(id).expect("tests use identifiers of 11 bits"), data)
}

/// The next frame, waited for.
pub(crate) fn next(bus: &mut impl Bus) -> Frame {
    let deadline = patience();
    while system_now() < deadline {
        if let Some(Received { frame, .. }) = bus.receive().expect("the bus stays") {
            return frame;
        }
        bus.wait(deadline).expect("the bus stays");
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
pub(crate) struct Tool(BufReader<TcpStream>);

impl Tool {
    pub(crate) fn new(address: Option<SocketAddr>) -> Self {
        let stream =
            TcpStream::connect(address.expect("the hub listens")).expect("the hub takes connections");
        stream.set_read_timeout(Some(Duration::from_secs(20))).expect("20 s is a time");
        Self(BufReader::new(stream))
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
        self.0.get_mut().write_all(words.as_bytes()).expect("the hub reads");
    }

    /// What one read gives.
    pub(crate) fn read_once(&mut self) -> String {
        let bytes = self.0.fill_buf().expect("the hub writes");
        let (text, count) = (String::from_utf8_lossy(bytes).into_owned(), bytes.len());
        self.0.consume(count);
        text
    }

    /// Reads until the hub ends the connection.
    pub(crate) fn hear_the_end(mut self) {
        // A reset is an end too.
        let _ = self.0.read_to_end(&mut Vec::new());
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
