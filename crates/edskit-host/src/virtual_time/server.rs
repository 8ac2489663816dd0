//! The side in this process: a bus in virtual time, and the sockets of the programs that take part in it.

use super::PROTOCOL;
use super::conversation::Conversation;
use crate::listener::Listener;
use crate::{BusError, VirtualBus};
use edskit_runtime::Instant;
use std::io::{self, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

/// How many clients are served at a time.
const MOST_CLIENTS: usize = 64;

/// How long the server listens to a client that thinks before its caller gets a turn.
const PATIENCE: Duration = Duration::from_millis(50);

/// How long a client may leave unread what it is told.
const MOST_UNREAD: Duration = Duration::from_secs(5);

/// After how many steps of the time clients that wait are asked whether they are still there.
const STEPS: u32 = 256;

/// A bus in virtual time that other programs take part in, over TCP. Time stands while one of them thinks, so none is ever
/// late, and the same programs always see the same frames at the same times, to the microsecond.
///
/// Each program says how long it waits; while all of them wait, time moves to the earliest of what they and the devices
/// in this process wait for. While nobody is there it stands. `docs/virtual-time.md` describes the protocol.
///
/// Programs are heard one after the other in the order in which they came, so what two of them send at the same time
/// goes over the bus in the same order each time. One that leaves holds nobody up, in the middle of a wait neither, and
/// what it has handed over is still sent. Up to 64 are served at a time; further connections are closed at once. The
/// protocol knows no passwords: whoever reaches the port takes part.
///
/// ```no_run
/// use edskit_host::{MemoryDevice, MemoryStorage, Station, VirtualBus, VirtualServer};
/// use edskit_runtime::{Dictionary, Node, NodeDevice, Settings};
/// use edskit_types::Bitrate;
///
/// fn serve(dictionary: impl Dictionary) -> Result<(), edskit_host::BusError> {
///     let bus = VirtualBus::new(Bitrate::Kbit1000);
///     let mut server = VirtualServer::start(&bus, ([127, 0, 0, 1], 29538).into())?;
///     let node = Node::new(dictionary, Settings::default(), MemoryStorage::default());
///     let device = NodeDevice { node, application: MemoryDevice::default() };
///     let mut station = Station::new(device, bus.attach());
///     loop {
///         let next = station.round()?;
///         server.wait(next);
///     }
/// }
/// ```
pub struct VirtualServer {
    bus: VirtualBus,
    listener: Listener,
    arrivals: Receiver<TcpStream>,
    clients: Vec<Client>,
    steps: u32,
}

impl VirtualServer {
    /// Listens until it is dropped. Programs take part in `bus` while [`VirtualServer::wait`] is called.
    ///
    /// # Errors
    ///
    /// [`BusError::Listen`] where the address cannot be taken, [`BusError::Thread`] where the system has no threads left.
    pub fn start(bus: &VirtualBus, address: SocketAddr) -> Result<Self, BusError> {
        let (sender, arrivals) = mpsc::channel();
        // It fails when the server is gone, and then the connection is closed.
        let listener = Listener::start(address, PROTOCOL, move |stream| drop(sender.send(stream)))?;
        Ok(Self { bus: bus.clone(), listener, arrivals, clients: Vec::new(), steps: 0 })
    }

    /// Where it listens, with the port that was taken.
    #[must_use]
    pub fn address(&self) -> SocketAddr {
        self.listener.address()
    }

    /// How many programs take part.
    #[must_use]
    pub fn clients(&self) -> usize {
        self.clients.len()
    }

    /// Lets time pass to the next frame that arrives, to the end of a program's wait, or to `deadline`, whichever is
    /// first. Returns early, without any time having passed, where a program thinks for more than 50 ms or nobody is
    /// there: the caller may then look after other things, and calls it again.
    ///
    /// Whatever acts on the bus in this process acts before this is called, and again when it returns.
    pub fn wait(&mut self, deadline: Instant) {
        self.admit();
        self.clients.retain_mut(Client::look);
        let Some(end) = self.hear() else { return };
        if !self.clients.is_empty() {
            self.bus.step(deadline.min(end));
            self.steps = (self.steps + 1) % STEPS;
            if self.steps == 0 {
                self.clients.retain(Client::is_there);
            }
        } else if let Ok(stream) = self.arrivals.recv_timeout(PATIENCE) {
            self.clients.extend(Client::welcome(&self.bus, stream));
        }
    }

    fn admit(&mut self) {
        while let Ok(stream) = self.arrivals.try_recv() {
            if self.clients.len() < MOST_CLIENTS {
                self.clients.extend(Client::welcome(&self.bus, stream));
            }
        }
    }

    /// Listens to each client until it waits; `None` where one goes on thinking, else the earliest end of a wait.
    fn hear(&mut self) -> Option<Instant> {
        let mut end = Instant::NEVER;
        let mut place = 0;
        while let Some(client) = self.clients.get_mut(place) {
            match client.hear() {
                Heard::Waits(until) => {
                    end = end.min(until);
                    place += 1;
                }
                Heard::Thinks => return None,
                Heard::Gone => drop(self.clients.remove(place)),
            }
        }
        Some(end)
    }
}

/// What a client does now.
enum Heard {
    Waits(Instant),
    Thinks,
    Gone,
}

/// A conversation and its socket.
struct Client {
    stream: TcpStream,
    conversation: Conversation,
}

impl Client {
    /// Greets; `None` where the client is gone already.
    fn welcome(bus: &VirtualBus, stream: TcpStream) -> Option<Self> {
        stream.set_nodelay(true).ok()?;
        stream.set_read_timeout(Some(PATIENCE)).ok()?;
        stream.set_write_timeout(Some(MOST_UNREAD)).ok()?;
        let mut client = Self { stream, conversation: Conversation::new(bus) };
        client.say().ok()?;
        Some(client)
    }

    /// Ends the wait where it is over. Says whether the client is still there.
    fn look(&mut self) -> bool {
        self.conversation.look();
        self.say().is_ok()
    }

    /// Listens until the client waits, but not for long.
    fn hear(&mut self) -> Heard {
        let mut bytes = [0; 4096];
        loop {
            self.conversation.heed();
            if self.say().is_err() {
                return Heard::Gone;
            }
            if let Some(until) = self.conversation.waits_until() {
                return Heard::Waits(until);
            }
            match self.stream.read(&mut bytes) {
                Ok(0) => return Heard::Gone,
                Ok(count) => self.conversation.feed(&bytes[..count]),
                Err(error) => match error.kind() {
                    io::ErrorKind::Interrupted => {}
                    io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut => return Heard::Thinks,
                    _ => return Heard::Gone,
                },
            }
        }
    }

    fn say(&mut self) -> io::Result<()> {
        let output = self.conversation.take_output();
        if output.is_empty() { Ok(()) } else { self.stream.write_all(&output) }
    }

    /// Whether the connection stands; what the client has said meanwhile stays to be read.
    fn is_there(&self) -> bool {
        let peek = || {
            self.stream.set_nonblocking(true)?;
            let count = self.stream.peek(&mut [0]);
            self.stream.set_nonblocking(false)?;
            count
        };
        match peek() {
            Ok(count) => count > 0,
            Err(error) => error.kind() == io::ErrorKind::WouldBlock,
        }
    }
}
