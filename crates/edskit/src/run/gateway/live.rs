//! The gateway on a bus, in real time.

use super::scenario::Step;
use super::session::{LiveGateway, Session};
use super::view::{Screen, View};
use crate::cli::RunArguments;
use crate::live::{Log, PATIENCE, Stop, TraceFile, addresses};
use crate::run::connect;
use crate::{Exit, Streams};
use edskit_host::Bus;
use std::io;

/// Runs the gateway until it is asked to end, with a log or with a view.
pub(super) fn run(
    device: LiveGateway,
    steps: Vec<Step>,
    arguments: &RunArguments,
    record: Option<TraceFile>,
    streams: &mut Streams,
) -> io::Result<Exit> {
    // The hub lives as long as the gateway.
    let (bus, hub) = connect(arguments, record).map_err(io::Error::other)?;
    let stop = Stop::on_request().map_err(io::Error::other)?;
    let mut session = Session::new(device, bus, None, steps);
    if arguments.log.is_some() || !streams.is_terminal {
        let log = Log::new(arguments.log.unwrap_or_default());
        if let Some(hub) = &hub {
            log.hub(streams, hub)?;
        }
        return print(&mut session, &log, &stop, streams);
    }
    let where_it_is = match &hub {
        Some(hub) => addresses(hub).map(|(protocol, address)| format!("{protocol} {address}")).collect(),
        None => vec![arguments.bus.to_string()],
    };
    watch(&mut session, View::new(where_it_is.join(", ")), &stop)
}

fn print(
    session: &mut Session<Box<dyn Bus>>,
    log: &Log,
    stop: &Stop,
    streams: &mut Streams,
) -> io::Result<Exit> {
    while !stop.is_asked() {
        let next = session.turn().map_err(io::Error::other)?;
        for line in session.take_lines() {
            log.line(streams, &line, || line.text())?;
        }
        let patience = session.station.bus.now() + PATIENCE;
        session.station.bus.wait(next.min(patience)).map_err(io::Error::other)?;
    }
    Ok(Exit::Clean)
}

fn watch(session: &mut Session<Box<dyn Bus>>, mut view: View, stop: &Stop) -> io::Result<Exit> {
    let mut screen = Screen::open()?;
    let mut next_picture = session.station.bus.now();
    while !stop.is_asked() && !screen.is_left()? {
        let next = session.turn().map_err(io::Error::other)?;
        view.add(session.take_lines());
        let now = session.station.bus.now();
        if now >= next_picture {
            screen.show(&view, &session.station.device, session.time())?;
            next_picture = now + Screen::INTERVAL;
        }
        session.station.bus.wait(next.min(next_picture)).map_err(io::Error::other)?;
    }
    Ok(Exit::Clean)
}
