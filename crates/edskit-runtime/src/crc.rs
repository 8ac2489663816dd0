//! The checksum of SDO block transfers and of stored values.

/// CRC with the polynomial x^16 + x^12 + x^5 + 1 and the start value 0 (CiA 301 v4.2, 7.2.4.3.16).
///
/// One byte at a time without a table: 512 bytes of flash are worth more here than the time.
///
/// ```
/// let mut crc = edskit_runtime::Crc::new();
/// crc.update(b"123456789");
/// assert_eq!(crc.value(), 0x31C3);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Crc(u16);

impl Crc {
    /// The checksum of no bytes.
    #[must_use]
    pub const fn new() -> Self {
        Self(0)
    }

    /// Takes further bytes in.
    pub fn update(&mut self, data: &[u8]) {
        for byte in data {
            let mut x = (self.0 >> 8) ^ u16::from(*byte);
            x ^= x >> 4;
            self.0 = (self.0 << 8) ^ (x << 12) ^ (x << 5) ^ x;
        }
    }

    /// The checksum of all bytes that were taken in.
    #[must_use]
    pub const fn value(self) -> u16 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_check_value_of_the_standard() {
        let mut crc = Crc::new();
        crc.update(b"123456789");
        assert_eq!(crc.value(), 0x31C3);
    }

    #[test]
    fn pieces_give_the_same_as_the_whole() {
        let (mut whole, mut pieces) = (Crc::new(), Crc::new());
        whole.update(&[0xA5; 100]);
        [0xA5; 100].chunks(7).for_each(|piece| pieces.update(piece));
        assert_eq!(whole, pieces);
    }
}
