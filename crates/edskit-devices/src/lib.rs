//! Devices that edskit models: what their parameters mean, what follows from them, and the live devices themselves.
//!
//! The crate is `no_std` and allocates nothing: what runs on a computer can run on a microcontroller. The command line runs
//! the same functions over parameter files. Files and formats belong to the command line.
//!
//! | device | module |
//! |---|---|
//! | Heinzmann CANopen gateway for digital governors | [`gateway`] |
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(test)]
extern crate std;

pub mod gateway;
