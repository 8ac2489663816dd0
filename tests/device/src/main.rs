//! A device on a computer: the node of a generated dictionary, on a bus of its own that other tools attach to.
//!
//! It takes `--bus hub`, `--bus virtual`, `--listen ADDR:PORT` and `--node-id N` as `edskit run` does, prints where it
//! listens, and runs until it is ended.

use edskit_host::{Bus, Hub, HubOptions, MemoryDevice, MemoryStorage, Station, VirtualBus, VirtualServer};
use edskit_runtime::types::{Bitrate, NodeId};
use edskit_runtime::{Node, NodeDevice, Settings};
use std::env;
use std::error::Error;
use std::io::{self, Write};
use std::net::SocketAddr;

edskit_runtime::include_dictionary!("device");

/// The device.
type Generated = NodeDevice<device::Dictionary, MemoryStorage, MemoryDevice>;

fn main() -> Result<(), Box<dyn Error>> {
    let listen: SocketAddr = option("--listen").as_deref().unwrap_or("127.0.0.1:0").parse()?;
    let node_id = NodeId::new(option("--node-id").as_deref().unwrap_or("1").parse()?)?;
    let settings = Settings { node_id: Some(node_id), ..device::SETTINGS };
    let node = Node::new(device::Dictionary::new(), settings, MemoryStorage::default());
    let device = NodeDevice { node, application: MemoryDevice::default() };
    match option("--bus").as_deref() {
        None | Some("hub") => on_a_hub(device, listen),
        Some("virtual") => in_virtual_time(device, listen),
        Some(other) => Err(format!("`{other}` is neither `hub` nor `virtual`").into()),
    }
}

fn on_a_hub(device: Generated, listen: SocketAddr) -> Result<(), Box<dyn Error>> {
    let any_port = SocketAddr::new(listen.ip(), 0);
    let hub = Hub::start(&HubOptions { socketcand: Some(listen), slcan: Some(any_port) })?;
    tell("socketcand", hub.socketcand_address().ok_or("the hub does not listen")?)?;
    tell("slcan", hub.slcan_address().ok_or("the hub does not listen")?)?;
    let mut station = Station::new(device, hub.attach());
    loop {
        let deadline = station.round()?;
        // Nobody asks what happens, so nothing of it is kept.
        drop(station.device.application.take_events());
        station.bus.wait(deadline)?;
    }
}

fn in_virtual_time(device: Generated, listen: SocketAddr) -> Result<(), Box<dyn Error>> {
    let bus = VirtualBus::new(Bitrate::Kbit1000);
    let mut server = VirtualServer::start(&bus, listen)?;
    tell("virtual", server.address())?;
    let mut station = Station::new(device, bus.attach());
    loop {
        let deadline = station.round()?;
        drop(station.device.application.take_events());
        server.wait(deadline);
    }
}

/// Says where a protocol is spoken, at once: who waits for it must not wait for a full buffer.
fn tell(protocol: &str, address: SocketAddr) -> io::Result<()> {
    let mut output = io::stdout();
    writeln!(output, "{protocol} {address}")?;
    output.flush()
}

/// The argument behind the one with this name.
fn option(name: &str) -> Option<String> {
    env::args().skip_while(|argument| argument != name).nth(1)
}
