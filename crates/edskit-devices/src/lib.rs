//! Devices that edskit models: what their parameters mean and what follows from them.
//!
//! The crate is `no_std` and allocates nothing, because the devices run it themselves; the command line runs the same
//! functions over parameter files. Texts for people, files and formats belong to the command line.
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
