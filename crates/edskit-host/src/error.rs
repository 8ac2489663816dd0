//! What can go wrong with a bus.

use crate::AddressError;
use std::io;
use thiserror::Error;

/// Why a bus cannot be opened, or is gone.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum BusError {
    /// The address is not one.
    #[error(transparent)]
    Address(#[from] AddressError),
    /// No host of that name.
    #[error("no address is known for the host of {peer}: {source}")]
    UnknownHost {
        /// Host and port.
        peer: String,
        /// What the resolver says.
        source: io::Error,
    },
    /// Nobody takes the connection.
    #[error("cannot connect to {peer}: {source}{}", hint_on_connecting(.source))]
    Unreachable {
        /// Host and port.
        peer: String,
        /// What the system says.
        source: io::Error,
    },
    /// Whoever takes the connection speaks something else.
    #[error("{peer} takes the connection, but does not speak {protocol}: expected {expected}, got {found}")]
    OtherProtocol {
        /// Host and port.
        peer: String,
        /// The name of the protocol.
        protocol: &'static str,
        /// What it should have said.
        expected: &'static str,
        /// What it said, in a form for people.
        found: String,
    },
    /// The other side speaks the protocol and says no.
    #[error("{peer} refuses to open the channel: {answer}")]
    Refused {
        /// Host and port.
        peer: String,
        /// Its words.
        answer: String,
    },
    /// The other side has ended the connection, and a bus in virtual time cannot be found again as it was.
    #[error("the bus at {peer} is gone: {source}")]
    Gone {
        /// Host and port.
        peer: String,
        /// What the system says.
        source: io::Error,
    },
    /// The bus is one that only a program that runs devices can make.
    #[error(
        "`virtual` is a bus that `edskit run` makes; attach to it with virtual:HOST:PORT, usually virtual:127.0.0.1:29538"
    )]
    NobodyThere,
    /// The hub or the bus in virtual time cannot listen.
    #[error("cannot listen on {address} for {protocol}: {source}{}", hint_on_listening(.source))]
    Listen {
        /// Address and port.
        address: String,
        /// The name of the protocol.
        protocol: &'static str,
        /// What the system says.
        source: io::Error,
    },
    /// An interface of the kernel cannot be opened, or is gone.
    #[error("SocketCAN interface {interface}: {source} (`ip link` lists the interfaces)")]
    Interface {
        /// The name of the interface.
        interface: String,
        /// What the system says.
        source: io::Error,
    },
    /// This build has no SocketCAN.
    #[error(
        "socketcan:{0} needs Linux and a build with the feature `socketcan`; \
         hub, socketcand:HOST:PORT and slcan:HOST:PORT work everywhere"
    )]
    NoSocketCan(String),
    /// The system gives no further thread.
    #[error("cannot start a thread: {0}")]
    Thread(#[source] io::Error),
}

/// Why a frame was not taken for sending.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SendError {
    /// There is no room: frames come faster than the bus takes them. Try again later.
    #[error("the transmit side is full")]
    Full,
    /// The controller has left the bus.
    #[error("the controller is bus-off")]
    BusOff,
    /// The connection is lost and not yet there again.
    #[error("the connection to the bus is lost")]
    Disconnected,
    /// The bus carries no remote frames.
    #[error("socketcand carries no remote frames; use slcan or socketcan")]
    RemoteFrame,
    /// The system refuses.
    #[error("sending failed: {0}")]
    Io(#[from] io::Error),
}

fn hint_on_connecting(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::ConnectionRefused => "; nothing listens there, is the hub running?",
        io::ErrorKind::TimedOut => "; the host does not answer",
        _ => "",
    }
}

fn hint_on_listening(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::AddrInUse => {
            "; perhaps a hub or a device runs there already, attach to it with slcan:HOST:PORT or virtual:HOST:PORT"
        }
        io::ErrorKind::PermissionDenied => "; ports below 1024 are often reserved",
        _ => "",
    }
}
