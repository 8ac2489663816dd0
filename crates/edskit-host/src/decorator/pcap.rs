//! The file format of packet captures.

use super::Recorder;
use edskit_runtime::{Frame, Instant};
use std::io::{self, Write};

/// In the byte order of this file: little-endian, times in microseconds.
const MAGIC: u32 = 0xA1B2_C3D4;

/// LINKTYPE_CAN_SOCKETCAN: the identifier with its flags in network byte order, the length, three zeros, the data.
const LINK_TYPE: u32 = 227;

/// Bits of the identifier, as SocketCAN has them.
const EXTENDED: u32 = 1 << 31;
const REMOTE: u32 = 1 << 30;

/// Writes the classic pcap format with link type 227, which Wireshark and tcpdump read. Times are seconds and microseconds
/// of 32 bits each: they wrap in 2106.
pub struct Pcap<W> {
    writer: W,
}

impl<W: Write> Pcap<W> {
    /// Writes to `writer`, the file header at once.
    ///
    /// # Errors
    ///
    /// As the writer.
    pub fn new(mut writer: W) -> io::Result<Self> {
        let mut header = Vec::with_capacity(24);
        header.extend(MAGIC.to_le_bytes());
        header.extend([2, 0, 4, 0]);
        // The time zone and the accuracy, which nobody uses.
        header.extend([0; 8]);
        // No packet is longer.
        header.extend(65_535_u32.to_le_bytes());
        header.extend(LINK_TYPE.to_le_bytes());
        writer.write_all(&header)?;
        Ok(Self { writer })
    }
}

impl<W: Write> Recorder for Pcap<W> {
    fn record(&mut self, time: Instant, frame: &Frame) -> io::Result<()> {
        let mut id = frame.can_id().raw();
        id |= if frame.can_id().is_extended() { EXTENDED } else { 0 };
        id |= if frame.is_remote() { REMOTE } else { 0 };
        let size = (8 + frame.data().len() as u32).to_le_bytes();
        let mut record = Vec::with_capacity(32);
        record.extend(((time.0 / 1_000_000) as u32).to_le_bytes());
        record.extend(((time.0 % 1_000_000) as u32).to_le_bytes());
        record.extend(size);
        record.extend(size);
        record.extend(id.to_be_bytes());
        record.extend([frame.length(), 0, 0, 0]);
        record.extend(frame.data());
        self.writer.write_all(&record)
    }
}
