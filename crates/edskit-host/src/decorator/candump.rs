//! The log of candump.

use super::Recorder;
use edskit_runtime::{Frame, Instant};
use std::io::{self, Write};

/// Writes the log format of `candump -L`, which can-utils, python-can, SavvyCAN and Wireshark read:
/// `(1700000000.123456) can0 601#4000100000000000`, remote frames as `701#R1`.
pub struct Candump<W> {
    writer: W,
    interface: String,
}

impl<W: Write> Candump<W> {
    /// Writes to `writer`, with `interface` as the name of the bus; blanks in it become underscores.
    pub fn new(writer: W, interface: &str) -> Self {
        Self { writer, interface: interface.replace(char::is_whitespace, "_") }
    }
}

impl<W: Write> Recorder for Candump<W> {
    fn record(&mut self, time: Instant, frame: &Frame) -> io::Result<()> {
        let (seconds, rest) = (time.0 / 1_000_000, time.0 % 1_000_000);
        let width = if frame.can_id().is_extended() { 8 } else { 3 };
        let id = frame.can_id().raw();
        let mut line = format!("({seconds:010}.{rest:06}) {} {id:0width$X}#", self.interface);
        if frame.is_remote() {
            line.push('R');
            if frame.length() > 0 {
                line += &frame.length().to_string();
            }
        }
        line.extend(frame.data().iter().map(|byte| format!("{byte:02X}")));
        line.push('\n');
        // In one piece, so that a line is never torn where nothing is buffered.
        self.writer.write_all(line.as_bytes())
    }
}
