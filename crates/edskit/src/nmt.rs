//! `edskit nmt`: commands of the NMT master (CiA 301 v4.2, 7.2.8.2.1).

use crate::cli::{NmtArguments, NmtTarget};
use crate::live::attach;
use crate::{Exit, Streams};
use edskit_host::Bus;
use edskit_runtime::{Frame, Microseconds};
use edskit_types::{CanId, NmtCommand, NodeId, Party};
use std::io;

pub(crate) fn run(arguments: &NmtArguments, streams: &mut Streams) -> io::Result<Exit> {
    let mut bus = attach(&arguments.connection.bus).map_err(io::Error::other)?;
    let command = arguments.action.command();
    let (node, whom) = match arguments.target {
        NmtTarget::All => (0, "all nodes".to_owned()),
        NmtTarget::Node(node) => (node.get(), format!("node {node}")),
    };
    bus.send(&Frame::new(CanId::NMT, &[command.code(), node])).map_err(io::Error::other)?;
    let what = words(command);
    let NmtTarget::Node(node) = arguments.target else {
        return told(streams, &format!("{whom} told to {what}"));
    };
    if !matches!(command, NmtCommand::ResetNode | NmtCommand::ResetCommunication) {
        return told(streams, &format!("{whom} told to {what}"));
    }
    // Only a reset is answered, with the boot-up message.
    let time_out = arguments.connection.timeout;
    if boots_up(&mut *bus, node, time_out).map_err(io::Error::other)? {
        return told(streams, &format!("{whom} told to {what}, and it has booted up"));
    }
    streams.complain(format_args!(
        "node {node} was told to {what}, but has not sent its boot-up message within {} ms: is it on this bus, with this \
         node-ID and bit rate?",
        time_out.0 / 1_000
    ));
    Ok(Exit::Failed)
}

fn told(streams: &mut Streams, text: &str) -> io::Result<Exit> {
    writeln!(streams.stdout, "{text}")?;
    streams.stdout.flush()?;
    Ok(Exit::Clean)
}

fn words(command: NmtCommand) -> &'static str {
    match command {
        NmtCommand::Start => "go to operational",
        NmtCommand::Stop => "go to stopped",
        NmtCommand::EnterPreOperational => "go to pre-operational",
        NmtCommand::ResetNode => "reset itself",
        NmtCommand::ResetCommunication => "reset its communication",
    }
}

/// Whether the boot-up message comes in time.
fn boots_up(bus: &mut dyn Bus, node: NodeId, time_out: Microseconds) -> Result<bool, edskit_host::BusError> {
    let deadline = bus.now() + time_out;
    let boot_up = Party::Heartbeat.predefined_can_id(node);
    while bus.now() < deadline {
        match bus.receive()? {
            Some(received) if Some(received.frame.can_id()) == boot_up && received.frame.data() == [0] => {
                return Ok(true);
            }
            Some(_) => {}
            None => bus.wait(deadline)?,
        }
    }
    Ok(false)
}
