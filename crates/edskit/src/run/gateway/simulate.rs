//! The gateway in virtual time: the same input gives the same lines and frames.

use super::MANUAL_TIMING;
use super::log::What;
use super::scenario::Step;
use super::session::{LiveGateway, Session};
use crate::live::{Log, TraceFile};
use crate::{Exit, Streams};
use edskit_host::{Bus, Trace, VirtualBus};
use edskit_runtime::Microseconds;
use std::io;

/// Runs the gateway for some time on a bus with the bit rate of its parameters, [`MANUAL_TIMING`] with manual bit timing.
pub(super) fn run(
    device: LiveGateway,
    steps: Vec<Step>,
    duration: Microseconds,
    record: Option<TraceFile>,
    log: &Log,
    streams: &mut Streams,
) -> io::Result<Exit> {
    let bus = VirtualBus::new(device.bit_rate().unwrap_or(MANUAL_TIMING));
    let mut recorder = record.map(|record| Trace::new(bus.attach(), record));
    let mut session = Session::new(device, bus.attach(), Some(bus.attach()), steps);
    let end = session.instant(duration);
    loop {
        let next = session.turn().map_err(io::Error::other)?;
        if let Some(recorder) = &mut recorder {
            while recorder.receive().map_err(io::Error::other)?.is_some() {}
            while let Some(event) = recorder.event() {
                session.tell(What::Bus { message: event.to_string() });
            }
        }
        for line in session.take_lines() {
            log.line(streams, &line, || line.text())?;
        }
        if bus.now() >= end {
            return Ok(Exit::Clean);
        }
        session.station.bus.wait(next.min(end)).map_err(io::Error::other)?;
    }
}
