//! Keeping a connection.

use super::greeter::{Greeter, is_timeout};
use super::protocol::{Incoming, Protocol};
use crate::address::place;
use crate::queue::{Queue, Refusal};
use crate::{BusError, Event, Received, system_now};
use edskit_runtime::Frame;
use std::convert::Infallible;
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream, ToSocketAddrs};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, TryRecvError};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How many received frames may wait for being taken.
const MOST_UNTAKEN: usize = 32_768;

/// How many frames may wait for being sent.
const MOST_UNSENT: usize = 4096;

/// How many frames go into one segment at most.
const MOST_AT_ONCE: usize = 256;

/// How long one address may take for a connection.
const CONNECTING: Duration = Duration::from_secs(2);

/// How long the other side may leave untaken what was sent before the connection counts as lost.
const STALLED: Duration = Duration::from_secs(5);

/// How long the other side may take to close a connection that this side has finished.
const FAREWELL: Duration = Duration::from_millis(500);

/// The first and the longest pause between attempts.
const PAUSES: (Duration, Duration) = (Duration::from_millis(100), Duration::from_secs(5));

/// What the bus and the thread that keeps the connection both see.
pub(super) struct Shared {
    host: String,
    port: u16,
    pub(super) inbox: Queue<Result<Received, Event>>,
    /// Of the connection that there is.
    outbox: Mutex<Option<Arc<Queue<Frame>>>>,
}

impl Shared {
    pub(super) fn new(host: &str, port: u16) -> Self {
        let outbox = Mutex::new(Some(Arc::new(Queue::new(MOST_UNSENT))));
        Self { host: host.to_owned(), port, inbox: Queue::new(MOST_UNTAKEN), outbox }
    }

    pub(super) fn send(&self, frame: Frame) -> Result<(), Refusal> {
        match &*self.outbox() {
            Some(outbox) => outbox.offer(frame),
            None => Err(Refusal::Closed),
        }
    }

    /// Nothing more is sent than what has been taken. Returns whether there is a connection.
    pub(super) fn finish(&self) -> bool {
        let outbox = self.outbox();
        if let Some(outbox) = &*outbox {
            outbox.close();
        }
        outbox.is_some()
    }

    fn outbox(&self) -> MutexGuard<'_, Option<Arc<Queue<Frame>>>> {
        // A panic elsewhere leaves no half-made change behind.
        self.outbox.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn peer(&self) -> String {
        place(&self.host, self.port)
    }

    /// Makes a connection on which frames go both ways.
    pub(super) fn connect(&self, protocol: &Protocol) -> Result<TcpStream, BusError> {
        let peer = self.peer();
        let unreachable = |source| BusError::Unreachable { peer: peer.clone(), source };
        let addresses = (self.host.as_str(), self.port)
            .to_socket_addrs()
            .map_err(|source| BusError::UnknownHost { peer: peer.clone(), source })?;
        let mut last = io::Error::from(io::ErrorKind::AddrNotAvailable);
        let mut connected = None;
        for address in addresses {
            match TcpStream::connect_timeout(&address, CONNECTING) {
                Ok(stream) => {
                    connected = Some(stream);
                    break;
                }
                Err(error) => last = error,
            }
        }
        let stream = connected.ok_or(last).map_err(unreachable)?;
        stream.set_nodelay(true).map_err(unreachable)?;
        stream.set_write_timeout(Some(STALLED)).map_err(unreachable)?;
        protocol.handshake(&mut Greeter::new(&stream, &peer))?;
        stream.set_read_timeout(None).map_err(unreachable)?;
        Ok(stream)
    }
}

