//! The gateway on a bus with others, in the time of that bus.

use super::MANUAL_TIMING;
use super::scenario::Step;
use super::session::{LiveGateway, Session};
use super::view::{Screen, View};
use crate::cli::RunArguments;
use crate::live::{Log, PATIENCE, Stop, TraceFile};
use crate::run::{Connected, connect};
use crate::{Exit, Streams};
use edskit_host::{Bus, system_now};
use std::io;

/// Runs the gateway until it is asked to end, with a log or with a view.
pub(super) fn run(
    device: LiveGateway,
    steps: Vec<Step>,
    arguments: &RunArguments,
    record: Option<TraceFile>,
    streams: &mut Streams,
) -> io::Result<Exit> {
    if let (Some(asked), Some(own)) = (arguments.bit_rate, device.bit_rate())
        && asked != own
    {
        return Err(io::Error::other(format!(
            "the gateway's bit rate is its parameter P426, {own}: it would hear nothing at {asked}"
        )));
    }
    let bit_rate = device.bit_rate().or(arguments.bit_rate).unwrap_or(MANUAL_TIMING);
    let Connected { bus, reachable, _hub } =
        connect(arguments, bit_rate, record).map_err(io::Error::other)?;
    let stop = Stop::on_request().map_err(io::Error::other)?;
    let mut session = Session::new(device, bus, None, steps);
    if arguments.log.is_some() || !streams.is_terminal {
        let log = Log::new(arguments.log.unwrap_or_default());
        log.reachable(streams, &reachable)?;
        return print(&mut session, &log, &stop, streams);
    }
    let where_it_is = match &reachable[..] {
        [] => arguments.bus.to_string(),
        addresses => {
            let addresses: Vec<_> =
                addresses.iter().map(|(protocol, at)| format!("{protocol} {at}")).collect();
            addresses.join(", ")
        }
    };
    watch(&mut session, View::new(where_it_is), &stop)
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
    // Pictures are for eyes, so they follow the clock even where the time of the bus does not.
    let mut next_picture = system_now();
    while !stop.is_asked() && !screen.is_left()? {
        let next = session.turn().map_err(io::Error::other)?;
        view.add(session.take_lines());
        let now = system_now();
        if now >= next_picture {
            screen.show(&view, &session.station.device, session.time())?;
            next_picture = now + Screen::INTERVAL;
        }
        let patience = session.station.bus.now() + Screen::INTERVAL;
        session.station.bus.wait(next.min(patience)).map_err(io::Error::other)?;
    }
    Ok(Exit::Clean)
}
