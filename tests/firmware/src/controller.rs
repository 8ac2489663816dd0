//! A CAN controller and a clock, reduced to registers that no real part has: a driver of the least size.

use core::ptr::{read_volatile, write_volatile};
use edskit_runtime::types::CanId;
use edskit_runtime::{Frame, Instant};

/// Where the registers begin.
const BASE: *mut u32 = 0x4004_0000 as *mut u32;

/// In the length: the frame is a remote one.
const REMOTE: u32 = 1 << 8;

/// The registers, each a word.
#[derive(Clone, Copy)]
enum Register {
    /// Milliseconds since power-on.
    Milliseconds,
    /// How many frames wait.
    Waiting,
    CanId,
    Length,
    DataLow,
    DataHigh,
    /// Microseconds, from which on the processor is woken.
    Alarm,
}

impl Register {
    fn read(self) -> u32 {
        // SAFETY: the registers are words at an address that nothing else uses.
        unsafe { read_volatile(BASE.add(self as usize)) }
    }

    fn write(self, value: u32) {
        // SAFETY: as above.
        unsafe { write_volatile(BASE.add(self as usize), value) }
    }
}

pub(crate) struct Controller;

impl Controller {
    pub(crate) fn now(&self) -> Instant {
        Instant(u64::from(Register::Milliseconds.read()) * 1_000)
    }

    pub(crate) fn receive(&mut self) -> Option<Frame> {
        if Register::Waiting.read() == 0 {
            return None;
        }
        let can_id = CanId::standard(Register::CanId.read() as u16)?;
        let length = Register::Length.read();
        if length & REMOTE != 0 {
            return Some(Frame::remote(can_id, length as u8));
        }
        let [a, b, c, d] = Register::DataLow.read().to_le_bytes();
        let [e, f, g, h] = Register::DataHigh.read().to_le_bytes();
        let data = [a, b, c, d, e, f, g, h];
        Some(Frame::new(can_id, data.get(..length as usize).unwrap_or(&data)))
    }

    pub(crate) fn transmit(&mut self, frame: &Frame) {
        Register::CanId.write(frame.can_id().raw());
        for byte in frame.data() {
            Register::DataLow.write(u32::from(*byte));
        }
    }

    pub(crate) fn sleep_until(&mut self, deadline: Instant) {
        Register::Alarm.write(deadline.0 as u32);
    }
}
