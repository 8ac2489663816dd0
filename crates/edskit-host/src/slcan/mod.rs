//! The protocol of SLCAN adapters (LAWICEL), here over TCP: lines that end in a carriage return.

mod client;
mod lines;
mod notation;
mod server;

pub(crate) use client::handshake;
pub(crate) use lines::{Line, Lines};
pub(crate) use notation::{decode, encode};
pub(crate) use server::Server;

#[cfg(test)]
mod tests;
