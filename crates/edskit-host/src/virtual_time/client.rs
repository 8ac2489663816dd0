//! The side of a program that takes part in a bus in virtual time of another process.

use super::PROTOCOL;
use super::lines::{Reply, Request, reply};
use crate::address::place;
use crate::{Bus, BusError, Received, SendError};
use edskit_runtime::{Frame, Instant};
use std::collections::VecDeque;
use std::io::{self, BufRead, BufReader, Write};
use std::net::TcpStream;
use std::time::Duration;

/// How long a call of [`Bus::wait`] blocks while others think; it then returns early.
const PATIENCE: Duration = Duration::from_millis(200);

/// How long the greeting may take.
const GREETING: Duration = Duration::from_secs(5);

/// How many frames are handed over in one go; more find no room on the bus either.
const MOST_UNSENT: usize = 64;

/// A participant of a bus in virtual time that another process serves: `edskit run .. --bus virtual`, or a
/// [`VirtualServer`](crate::VirtualServer). The time of this bus is the virtual one, and it moves only within
/// [`Bus::wait`], while everybody waits.
///
/// ```no_run
/// use edskit_host::{Bus, VirtualClient};
/// use edskit_runtime::{Frame, Microseconds};
/// use edskit_types::CanId;
///
/// let mut bus = VirtualClient::connect("127.0.0.1", 29538)?;
/// bus.send(&Frame::new(CanId::NMT, &[1, 0]))?;
/// let end = bus.now() + Microseconds::from_milliseconds(1000);
/// while bus.now() < end {
///     bus.wait(end)?;
///     while let Some(received) = bus.receive()? {
///         println!("{:?}", received);
///     }
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct VirtualClient {
    peer: String,
    stream: BufReader<TcpStream>,
    now: Instant,
    inbox: VecDeque<Received>,
    /// What the server hears with the next wait.
    unsent: VecDeque<Frame>,
    /// A wait that has not ended.
    is_waiting: bool,
    /// The part of a line that has come.
    line: Vec<u8>,
}

impl VirtualClient {
    /// Attaches to the bus at a host and port, usually 29538.
    ///
    /// # Errors
    ///
    /// [`BusError`] says why there is no connection, or who else answers there.
    pub fn connect(host: &str, port: u16) -> Result<Self, BusError> {
        let peer = place(host, port);
        let unreachable = |source| BusError::Unreachable { peer: peer.clone(), source };
        let stream = TcpStream::connect((host, port)).map_err(unreachable)?;
        stream.set_nodelay(true).map_err(unreachable)?;
        stream.set_read_timeout(Some(GREETING)).map_err(unreachable)?;
        let mut stream = BufReader::new(stream);
        let mut greeting = Vec::new();
        let found = match stream.read_until(b'\n', &mut greeting) {
            Ok(_) => String::from_utf8_lossy(&greeting).into_owned(),
            Err(error) if is_time_out(&error) => String::new(),
            Err(error) => return Err(unreachable(error)),
        };
        let Some(Reply::Now(now)) = reply(&found) else {
            let found =
                if found.is_empty() { "nothing".to_owned() } else { format!("{:?}", found.trim_end()) };
            return Err(BusError::OtherProtocol { peer, protocol: PROTOCOL, expected: "`now TIME`", found });
        };
        stream.get_ref().set_read_timeout(Some(PATIENCE)).map_err(unreachable)?;
        let (inbox, unsent, line) = (VecDeque::new(), VecDeque::new(), Vec::new());
        Ok(Self { peer, stream, now, inbox, unsent, is_waiting: false, line })
    }

    fn begin(&mut self, deadline: Instant) -> io::Result<()> {
        let mut bytes = Vec::new();
        for frame in self.unsent.drain(..) {
            Request::Send(frame).write(&mut bytes);
        }
        Request::Wait(deadline.since(self.now)).write(&mut bytes);
        self.is_waiting = true;
        self.stream.get_mut().write_all(&bytes)
    }

    /// Reads to the end of the wait, or returns when nothing has come for a while.
    fn go_on(&mut self) -> Result<(), BusError> {
        while self.is_waiting {
            match self.stream.read_until(b'\n', &mut self.line) {
                Ok(_) if !self.line.ends_with(b"\n") => {
                    return Err(self.gone(io::ErrorKind::UnexpectedEof.into()));
                }
                Ok(_) => {}
                Err(error) if is_time_out(&error) => return Ok(()),
                Err(error) => return Err(self.gone(error)),
            }
            let line = std::mem::take(&mut self.line);
            let text = String::from_utf8_lossy(&line);
            match reply(&text) {
                Some(Reply::Now(now)) => {
                    self.now = now;
                    self.is_waiting = false;
                }
                Some(Reply::Frame(received)) => self.inbox.push_back(received),
                Some(Reply::Refused(frame)) => self.unsent.push_back(frame),
                None => {
                    return Err(BusError::OtherProtocol {
                        peer: self.peer.clone(),
                        protocol: PROTOCOL,
                        expected: "`frame`, `refused` or `now`",
                        found: format!("{:?}", text.trim_end()),
                    });
                }
            }
        }
        Ok(())
    }

    fn gone(&self, source: io::Error) -> BusError {
        BusError::Gone { peer: self.peer.clone(), source }
    }
}

impl Bus for VirtualClient {
    fn now(&self) -> Instant {
        self.now
    }

    fn receive(&mut self) -> Result<Option<Received>, BusError> {
        Ok(self.inbox.pop_front())
    }

    /// The frame goes with the next [`Bus::wait`], before any time passes.
    fn send(&mut self, frame: &Frame) -> Result<(), SendError> {
        if self.unsent.len() >= MOST_UNSENT {
            return Err(SendError::Full);
        }
        self.unsent.push_back(*frame);
        Ok(())
    }

    fn wait(&mut self, deadline: Instant) -> Result<(), BusError> {
        if !self.inbox.is_empty() {
            return Ok(());
        }
        if !self.is_waiting {
            self.begin(deadline).map_err(|error| self.gone(error))?;
        }
        self.go_on()
    }
}

fn is_time_out(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut)
}
