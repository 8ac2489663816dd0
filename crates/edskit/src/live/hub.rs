//! Starting a hub.

use super::Log;
use crate::Streams;
use edskit_host::{Hub, HubOptions};
use std::net::SocketAddr;

/// Starts a hub and says where it listens, on the first lines.
pub(crate) fn start_hub(listen: Option<SocketAddr>, log: &Log, streams: &mut Streams) -> Result<Hub, String> {
    let hub = Hub::start(&options(listen)).map_err(|error| error.to_string())?;
    let addresses = [("socketcand", hub.socketcand_address()), ("slcan", hub.slcan_address())];
    for (protocol, address) in addresses {
        if let Some(address) = address {
            log.listening(streams, protocol, address).map_err(|error| error.to_string())?;
        }
    }
    Ok(hub)
}

/// The hub's ports: the given one for socketcand and the next one for SLCAN; port 0 takes free ones.
fn options(listen: Option<SocketAddr>) -> HubOptions {
    let Some(listen) = listen else { return HubOptions::default() };
    let next = if listen.port() == 0 { 0 } else { listen.port().saturating_add(1) };
    HubOptions { socketcand: Some(listen), slcan: Some(SocketAddr::new(listen.ip(), next)) }
}
