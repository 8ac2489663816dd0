//! `edskit bus`: a hub for devices and tools.

use crate::cli::BusArguments;
use crate::live::{Log, PATIENCE, Stop, TraceFile, addresses, start_hub};
use crate::{Exit, Streams};
use edskit_host::{Bus, Hub, Trace};
use std::io;
use std::thread;
use std::time::Duration;

pub(crate) fn run(arguments: &BusArguments, streams: &mut Streams) -> io::Result<Exit> {
    let log = Log::new(arguments.log);
    let record = arguments.trace.as_deref().map(TraceFile::create).transpose().map_err(io::Error::other)?;
    let stop = Stop::on_request().map_err(io::Error::other)?;
    let hub = start_hub(arguments.listen).map_err(io::Error::other)?;
    log.reachable(streams, &addresses(&hub))?;
    // Without a trace nobody needs the frames.
    let mut listener = record.map(|record| Trace::new(hub.attach(), record));
    let mut told = Told::default();
    while !stop.is_asked() {
        match &mut listener {
            Some(bus) => {
                while bus.receive().map_err(io::Error::other)?.is_some() {}
                while let Some(event) = bus.event() {
                    log.bus(streams, &event)?;
                }
                bus.wait(bus.now() + PATIENCE).map_err(io::Error::other)?;
            }
            None => thread::sleep(Duration::from_micros(PATIENCE.0)),
        }
        told.changes(&hub, &log, streams)?;
    }
    Ok(Exit::Clean)
}

/// What has been told of the hub.
#[derive(Default)]
struct Told {
    clients: usize,
    frames_lost: u64,
}

impl Told {
    /// Tells what is different from the last call.
    fn changes(&mut self, hub: &Hub, log: &Log, streams: &mut Streams) -> io::Result<()> {
        let clients = hub.clients();
        if clients != self.clients {
            let plural = if clients == 1 { "" } else { "s" };
            log.message(streams, &format!("{clients} client{plural} connected"))?;
            self.clients = clients;
        }
        let lost = hub.frames_lost();
        if lost != self.frames_lost {
            let more = lost - self.frames_lost;
            let message = format!(
                "{more} frames dropped, a client does not take them in time ({lost} since the start)"
            );
            log.message(streams, &message)?;
            self.frames_lost = lost;
        }
        Ok(())
    }
}
