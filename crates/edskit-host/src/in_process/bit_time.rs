//! How long a frame is on the wire.

use edskit_runtime::Frame;

/// CRC delimiter, acknowledge slot and delimiter, end of frame: not stuffed.
const TAIL: u32 = 1 + 2 + 7;

/// The pause before the next frame may begin.
pub(crate) const INTERMISSION: u32 = 3;

/// The generator polynomial of classic CAN, without its highest term (ISO 11898-1).
const CRC_15: u16 = 0x4599;

/// The number of bits that `frame` is on the wire: with the stuff bits that its content causes, the checksum, and the
/// intermission of 3 bits. From 47 to 160.
///
/// ```
/// use edskit_host::frame_bits;
/// use edskit_runtime::Frame;
/// use edskit_types::CanId;
///
/// // 34 zeros and 6 stuff bits, then 13 bits that are never stuffed.
/// assert_eq!(frame_bits(&Frame::new(CanId::NMT, &[])), 34 + 6 + 13);
/// ```
#[must_use]
pub fn frame_bits(frame: &Frame) -> u32 {
    let mut wire = Wire::default();
    let id = frame.can_id().raw();
    let is_remote = u32::from(frame.is_remote());
    wire.put(0, 1);
    if frame.can_id().is_extended() {
        wire.put(id >> 18, 11);
        // SRR and IDE are recessive.
        wire.put(0b11, 2);
        wire.put(id, 18);
        wire.put(is_remote, 1);
        wire.put(0, 2);
    } else {
        wire.put(id, 11);
        wire.put(is_remote, 1);
        wire.put(0, 2);
    }
    wire.put(u32::from(frame.length()), 4);
    for byte in frame.data() {
        wire.put(u32::from(*byte), 8);
    }
    wire.put(u32::from(wire.checksum), 15);
    wire.bits + TAIL + INTERMISSION
}

/// Counts the bits that are sent.
#[derive(Default)]
struct Wire {
    bits: u32,
    checksum: u16,
    /// The last bit, and how many like it there were in a row.
    last: u32,
    run: u32,
}

impl Wire {
    /// Sends the lowest `count` bits of `value`, the highest of them first.
    fn put(&mut self, value: u32, count: u32) {
        for place in (0..count).rev() {
            let bit = value >> place & 1;
            self.check(bit);
            self.bits += 1;
            self.run = if self.run > 0 && bit == self.last { self.run + 1 } else { 1 };
            self.last = bit;
            if self.run == 5 {
                self.bits += 1;
                self.last = 1 - bit;
                self.run = 1;
            }
        }
    }

    fn check(&mut self, bit: u32) {
        let carry = u32::from(self.checksum >> 14 & 1) ^ bit;
        self.checksum = self.checksum << 1 & 0x7FFF;
        if carry == 1 {
            self.checksum ^= CRC_15;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_types::CanId;
    use proptest::prelude::*;

    fn standard(id: u16, data: &[u8]) -> Frame {
        Frame::new(CanId::standard(id).unwrap(), data)
    }

    fn extended(id: u32, data: &[u8]) -> Frame {
        Frame::new(CanId::extended(id).unwrap(), data)
    }

    /// From the start of frame to the checksum with all stuff bits, made by long division and by looking for five of a
    /// kind in a text, not by this code.
    #[test]
    fn frames_written_out_bit_by_bit() {
        let frames = [
            (standard(0x0, &[]), "0000010000010000010000010000010000010000"),
            (standard(0x14, &[0x01]), "000001001010000010001000001001111011101010011"),
            (standard(0x701, &[0x00]), "0111000001001000001010000010001010000011011000"),
            (Frame::remote(CanId::standard(0x701).unwrap(), 1), "01110000010011000001111101001111000001"),
            (
                standard(0x555, &[0x55; 8]),
                "010101010101000100001010101010101010101010101010101010101010101010101010101010101010011011000001100",
            ),
            (
                standard(0x7FF, &[0xFF; 8]),
                "01111101111101000100011111011111011111011111011111011111011111011111011111011111011111011111011111000110010001001",
            ),
            (
                standard(0x601, &[0x40, 0x00, 0x10, 0x00, 0x00, 0x00, 0x00, 0x00]),
                "011000001000100010000100000100000100000100100000100000100000100000100000100000100000100000100000101100100011010",
            ),
            (
                extended(0x12345678, &[0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08]),
                "0100100011011100010101100111100000101000001000001100000101000001001100000110000010010100000111000001011100001000010001000011010",
            ),
            (extended(0x1FFFFFFF, &[]), "0111110111110111110111110111110111110100000100001110010001000"),
        ];
        for (frame, bits) in frames {
            assert_eq!(frame_bits(&frame), bits.len() as u32 + TAIL + INTERMISSION, "{frame:?}");
        }
    }

    proptest! {
        /// ISO 11898-1: 44 or 64 bits and the data are fixed, 34 or 54 and the data can be stuffed, and after the first
        /// five bits of a kind at most every fourth brings a further stuff bit.
        #[test]
        fn no_frame_is_shorter_or_longer_than_the_standard_allows(
            id in 0u32..0x2000_0000, is_extended: bool, is_remote: bool,
            data in proptest::collection::vec(any::<u8>(), 0..=8),
        ) {
            let mut frame = if is_extended { extended(id, &data) } else { standard((id & 0x7FF) as u16, &data) };
            if is_remote {
                frame = Frame::remote(frame.can_id(), data.len() as u8);
            }
            let stuffable = if is_extended { 54 } else { 34 } + 8 * frame.data().len() as u32;
            let bits = frame_bits(&frame);
            prop_assert!((stuffable + 13..=stuffable + 13 + (stuffable - 1) / 4).contains(&bits));
        }
    }
}
