//! Starting a bus that others attach to.

use edskit_host::{Hub, HubOptions};
use std::net::SocketAddr;

/// Where a bus of this process can be reached: the protocol, and the address.
pub(crate) type Reachable = Vec<(&'static str, SocketAddr)>;

/// Starts a hub.
pub(crate) fn start_hub(listen: Option<SocketAddr>) -> Result<Hub, String> {
    Hub::start(&options(listen)).map_err(|error| error.to_string())
}

/// Where a hub listens, by protocol.
pub(crate) fn addresses(hub: &Hub) -> Reachable {
    let addresses = [("socketcand", hub.socketcand_address()), ("slcan", hub.slcan_address())];
    addresses.into_iter().filter_map(|(protocol, address)| Some((protocol, address?))).collect()
}

/// The hub's ports: the given one for socketcand and the next one for SLCAN; port 0 takes free ones.
fn options(listen: Option<SocketAddr>) -> HubOptions {
    let Some(listen) = listen else { return HubOptions::default() };
    let next = if listen.port() == 0 { 0 } else { listen.port().saturating_add(1) };
    HubOptions { socketcand: Some(listen), slcan: Some(SocketAddr::new(listen.ip(), next)) }
}
