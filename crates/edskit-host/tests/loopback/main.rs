//! The hub, the bus in virtual time and the clients over loopback.

mod client;
mod hub;
mod tool;
mod virtual_time;
