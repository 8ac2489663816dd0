//! Buses and clocks for CANopen on a computer.
//!
//! A [`Bus`] takes and gives frames without blocking, and waits. There are several kinds:
//!
//! | bus | address | remote frames |
//! |---|---|---|
//! | [`VirtualBus`]: in this process, in virtual time, with arbitration and true bit times | none, it is made in code | yes |
//! | [`Hub`]: a bus in this process that other tools attach to over TCP | `hub` | yes |
//! | [`VirtualServer`]: a [`VirtualBus`] that other programs attach to over TCP | none, it is made in code | yes |
//! | [`VirtualClient`]: the bus in virtual time of another process | `virtual:HOST:PORT` | yes |
//! | [`Client::socketcand`]: a hub or a socketcand daemon | `socketcand:HOST:PORT/CHANNEL` | no |
//! | [`Client::slcan`]: a hub or an SLCAN adapter that speaks TCP | `slcan:HOST:PORT` | yes |
//! | `SocketCan`: an interface of the Linux kernel, with the feature `socketcan` | `socketcan:can0` | yes |
//!
//! [`open`] makes a bus of an [`Address`]. Around any bus go decorators: [`Trace`], [`Loss`], [`Duplication`],
//! [`Delay`] and [`BusOff`]. An SDO client is in [`sdo`].
//!
//! A [`Station`] is a device on a bus; [`MemoryDevice`] and [`MemoryStorage`] are a device that has nothing behind it.
//!
//! The crate prints nothing. What a person should hear of comes as an [`Event`].
//!
//! ```
//! use edskit_host::{Bus, VirtualBus};
//! use edskit_runtime::{Frame, Instant, Microseconds};
//! use edskit_types::{Bitrate, CanId};
//!
//! let bus = VirtualBus::new(Bitrate::Kbit1000);
//! let (mut device, mut tool) = (bus.attach(), bus.attach());
//! let boot_up = Frame::new(CanId::standard(0x701).unwrap(), &[0]);
//! device.send(&boot_up)?;
//!
//! tool.wait(bus.now() + Microseconds::from_milliseconds(1))?;
//! let received = tool.receive()?.expect("the frame has arrived");
//! assert_eq!(received.frame, boot_up);
//! assert_eq!(received.time, Instant(56));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod address;
mod bus;
mod client;
mod clock;
mod decorator;
mod device;
mod error;
mod hub;
mod in_process;
mod listener;
mod open;
mod queue;
pub mod sdo;
mod slcan;
#[cfg(all(feature = "socketcan", target_os = "linux"))]
mod socketcan;
mod socketcand;
mod virtual_time;

pub use address::{Address, AddressError, AddressForm};
pub use bus::{Bus, Event, Received};
pub use client::Client;
pub use clock::system_now;
pub use decorator::{BusOff, BusOffSwitch, Candump, Delay, Duplication, Loss, Pcap, Recorder, Trace};
pub use device::{DeviceEvent, MemoryDevice, MemoryStorage, Station};
pub use error::{BusError, SendError};
pub use hub::{Hub, HubOptions, HubParticipant};
pub use in_process::{Actor, Participant, VirtualBus, frame_bits, simulate};
pub use open::open;
#[cfg(all(feature = "socketcan", target_os = "linux"))]
pub use socketcan::SocketCan;
pub use virtual_time::{VirtualClient, VirtualServer};
