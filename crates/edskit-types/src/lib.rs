//! The words of CANopen: small `Copy` types for the numbers of CiA 301 that an EDS or DCF file talks about.
//!
//! The crate is `no_std`, allocates nothing and depends on nothing. It knows what a number means, not where
//! it was read: files, texts and findings belong to other crates.
//!
//! | idea | items |
//! |---|---|
//! | place in the object dictionary | [`Index`], [`SubIndex`], [`ObjectArea`] |
//! | address of a device | [`NodeId`], [`InvalidNodeId`] |
//! | identifier on the bus | [`CanId`], [`CobId`] |
//! | shape of an object | [`ObjectCode`] |
//! | rights on an object | [`AccessType`] |
//! | type of a value | [`DataType`], [`DataTypeKind`] |
//! | when a PDO is sent or applied | [`TransmissionType`], [`Transmission`], [`PdoDirection`] |
//! | who uses which identifier, and what is in whose way | [`Claim`], [`Party`], [`conflicts`], [`IdentifierRules`], [`CobIdFault`] |
//! | speed of the bus | [`Bitrate`], [`BitRates`] |
//! | state of a device, and what changes it | [`NmtState`], [`NmtCommand`] |
//! | why an SDO transfer was refused | [`AbortCode`] |
//! | what an emergency message says | [`EmergencyCode`], [`ErrorRegister`] |
//!
//! # Example
//!
//! ```
//! use edskit_types::{AccessType, CobId, DataType, Index, ObjectArea};
//!
//! let index = Index(0x1017);
//! assert_eq!(index, Index::PRODUCER_HEARTBEAT);
//! assert_eq!(index.area(), ObjectArea::Communication);
//! assert_eq!(index.to_string(), "1017h");
//!
//! let data_type = DataType::from_index(Index(0x0006)).unwrap();
//! assert_eq!(data_type.name(), "UNSIGNED16");
//! assert_eq!(data_type.range(), Some((0, 65_535)));
//!
//! assert!(AccessType::parse(b"RW").unwrap().is_writable());
//! assert!(!CobId(0x8000_0181).is_valid());
//! ```
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(test)]
extern crate std;

mod abort_code;
mod access_type;
mod bitrate;
mod cob_id;
mod data_type;
mod emergency_code;
mod identifiers;
mod index;
mod mapping_entry;
mod nmt;
mod node_id;
mod object_code;
mod transmission_type;

pub use abort_code::AbortCode;
pub use access_type::AccessType;
pub use bitrate::{BitRates, Bitrate};
pub use cob_id::{CanId, CobId};
pub use data_type::{DataType, DataTypeKind};
pub use emergency_code::{EmergencyCode, ErrorRegister};
pub use identifiers::{
    Claim, CobIdFault, Conflict, IdentifierRules, Opponent, Party, Restriction, SdoMessage, SdoRole,
    conflicts,
};
pub use index::{Index, ObjectArea, SubIndex};
pub use mapping_entry::MappingEntry;
pub use nmt::{NmtCommand, NmtState};
pub use node_id::{InvalidNodeId, NodeId};
pub use object_code::ObjectCode;
pub use transmission_type::{PdoDirection, Transmission, TransmissionType};
