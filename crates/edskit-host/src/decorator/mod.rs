//! Buses around buses: what is recorded, lost, doubled, late, or cut off.

mod bus_off;
mod candump;
mod delay;
mod duplication;
mod loss;
mod pcap;
mod trace;

pub use bus_off::{BusOff, BusOffSwitch};
pub use candump::Candump;
pub use delay::Delay;
pub use duplication::Duplication;
pub use loss::Loss;
pub use pcap::Pcap;
pub use trace::{Recorder, Trace};

#[cfg(test)]
mod tests;
