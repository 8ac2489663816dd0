//! A device on a computer: the node of a generated dictionary, on a bus of its own that other tools attach to.
//!
//! It takes `--listen ADDR:PORT` and `--node-id N` as `edskit run` does, prints where it listens, and runs until it is
//! ended.

use edskit_host::{Bus, Hub, HubOptions, MemoryDevice, MemoryStorage, Station};
use edskit_runtime::types::NodeId;
use edskit_runtime::{Node, NodeDevice, Settings};
use std::env;
use std::error::Error;
use std::io::{self, Write};
use std::net::SocketAddr;

edskit_runtime::include_dictionary!("device");

fn main() -> Result<(), Box<dyn Error>> {
    let listen: SocketAddr = option("--listen").as_deref().unwrap_or("127.0.0.1:0").parse()?;
    let node_id = NodeId::new(option("--node-id").as_deref().unwrap_or("1").parse()?)?;

    let any_port = SocketAddr::new(listen.ip(), 0);
    let hub = Hub::start(&HubOptions { socketcand: Some(listen), slcan: Some(any_port) })?;
    let addresses = [("socketcand", hub.socketcand_address()), ("slcan", hub.slcan_address())];
    let mut output = io::stdout();
    for (protocol, address) in addresses {
        let address = address.ok_or("the hub does not listen")?;
        writeln!(output, "{protocol} {address}")?;
    }
    // Who waits for the addresses must not wait for a full buffer.
    output.flush()?;

    let settings = Settings { node_id: Some(node_id), ..Settings::default() };
    let node = Node::new(device::Dictionary::new(), settings, MemoryStorage::default());
    let mut station = Station::new(NodeDevice { node, application: MemoryDevice::default() }, hub.attach());
    loop {
        let deadline = station.round()?;
        // Nobody asks what happens, so nothing of it is kept.
        drop(station.device.application.take_events());
        station.bus.wait(deadline)?;
    }
}

/// The argument behind the one with this name.
fn option(name: &str) -> Option<String> {
    env::args().skip_while(|argument| argument != name).nth(1)
}
