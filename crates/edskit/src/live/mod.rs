//! What commands on a live bus share.

mod hub;
mod known_device;
mod log;
mod stop;
mod trace;

pub(crate) use hub::{Reachable, addresses, start_hub};
pub(crate) use known_device::{KnownDevice, full_name, object_name};
pub(crate) use log::Log;
pub(crate) use stop::Stop;
pub(crate) use trace::TraceFile;

use edskit_host::{Address, Bus, open};
use edskit_runtime::Microseconds;

/// How long a command waits before it looks whether it has been asked to end.
pub(crate) const PATIENCE: Microseconds = Microseconds(200_000);

/// Attaches to a bus on which others are.
pub(crate) fn attach(address: &Address) -> Result<Box<dyn Bus + Send>, String> {
    if *address == Address::Hub {
        return Err("`hub` would start a hub of its own, on which there is nobody; attach to that of `edskit bus` or \
             `edskit run` with socketcand:127.0.0.1:29536"
            .to_owned());
    }
    open_or_hint(address)
}

/// Opens a bus; where that fails, the message says what may help.
pub(crate) fn open_or_hint(address: &Address) -> Result<Box<dyn Bus + Send>, String> {
    open(address).map_err(|error| match address {
        Address::VirtualAt { .. } => {
            format!("{error}\n  `edskit run FILE --bus virtual` starts a device on a bus in virtual time.")
        }
        Address::Socketcand { .. } | Address::Slcan { .. } => format!(
            "{error}\n  `edskit bus` starts a hub, `edskit run FILE` one with a device on it; --bus names another bus."
        ),
        _ => error.to_string(),
    })
}
