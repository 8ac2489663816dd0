//! `edskit monitor`: what goes over a bus, decoded.

mod decode;
mod network;
mod node;
mod render;

use crate::cli::MonitorArguments;
use crate::live::{Log, PATIENCE, Stop, TraceFile, addresses, open_or_hint, start_hub};
use crate::{Exit, Streams};
use decode::Decoder;
use edskit_host::{Address, Bus, Event, Received, Trace};
use network::Network;
use render::Report;
use serde::Serialize;
use std::io;

pub(crate) fn run(arguments: &MonitorArguments, streams: &mut Streams) -> io::Result<Exit> {
    let log = Log::new(arguments.log);
    let network = Network::read(&arguments.devices).map_err(io::Error::other)?;
    let record = arguments.trace.as_deref().map(TraceFile::create).transpose().map_err(io::Error::other)?;
    let stop = Stop::on_request().map_err(io::Error::other)?;
    // A hub lives as long as its monitor.
    let (bus, _hub): (Box<dyn Bus + Send>, _) = if arguments.bus == Address::Hub {
        let hub = start_hub(None).map_err(io::Error::other)?;
        log.reachable(streams, &addresses(&hub))?;
        (Box::new(hub.attach()), Some(hub))
    } else {
        (open_or_hint(&arguments.bus).map_err(io::Error::other)?, None)
    };
    let mut decoder = Decoder::new(network);
    match record {
        Some(record) => watch(&mut Trace::new(bus, record), &mut decoder, &stop, &log, streams)?,
        None => watch(&mut { bus }, &mut decoder, &stop, &log, streams)?,
    }
    Ok(Exit::Clean)
}

fn watch(
    bus: &mut impl Bus,
    decoder: &mut Decoder,
    stop: &Stop,
    log: &Log,
    streams: &mut Streams,
) -> io::Result<()> {
    while !stop.is_asked() {
        while let Some(Received { time, frame }) = bus.receive().map_err(io::Error::other)? {
            tell_events(bus, decoder, log, streams)?;
            let report = Report { time: time.0, frame: &frame, message: decoder.decode(&frame) };
            log.line(streams, &report, || report.text())?;
            if stop.is_asked() {
                return Ok(());
            }
        }
        tell_events(bus, decoder, log, streams)?;
        bus.wait(bus.now() + PATIENCE).map_err(io::Error::other)?;
    }
    Ok(())
}

/// What happened to the bus. Transfers in which frames may be missing are forgotten, so that no wrong value is shown.
fn tell_events(
    bus: &mut impl Bus,
    decoder: &mut Decoder,
    log: &Log,
    streams: &mut Streams,
) -> io::Result<()> {
    while let Some(event) = bus.event() {
        if !matches!(event, Event::ErrorFrame(_) | Event::TraceEnded(_)) {
            decoder.forget();
        }
        let service = match event {
            Event::ErrorFrame(_) => "error-frame",
            _ => "bus",
        };
        let message = event.to_string();
        log.line(streams, &EventLine { message: &message, service }, || format!("-- {message}"))?;
    }
    Ok(())
}

/// What happened to the bus, as JSON.
#[derive(Serialize)]
struct EventLine<'a> {
    message: &'a str,
    service: &'a str,
}
