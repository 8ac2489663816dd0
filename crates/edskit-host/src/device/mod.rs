//! Nodes on buses of this computer, and devices that have nothing behind them.

mod memory;
mod station;
mod storage;

pub use memory::{DeviceEvent, MemoryDevice};
pub use station::Station;
pub use storage::MemoryStorage;
