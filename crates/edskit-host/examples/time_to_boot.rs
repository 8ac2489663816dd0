//! How long node 1 takes from a reset to its boot-up message, in virtual time:
//! `cargo run -p edskit-host --example time_to_boot` while `edskit run gateway --bus virtual` runs.

use edskit_host::{Bus, VirtualClient};
use edskit_runtime::{Frame, Instant, Microseconds};
use edskit_types::{CanId, NmtCommand};
use std::error::Error;
use std::io::{self, Write};

/// Lets time pass until node 1 boots up, up to a second; gives the time.
fn boot_up(bus: &mut VirtualClient) -> Result<Option<Instant>, Box<dyn Error>> {
    let end = bus.now() + Microseconds::from_milliseconds(1000);
    while bus.now() < end {
        bus.wait(end)?;
        while let Some(received) = bus.receive()? {
            if received.frame.can_id().raw() == 0x701 && received.frame.data() == [0] {
                return Ok(Some(received.time));
            }
        }
    }
    Ok(None)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut bus = VirtualClient::connect("127.0.0.1", 29538)?;
    boot_up(&mut bus)?;
    let start = bus.now();
    bus.send(&Frame::new(CanId::NMT, &[NmtCommand::ResetNode.code(), 1]))?;
    let end = boot_up(&mut bus)?.ok_or("node 1 does not boot up within a second")?;
    writeln!(io::stdout(), "{} µs from the reset to the boot-up message", end.since(start).0)?;
    Ok(())
}
