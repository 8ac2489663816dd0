//! A hub whose device sends every frame back with its identifier plus one: `cargo run -p edskit-host --example echo`
//!
//! Attach for instance python-can: `can.Bus(interface="socketcand", host="127.0.0.1", port=29536, channel="can0")`

use edskit_host::{Bus, Hub, HubOptions};
use edskit_runtime::{Frame, Instant};
use edskit_types::CanId;
use std::error::Error;
use std::io::{self, Write};

fn main() -> Result<(), Box<dyn Error>> {
    let has_free_ports = std::env::args().any(|argument| argument == "--free-ports");
    let options = if has_free_ports { HubOptions::with_free_ports() } else { HubOptions::default() };
    let hub = Hub::start(&options)?;
    if let (Some(socketcand), Some(slcan)) = (hub.socketcand_address(), hub.slcan_address()) {
        writeln!(io::stdout(), "socketcand {socketcand}\nslcan {slcan}")?;
    }
    let mut device = hub.attach();
    loop {
        device.wait(Instant::NEVER)?;
        while let Some(received) = device.receive()? {
            if let Some(frame) = answer(&received.frame) {
                device.send(&frame)?;
            }
        }
    }
}

/// The same frame with the next identifier; none behind the last one.
fn answer(frame: &Frame) -> Option<Frame> {
    let next = frame.can_id().raw() + 1;
    let can_id = if frame.can_id().is_extended() {
        CanId::extended(next)
    } else {
        CanId::standard(u16::try_from(next).ok()?)
    }?;
    Some(if frame.is_remote() {
        Frame::remote(can_id, frame.length())
    } else {
        Frame::new(can_id, frame.data())
    })
}
