//! The Heinzmann CANopen gateway with its governor, live.

mod governor;
mod live;
mod log;
mod scenario;
mod session;
mod simulate;
mod view;

use crate::cli::RunArguments;
use crate::config::{self, KnownSignals, Parameters};
use crate::live::{Log, TraceFile};
use crate::{Exit, Streams};
use edskit_devices::gateway::{Engine, Gateway};
use edskit_host::MemoryStorage;
use edskit_types::Bitrate;
use governor::DescribedEngine;
pub(crate) use session::LiveGateway;
use std::io;

/// The bit rate of a bus in virtual time where the gateway has manual bit timing, which names none.
const MANUAL_TIMING: Bitrate = Bitrate::Kbit125;

pub(super) fn run(arguments: &RunArguments, streams: &mut Streams) -> io::Result<Exit> {
    if arguments.node_id.is_some() {
        return Err(io::Error::other(
            "the node-ID of the gateway is its parameter P427: write `P427 = ..` in `[gateway]` of a file, and give it \
             with --params",
        ));
    }
    // Both files are read, so that the problems of both are told at once.
    let parameters = match &arguments.params {
        Some(file) => config::read(file, streams)?,
        None => Some(Parameters::default()),
    };
    let steps = match &arguments.scenario {
        Some(file) => {
            let signals = parameters.as_ref().map(|parameters| &parameters.signals);
            scenario::read(file, arguments.simulate, signals.unwrap_or(&KnownSignals::default()), streams)?
        }
        None => Some(Vec::new()),
    };
    let (Some(parameters), Some(steps)) = (parameters, steps) else { return Ok(Exit::Findings) };
    let record = arguments.trace.as_deref().map(TraceFile::create).transpose().map_err(io::Error::other)?;
    let device = gateway(parameters);
    match arguments.simulate {
        Some(duration) => {
            let log = Log::new(arguments.log.unwrap_or_default());
            simulate::run(device, steps, duration, record, &log, streams)
        }
        None => live::run(device, steps, arguments, record, streams),
    }
}

/// A gateway that has not got its supply yet.
pub(crate) fn gateway(parameters: Parameters) -> LiveGateway {
    let governor = DescribedEngine { engine: Engine::new(), signals: parameters.signals };
    Gateway::new(parameters.configuration, governor, MemoryStorage::default())
}
