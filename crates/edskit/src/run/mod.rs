//! `edskit run`: a device as a live node on a bus.

mod file;
pub(crate) mod gateway;

use crate::cli::RunArguments;
use crate::live::{TraceFile, start_hub};
use crate::{Exit, Streams};
use edskit_host::{Address, Bus, Hub, Trace, open};
use std::io;

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

/// A bus, and the hub where this process has started one for it.
type Connected = (Box<dyn Bus>, Option<Hub>);

fn connect(arguments: &RunArguments, record: Option<TraceFile>) -> Result<Connected, String> {
    let (bus, hub): Connected = if arguments.bus == Address::Hub {
        let hub = start_hub(arguments.listen)?;
        (Box::new(hub.attach()), Some(hub))
    } else {
        (open(&arguments.bus).map_err(|error| error.to_string())?, None)
    };
    Ok(match record {
        Some(record) => (Box::new(Trace::new(bus, record)), hub),
        None => (bus, hub),
    })
}
