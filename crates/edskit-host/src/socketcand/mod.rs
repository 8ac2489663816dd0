//! The protocol of the socketcand daemon in raw mode: commands in angle brackets over TCP.

mod client;
mod commands;
mod server;

pub(crate) use client::{decode, encode, handshake};
pub(crate) use commands::Commands;
pub(crate) use server::Server;

#[cfg(test)]
mod tests;
