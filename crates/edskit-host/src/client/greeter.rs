//! The first words on a connection.

use crate::BusError;
use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// How long the other side may take for its first words.
const PATIENCE: Duration = Duration::from_secs(3);

/// The longest word of a handshake, with room for an error text.
const MOST: usize = 256;

/// A connection during its handshake. It reads byte by byte, so that nothing behind the handshake is lost.
pub(crate) struct Greeter<'a> {
    stream: &'a TcpStream,
    peer: &'a str,
    deadline: Instant,
}

impl<'a> Greeter<'a> {
    pub(super) fn new(stream: &'a TcpStream, peer: &'a str) -> Self {
        Self { stream, peer, deadline: Instant::now() + PATIENCE }
    }

    pub(crate) fn say(&mut self, words: &[u8]) -> Result<(), BusError> {
        self.stream.write_all(words).map_err(|source| self.unreachable(source))
    }

    /// What the other side says, up to and with one of the bytes `ends`.
    pub(crate) fn hear(
        &mut self,
        protocol: &'static str,
        expected: &'static str,
        ends: &[u8],
    ) -> Result<Vec<u8>, BusError> {
        let mut found = Vec::new();
        while found.len() < MOST && !found.last().is_some_and(|byte| ends.contains(byte)) {
            let rest = self.deadline.saturating_duration_since(Instant::now()).max(Duration::from_millis(1));
            self.stream.set_read_timeout(Some(rest)).map_err(|source| self.unreachable(source))?;
            let mut byte = [0];
            match self.stream.read(&mut byte) {
                Ok(1..) => found.extend_from_slice(&byte),
                Ok(0) => return Err(self.other_protocol(protocol, expected, &found)),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) if is_timeout(&error) => {
                    return Err(self.other_protocol(protocol, expected, &found));
                }
                Err(error) => return Err(self.unreachable(error)),
            }
        }
        Ok(found)
    }

    pub(crate) fn other_protocol(
        &self,
        protocol: &'static str,
        expected: &'static str,
        found: &[u8],
    ) -> BusError {
        let found =
            if found.is_empty() { "nothing".to_owned() } else { format!("`{}`", found.escape_ascii()) };
        BusError::OtherProtocol { peer: self.peer.to_owned(), protocol, expected, found }
    }

    pub(crate) fn refused(&self, answer: &str) -> BusError {
        // What the other side says may hold anything.
        let answer = answer.escape_debug().to_string();
        BusError::Refused { peer: self.peer.to_owned(), answer }
    }

    fn unreachable(&self, source: io::Error) -> BusError {
        BusError::Unreachable { peer: self.peer.to_owned(), source }
    }
}

/// Systems differ in what they call it.
pub(super) fn is_timeout(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut)
}
