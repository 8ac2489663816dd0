//! Taking connections for one protocol.

use super::board::Board;
use super::dialect::Dialect;
use super::session::Session;
use crate::BusError;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// How long to rest where the system cannot give a connection, for lack of file handles say.
const REST: Duration = Duration::from_millis(50);

/// A socket that listens, and the thread that serves it.
pub(super) struct Listener {
    address: SocketAddr,
    is_stopping: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Listener {
    pub(super) fn start(
        address: SocketAddr,
        protocol: &'static str,
        board: &Arc<Board>,
        dialect: fn() -> Box<dyn Dialect>,
    ) -> Result<Self, BusError> {
        let fail = |source| BusError::Listen { address: address.to_string(), protocol, source };
        let socket = TcpListener::bind(address).map_err(fail)?;
        let address = socket.local_addr().map_err(fail)?;
        let is_stopping = Arc::new(AtomicBool::new(false));
        let (board, stop) = (Arc::clone(board), Arc::clone(&is_stopping));
        let thread = thread::Builder::new()
            .name(format!("hub {protocol}"))
            .spawn(move || serve(&socket, &board, dialect, &stop))
            .map_err(BusError::Thread)?;
        Ok(Self { address, is_stopping, thread: Some(thread) })
    }

    pub(super) fn address(&self) -> SocketAddr {
        self.address
    }
}

impl Drop for Listener {
    fn drop(&mut self) {
        self.is_stopping.store(true, Ordering::Release);
        // The thread waits for a connection, so it gets one.
        let woken = TcpStream::connect_timeout(&reachable(self.address), Duration::from_secs(1));
        if let (Ok(_), Some(thread)) = (woken, self.thread.take()) {
            // It ends by itself; if it has panicked there is nothing more to end.
            let _ = thread.join();
        }
    }
}

/// Takes connections until the listener is dropped; then ends the sessions.
fn serve(socket: &TcpListener, board: &Arc<Board>, dialect: fn() -> Box<dyn Dialect>, stop: &AtomicBool) {
    let mut sessions: Vec<Session> = Vec::new();
    loop {
        let connection = socket.accept();
        if stop.load(Ordering::Acquire) {
            return;
        }
        sessions.retain(|session| !session.is_over());
        match connection {
            Ok((stream, _)) => sessions.extend(Session::start(stream, board, dialect())),
            Err(_) => thread::sleep(REST),
        }
    }
}

/// Where a listening socket can be reached: one that takes every address, on loopback.
fn reachable(address: SocketAddr) -> SocketAddr {
    let ip = match address.ip() {
        IpAddr::V4(ip) if ip.is_unspecified() => Ipv4Addr::LOCALHOST.into(),
        IpAddr::V6(ip) if ip.is_unspecified() => Ipv6Addr::LOCALHOST.into(),
        ip => ip,
    };
    SocketAddr::new(ip, address.port())
}
