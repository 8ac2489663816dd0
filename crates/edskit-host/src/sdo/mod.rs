//! SDO client: reading and writing the object dictionary of another node (CiA 301 v4.2, 7.2.4).
//!
//! [`Transfer`] is one transfer without any bus or clock: frames and times go in, frames come out. [`SdoClient`] drives
//! one over a [`Bus`](crate::Bus) until it has ended.

mod block_download;
mod block_upload;
mod client;
mod download;
mod error;
mod fallback;
mod heard;
mod message;
mod options;
mod transfer;
mod upload;
mod value;

pub use client::SdoClient;
pub use error::SdoError;
pub use heard::Heard;
pub use options::{SdoChannel, SdoMode, SdoOptions};
pub use transfer::Transfer;
pub use value::SdoValue;

/// How many data bytes a segment has.
const SEGMENT: usize = 7;

/// The most bytes of an expedited transfer.
const EXPEDITED: usize = 4;

/// The most segments of a block.
const MOST_SEGMENTS: u8 = 127;

#[cfg(test)]
mod tests;
