//! A CANopen node over an object dictionary.
//!
//! The crate is `no_std`, allocates nothing, holds no `unsafe` code and has no clock: time comes in as an argument. It
//! has every service of a slave in CiA 301 v4.2, and the LSS slave of CiA 305; where a device differs from them, its
//! [`Application`] says so.
//!
//! | idea | items |
//! |---|---|
//! | the node, and what drives it | [`Node`], [`Settings`], [`Commissioning`], [`Frame`], [`Instant`] |
//! | the object dictionary | [`Dictionary`], [`Objects`], [`Handle`], [`Constant`], [`Key`], [`Table`], [`Entry`], [`Flags`] |
//! | what a device adds, and does otherwise | [`Application`], [`PdoPolicy`], [`LssRequest`], [`Storage`] |
//! | what it does with the node | [`Services`], [`BusState`] |
//! | what a main loop drives | [`Device`], [`NodeDevice`] |
//! | errors | [`EmcyError`], [`Emergency`] |
//! | what can be asked | [`NotSent`], [`Leds`] |
//! | for SDO clients too | [`Crc`] |
//!
//! # Features
//!
//! Services that a device can do without, all on by default. Where one is off, a client can read its entries, but not write
//! what would need it ([`AbortCode::INVALID_VALUE`](types::AbortCode::INVALID_VALUE)).
//!
//! | feature | what it is | without it |
//! |---|---|---|
//! | `block-transfer` | SDO block transfer | clients get [`AbortCode::UNKNOWN_COMMAND`](types::AbortCode::UNKNOWN_COMMAND), and go on in segments |
//! | `further-sdo-servers` | 1201h to 127Fh | there is the default server |
//! | `guarding` | node guarding and life guarding, 100Ch and 100Dh | remote frames get no answer |
//! | `heartbeat-consumer` | 1016h | no other node is monitored |
//! | `lss` | the LSS slave | LSS gets no answer; [`Settings`] and the [`Application`] say node-ID and bit rate |
//! | `rtr` | remote requests of TPDOs | they get no answer; there are no transmission types FCh and FDh |
//! | `storage` | 1010h, 1011h, [`Services::save`] | nothing is saved, which 1010h says; [`Services::keep`] is there |
//! | `sync` | SYNC, its producer, synchronous PDOs | there are no transmission types 00h to F0h and FCh |
//! | `time` | TIME consumer, 1012h | the message is not taken |
//!
//! # A dictionary
//!
//! A dictionary is generated from an EDS ([`include_dictionary!`]); what comes out is the like of this thermometer:
//!
//! ```
//! use edskit_runtime::types::{AbortCode, CanId, DataType, Index, SubIndex};
//! use edskit_runtime::{
//!     Application, Dictionary, Entry, Flags, Frame, Handle, Instant, Key, Memory, NoStorage, Node, Parts, Position,
//!     Services, Settings, Table,
//! };
//!
//! const VARIABLE: Flags = Flags::READ.and(Flags::VARIABLE);
//!
//! static TABLE: Table = Table {
//!     entries: &[
//!         entry(0x1000, DataType::Unsigned32, Flags::READ, 0, 4), // Device type
//!         entry(0x1017, DataType::Unsigned16, VARIABLE.and(Flags::WRITE), 0, 2), // Producer heartbeat time, ms
//!         entry(0x2000, DataType::Integer16, VARIABLE, 2, 2), // Temperature, 0.1 °C
//!     ],
//!     constants: &[0x94, 0x01, 0x02, 0x00],
//!     defaults: &[0xE8, 0x03, 0x00, 0x00],
//!     limits: &[],
//!     dummies: 0,
//!     fingerprint: 1,
//! };
//! const TEMPERATURE: Handle<i16> = Handle::new(Position(2), Key::new(0x2000, 0));
//!
//! const fn entry(index: u16, data_type: DataType, flags: Flags, offset: u16, size: u16) -> Entry {
//!     Entry { index: Index(index), sub_index: SubIndex(0), data_type, flags, offset, size }
//! }
//!
//! // Four bytes of values, no PDOs, one SDO server with a buffer of eight bytes.
//! struct Thermometer(Memory<4, 0, 0, 0, 1, 0, 8>);
//!
//! impl Dictionary for Thermometer {
//!     fn parts(&mut self) -> Parts<'_> {
//!         self.0.parts(&TABLE)
//!     }
//! }
//!
//! /// The device behind the node.
//! struct Sensor;
//!
//! impl Application for Sensor {
//!     fn before_read(&mut self, node: &mut Services<'_>, entry: &Entry) -> Result<(), AbortCode> {
//!         if entry.is(TEMPERATURE) {
//!             node.objects.set(TEMPERATURE, 215);
//!         }
//!         Ok(())
//!     }
//! }
//!
//! let dictionary = Thermometer(Memory::new([0xE8, 0x03, 0x00, 0x00]));
//! let mut node = Node::new(dictionary, Settings::default(), NoStorage);
//! node.poll(Instant(0), &mut Sensor);
//! let boot_up = node.transmit().unwrap();
//! assert_eq!((boot_up.can_id().raw(), boot_up.data()), (0x701, &[0x00][..]));
//!
//! // A client reads the temperature.
//! let request = Frame::new(CanId::standard(0x601).unwrap(), &[0x40, 0x00, 0x20, 0x00, 0, 0, 0, 0]);
//! node.receive(Instant(5_000), &request, &mut Sensor);
//! assert_eq!(node.transmit().unwrap().data(), [0x4B, 0x00, 0x20, 0x00, 215, 0, 0, 0]);
//! // The next thing to do is the heartbeat.
//! assert_eq!(node.next_deadline(Instant(5_000)), Instant(1_000_000));
//! ```
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]
// Where a service is off, nobody uses what only it has used.
#![cfg_attr(not(feature = "default"), allow(dead_code, unused_imports))]