/// Serves the connection, and makes it again when it is lost, until the other end of `stopped` is dropped.
pub(super) fn keep(
    shared: &Shared,
    protocol: &Protocol,
    mut stream: TcpStream,
    stopped: &Receiver<Infallible>,
) {
    let is_stopped = || stopped.try_recv() == Err(TryRecvError::Disconnected);
    loop {
        // It may have been stopped before this connection was there to be finished.
        if is_stopped() {
            shared.finish();
        }
        let reason = converse(shared, protocol, &stream);
        *shared.outbox() = None;
        if is_stopped() {
            return;
        }
        let peer = shared.peer();
        shared.inbox.push(Err(Event::Disconnected { peer: peer.clone(), reason }));
        let mut pause = PAUSES.0;
        stream = loop {
            if stopped.recv_timeout(pause) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            match shared.connect(protocol) {
                Ok(stream) => break stream,
                Err(_) => pause = (2 * pause).min(PAUSES.1),
            }
        };
        *shared.outbox() = Some(Arc::new(Queue::new(MOST_UNSENT)));
        shared.inbox.push(Err(Event::Connected { peer }));
    }
}

/// Reads and writes until the connection ends, and says why it did.
fn converse(shared: &Shared, protocol: &Protocol, stream: &TcpStream) -> String {
    let Some(outbox) = shared.outbox().clone() else { return String::new() };
    let (reading, ended) = mpsc::channel::<Infallible>();
    thread::scope(|scope| {
        let unsent = Arc::clone(&outbox);
        let writer = thread::Builder::new().spawn_scoped(scope, move || {
            let result = write_all(stream, &unsent, protocol.encoder());
            // The other side reads to the end and closes; only where it does not, the connection is cut. Shutting down
            // fails only where that has happened already.
            let _ = stream.shutdown(Shutdown::Write);
            if result.is_ok() {
                let _ = ended.recv_timeout(FAREWELL);
            }
            let _ = stream.shutdown(Shutdown::Both);
            result
        });
        let read = read_all(shared, protocol, stream);
        drop(reading);
        outbox.abort();
        let _ = stream.shutdown(Shutdown::Both);
        let written = match writer {
            Ok(writer) => writer.join().unwrap_or(Ok(())),
            Err(error) => Err(error),
        };
        match (written, read) {
            (Err(error), _) if is_timeout(&error) => {
                format!("the other side has not taken what was sent for {} s", STALLED.as_secs())
            }
            (Err(error), _) | (Ok(()), Err(error)) => error.to_string(),
            (Ok(()), Ok(())) => "closed by the other side".to_owned(),
        }
    })
}

fn read_all(shared: &Shared, protocol: &Protocol, mut stream: &TcpStream) -> io::Result<()> {
    let (mut decoder, mut bytes) = (protocol.decoder(), [0; 4096]);
    loop {
        let count = match stream.read(&mut bytes) {
            Ok(0) => return Ok(()),
            Ok(count) => count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return Err(error),
        };
        let time = system_now();
        decoder.feed(&bytes[..count], |incoming| {
            shared.inbox.push(match incoming {
                Incoming::Frame(frame) => Ok(Received { time, frame }),
                Incoming::ErrorFrame(class) => Err(Event::ErrorFrame(class)),
            });
        });
    }
}

fn write_all(stream: &TcpStream, outbox: &Queue<Frame>, encode: fn(&Frame, &mut Vec<u8>)) -> io::Result<()> {
    let (mut batch, mut bytes) = (Vec::new(), Vec::new());
    loop {
        outbox.take_batch(&mut batch, MOST_AT_ONCE);
        if batch.is_empty() {
            return Ok(());
        }
        for frame in batch.drain(..) {
            encode(&frame, &mut bytes);
        }
        write(stream, &bytes)?;
        bytes.clear();
    }
}

/// Writes all bytes. At its time limit the system reports what it could write and not that it could not write all of it,
/// so that is looked for here.
fn write(mut stream: &TcpStream, mut bytes: &[u8]) -> io::Result<()> {
    while !bytes.is_empty() {
        let start = Instant::now();
        match stream.write(bytes) {
            Ok(count) => bytes = bytes.get(count..).unwrap_or_default(),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
        if !bytes.is_empty() && start.elapsed() >= STALLED {
            return Err(io::ErrorKind::TimedOut.into());
        }
    }
    Ok(())
}
