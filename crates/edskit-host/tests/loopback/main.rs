//! The hub and the clients over loopback.

mod client;
mod hub;
mod tool;
