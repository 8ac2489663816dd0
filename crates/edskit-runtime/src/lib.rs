//! A CANopen node over an object dictionary.
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(test)]
extern crate std;

mod dictionary;
mod frame;
mod time;

pub use dictionary::{Entry, Flags, Handle, Limits, Objects, Position, StorageGroup, Table, Value};
pub use frame::{Frame, MOST_DATA};
pub use time::{Instant, Microseconds};
