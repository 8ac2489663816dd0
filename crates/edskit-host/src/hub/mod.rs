//! A bus in this process that other tools attach to.

mod board;
mod dialect;
mod participant;
mod session;
#[cfg(test)]
pub(crate) mod testing;

pub(crate) use dialect::{Answer, Dialect};
pub use participant::HubParticipant;

use crate::listener::Listener;
use crate::{BusError, slcan, socketcand};
use board::Board;
use session::Session;
use std::net::{Ipv4Addr, SocketAddr, TcpStream};
use std::sync::Arc;

/// Where a hub listens. The default is loopback with the usual ports: 29536 for socketcand, 29537 for SLCAN.
///
/// The protocols know no passwords: whoever reaches the ports takes part in the bus.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct HubOptions {
    /// Where to listen for socketcand, or not at all. Port 0 takes a free one.
    pub socketcand: Option<SocketAddr>,
    /// Where to listen for SLCAN, or not at all. Port 0 takes a free one.
    pub slcan: Option<SocketAddr>,
}

impl HubOptions {
    /// Loopback with free ports, for tests.
    #[must_use]
    pub fn with_free_ports() -> Self {
        Self { socketcand: Some(loopback(0)), slcan: Some(loopback(0)) }
    }
}

impl Default for HubOptions {
    fn default() -> Self {
        Self { socketcand: Some(loopback(29536)), slcan: Some(loopback(29537)) }
    }
}

fn loopback(port: u16) -> SocketAddr {
    (Ipv4Addr::LOCALHOST, port).into()
}

/// What serves the clients of one protocol, each in a session that ends with this.
fn sessions(board: &Arc<Board>, dialect: fn() -> Box<dyn Dialect>) -> impl FnMut(TcpStream) + Send + use<> {
    let (board, mut sessions) = (Arc::clone(board), Vec::new());
    move |stream| {
        sessions.retain(|session: &Session| !session.is_over());
        sessions.extend(Session::start(stream, &board, dialect()));
    }
}

/// A bus that tools attach to over TCP, with socketcand or SLCAN, and this process with [`Hub::attach`]. Every frame of one
/// participant reaches all others, in one order for all, at once: a hub has no bit rate.
///
/// Each participant has a queue of 32,768 frames. Where it does not take them, the oldest are dropped and counted
/// ([`Hub::frames_lost`]); memory stays bounded (about 1 MB for each). Up to 64 clients are served at a time; further
/// connections are closed at once.
///
/// Remote frames do not reach clients that speak socketcand, whose protocol has none. python-can writes a remote frame as
/// a data frame without data; with a length other than 0 it contradicts itself and is ignored.
///
/// Dropping the hub ends all connections and threads. Handles from [`Hub::attach`] still reach each other then.
///
/// ```no_run
/// use edskit_host::{Bus, Hub, HubOptions};
/// use edskit_runtime::Instant;
///
/// let hub = Hub::start(&HubOptions::default())?;
/// let mut device = hub.attach();
/// loop {
///     device.wait(Instant::NEVER)?;
///     while let Some(received) = device.receive()? {
///         let _ = received.frame;
///     }
/// }
/// # Ok::<(), edskit_host::BusError>(())
/// ```
pub struct Hub {
    board: Arc<Board>,
    socketcand: Option<Listener>,
    slcan: Option<Listener>,
}

impl Hub {
    /// Listens and serves until the hub is dropped.
    ///
    /// # Errors
    ///
    /// [`BusError::Listen`] where an address cannot be taken, [`BusError::Thread`] where the system has no threads left.
    pub fn start(options: &HubOptions) -> Result<Self, BusError> {
        let board = Arc::new(Board::default());
        let mut hub = Self { board: Arc::clone(&board), socketcand: None, slcan: None };
        if let Some(address) = options.socketcand {
            let dialect = || Box::new(socketcand::Server::default()) as Box<dyn Dialect>;
            hub.socketcand = Some(Listener::start(address, "socketcand", sessions(&board, dialect))?);
        }
        if let Some(address) = options.slcan {
            let dialect = || Box::new(slcan::Server::default()) as Box<dyn Dialect>;
            hub.slcan = Some(Listener::start(address, "SLCAN", sessions(&board, dialect))?);
        }
        Ok(hub)
    }

    /// Where socketcand is spoken, with the port that was taken.
    #[must_use]
    pub fn socketcand_address(&self) -> Option<SocketAddr> {
        self.socketcand.as_ref().map(Listener::address)
    }

    /// Where SLCAN is spoken, with the port that was taken.
    #[must_use]
    pub fn slcan_address(&self) -> Option<SocketAddr> {
        self.slcan.as_ref().map(Listener::address)
    }

    /// A participant in this process, a device say.
    #[must_use]
    pub fn attach(&self) -> HubParticipant {
        HubParticipant::new(&self.board)
    }

    /// How many clients are connected.
    #[must_use]
    pub fn clients(&self) -> usize {
        self.board.clients()
    }

    /// How many frames have been dropped because participants did not take them in time, of all together.
    #[must_use]
    pub fn frames_lost(&self) -> u64 {
        self.board.frames_lost()
    }
}
