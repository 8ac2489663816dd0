//! `edskit run`: a device as a live node on a bus.

mod file;
pub(crate) mod gateway;
mod virtual_bus;

use crate::cli::RunArguments;
use crate::live::{Reachable, TraceFile, addresses, start_hub};
use crate::{Exit, Streams};
use edskit_host::{Address, Bus, Hub, Trace, open};
use edskit_types::Bitrate;
use std::io;
use virtual_bus::{USUAL_ADDRESS, VirtualConnection};

/// The built-in device in the place of a file.
const GATEWAY: &str = "gateway";

pub(crate) fn run(arguments: &RunArguments, streams: &mut Streams) -> io::Result<Exit> {
    if arguments.file.as_os_str() == GATEWAY {
        return gateway::run(arguments, streams);
    }
    let of_the_gateway = [
        ("--params", arguments.params.is_some()),
        ("--scenario", arguments.scenario.is_some()),
        ("--simulate", arguments.simulate.is_some()),
    ];
    if let Some((option, _)) = of_the_gateway.into_iter().find(|(_, is_given)| *is_given) {
        let file = arguments.file.display();
        return Err(io::Error::other(format!(
            "{option} goes with the built-in device `{GATEWAY}` only, not with the file {file}"
        )));
    }
    file::run(arguments, streams)
}

/// The bus of a device.
struct Connected {
    bus: Box<dyn Bus>,
    /// Where others reach it, if this process has made it.
    reachable: Reachable,
    /// It lives as long as the device.
    _hub: Option<Hub>,
}

/// Opens or makes the bus, one in virtual time with this bit rate.
fn connect(
    arguments: &RunArguments,
    bit_rate: Bitrate,
    record: Option<TraceFile>,
) -> Result<Connected, String> {
    if arguments.bus == Address::Virtual {
        let listen = arguments.listen.unwrap_or(USUAL_ADDRESS);
        let bus = VirtualConnection::start(listen, bit_rate, record).map_err(|error| error.to_string())?;
        let reachable = vec![("virtual", bus.address())];
        return Ok(Connected { bus: Box::new(bus), reachable, _hub: None });
    }
    if arguments.bit_rate.is_some() {
        return Err("--bit-rate goes with `--bus virtual`: a hub has no bit rate, and that of another bus is not set here"
            .to_owned());
    }
    let (bus, hub): (Box<dyn Bus>, _) = if arguments.bus == Address::Hub {
        let hub = start_hub(arguments.listen)?;
        (Box::new(hub.attach()), Some(hub))
    } else {
        (open(&arguments.bus).map_err(|error| error.to_string())?, None)
    };
    let reachable = hub.as_ref().map(addresses).unwrap_or_default();
    Ok(match record {
        Some(record) => Connected { bus: Box::new(Trace::new(bus, record)), reachable, _hub: hub },
        None => Connected { bus, reachable, _hub: hub },
    })
}