#[cfg(test)]
extern crate std;

mod access;
mod application;
mod bus_state;
mod commissioning;
mod context;
mod crc;
mod device;
mod dictionary;
mod emcy;
mod error_behaviour;
mod frame;
#[cfg_attr(not(feature = "guarding"), path = "off/guarding.rs")]
mod guarding;
mod heartbeat;
#[cfg_attr(not(feature = "heartbeat-consumer"), path = "off/heartbeat_consumer.rs")]
mod heartbeat_consumer;
mod led;
#[cfg_attr(not(feature = "lss"), path = "off/lss.rs")]
mod lss;
mod nmt;
mod node;
mod pdo;
mod queue;
mod records;
mod ring;
mod sdo;
mod services;
#[cfg_attr(not(feature = "storage"), path = "off/storage.rs")]
mod storage;
#[cfg_attr(not(feature = "sync"), path = "off/sync.rs")]
mod sync;
mod time;
#[cfg_attr(not(feature = "time"), path = "off/time_stamp.rs")]
mod time_stamp;

pub use application::{Application, NoApplication, Reset, TimeOfDay};
pub use bus_state::BusState;
pub use commissioning::{Commissioning, LssAnswer, LssRequest};
pub use crc::Crc;
pub use device::{Device, NodeDevice};
pub use dictionary::{
    Constant, Dictionary, Domain, Entry, Flags, Handle, Key, Limits, Memory, Objects, OctetString, Octets,
    Parts, Position, Readable, StorageGroup, Table, Text, TimeDifference, UnicodeString, Value,
    VisibleString, WriteError,
};
pub use emcy::{EmcyError, Emergency};
pub use frame::{Frame, MOST_DATA};
pub use heartbeat_consumer::HeartbeatConsumer;
pub use led::{Leds, Pattern};
pub use node::{Node, Settings};
pub use pdo::{Mapped, NotSent, PdoPolicy, Remapping, Rpdo, Tpdo};
pub use records::{NoStorage, Record, Storage, StorageError};
pub use sdo::SdoServer;
pub use services::Services;
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
