//! A bus in virtual time that programs attach to over TCP: one side in this process, and the other.

mod client;
mod conversation;
mod lines;
mod server;

pub use client::VirtualClient;
pub use server::VirtualServer;

/// The port where a bus in virtual time is looked for if nothing else is said.
pub(crate) const USUAL_PORT: u16 = 29538;

/// What the protocol is called in messages.
pub(crate) const PROTOCOL: &str = "virtual time";
