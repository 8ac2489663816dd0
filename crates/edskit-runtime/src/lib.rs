//! A CANopen node over an object dictionary.
//!
//! The crate is `no_std`, allocates nothing, holds no `unsafe` code and has no clock: time comes in as an argument. It
//! has every service of a slave in CiA 301 v4.2, and the LSS slave of CiA 305; where a device differs from them, its
//! [`Application`] says so.
//!
//! | idea | items |
//! |---|---|
//! | the node, and what drives it | [`Node`], [`Settings`], [`Frame`], [`Instant`] |
//! | the object dictionary | [`Dictionary`], [`Objects`], [`Handle`], [`Table`], [`Entry`], [`Flags`] |
//! | what a device adds | [`Application`], [`Storage`] |
//! | errors | [`Error`], [`Emergency`] |
//! | what can be asked | [`NotSent`], [`Leds`] |
//! | for SDO clients too | [`Crc`] |
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(test)]
extern crate std;

mod access;
mod application;
mod context;
mod crc;
mod dictionary;
mod emcy;
mod error_behaviour;
mod frame;
mod guarding;
mod heartbeat;
mod led;
mod lss;
mod nmt;
mod node;
mod pdo;
mod queue;
mod sdo;
mod storage;
mod sync;
mod time;
mod time_stamp;

pub use application::{Application, NoApplication, Reset, TimeOfDay};
pub use crc::Crc;
pub use dictionary::{
    Dictionary, Entry, Flags, Handle, Limits, Memory, Objects, Parts, Position, StorageGroup, Table, Value,
};
pub use emcy::{Emergency, Error};
pub use frame::{Frame, MOST_DATA};
pub use heartbeat::HeartbeatConsumer;
pub use led::{Leds, Pattern};
pub use node::{Node, Settings};
pub use pdo::{Mapped, NotSent, Rpdo, Tpdo};
pub use sdo::SdoServer;
pub use storage::{NoStorage, Record, Storage, StorageError};
pub use time::{Instant, Microseconds};

/// The words of CANopen, for generated code.
pub use edskit_types as types;

/// Takes in the object dictionary that `edskit-codegen` has generated from an EDS in the build script.
///
/// The argument is the name of the EDS without its ending. The module is named after it in lower case with underscores:
///
/// ```text
/// // build.rs: fn main() { edskit_codegen::compile("eds/Device.eds"); }
/// edskit_runtime::include_dictionary!("Device");
/// let dictionary = device::Dictionary::new();
/// ```
#[macro_export]
macro_rules! include_dictionary {
    ($name:literal) => {
        include!(concat!(env!("OUT_DIR"), "/", $name, ".rs"));
    };
}

#[cfg(test)]
mod tests;
