//! A bus inside this process, in virtual time.

mod arbitration;
mod bit_time;
mod medium;
mod simulation;

pub use bit_time::frame_bits;
pub use medium::{Participant, VirtualBus};
pub use simulation::{Actor, simulate};
