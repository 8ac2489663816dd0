//! The eight bytes of an SDO message.

use edskit_types::{Index, SubIndex};

/// What a message holds.
pub(super) type Message = [u8; 8];

/// Begins or ends a transfer that the other side should forget.
pub(super) const ABORT: u8 = 0x80;
/// The bits of the first byte that name the service.
pub(super) const SERVICE: u8 = 0xE0;
/// The bit that alternates from segment to segment.
pub(super) const TOGGLE: u8 = 0x10;
/// Whether checksums are known, where a block transfer begins.
pub(super) const CRC: u8 = 4;
/// Whether the length is said, where a block transfer begins.
pub(super) const LENGTH: u8 = 2;
/// The last segment of a block transfer.
pub(super) const LAST_SEGMENT: u8 = 0x80;

/// A message that names a place in the dictionary and holds four more bytes.
pub(super) fn message(command: u8, index: Index, sub_index: SubIndex, data: [u8; 4]) -> Message {
    let ([low, high], [a, b, c, d]) = (index.0.to_le_bytes(), data);
    [command, low, high, sub_index.0, a, b, c, d]
}

/// A message of up to seven bytes behind the command.
pub(super) fn segment(command: u8, data: &[u8]) -> Message {
    let mut message = [command, 0, 0, 0, 0, 0, 0, 0];
    for (place, byte) in message[1..].iter_mut().zip(data) {
        *place = *byte;
    }
    message
}

/// The place that a message names.
pub(super) fn place_of(message: &Message) -> (Index, SubIndex) {
    (Index(u16::from_le_bytes([message[1], message[2]])), SubIndex(message[3]))
}

/// The number in the last four bytes.
pub(super) fn number_of(message: &Message) -> u32 {
    u32::from_le_bytes([message[4], message[5], message[6], message[7]])
}
