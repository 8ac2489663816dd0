//! Shows the frames on a bus: `cargo run -p edskit-host --example listen slcan:127.0.0.1:29537`

use edskit_host::{Address, open};
use edskit_runtime::Instant;
use std::error::Error;
use std::io::{self, Write};

fn main() -> Result<(), Box<dyn Error>> {
    let address: Address = std::env::args().nth(1).unwrap_or_else(|| "hub".to_owned()).parse()?;
    let mut bus = open(&address)?;
    let mut out = io::stdout();
    loop {
        bus.wait(Instant::NEVER)?;
        while let Some(received) = bus.receive()? {
            let frame = received.frame;
            writeln!(out, "{} {:02X?}", frame.can_id(), frame.data())?;
        }
        while let Some(event) = bus.event() {
            writeln!(out, "{event}")?;
        }
    }
}
