//! Taking connections for one protocol.

use crate::BusError;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// How long to rest where the system cannot give a connection, for lack of file handles say.
const REST: Duration = Duration::from_millis(50);

/// A socket that listens, and the thread that takes its connections.
pub(crate) struct Listener {
    address: SocketAddr,
    is_stopping: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Listener {
    /// Gives each connection to `take`, which is dropped with the listener.
    pub(crate) fn start(
        address: SocketAddr,
        protocol: &'static str,
        take: impl FnMut(TcpStream) + Send + 'static,
    ) -> Result<Self, BusError> {
        let fail = |source| BusError::Listen { address: address.to_string(), protocol, source };
        let socket = TcpListener::bind(address).map_err(fail)?;
        let address = socket.local_addr().map_err(fail)?;
        let is_stopping = Arc::new(AtomicBool::new(false));
        let stop = Arc::clone(&is_stopping);
        let thread = thread::Builder::new()
            .name(format!("listening for {protocol}"))
            .spawn(move || serve(&socket, &stop, take))
            .map_err(BusError::Thread)?;
        Ok(Self { address, is_stopping, thread: Some(thread) })
    }

    pub(crate) fn address(&self) -> SocketAddr {
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

/// Takes connections until the listener is dropped.
fn serve(socket: &TcpListener, stop: &AtomicBool, mut take: impl FnMut(TcpStream)) {
    loop {
        let connection = socket.accept();
        if stop.load(Ordering::Acquire) {
            return;
        }
        match connection {
            Ok((stream, _)) => take(stream),
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
