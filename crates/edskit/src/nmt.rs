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
    let answer = wait_for_boot_up(&mut *bus, node, time_out).map_err(io::Error::other)?;
    let doubt = match answer {
        Answer::BootUp => return told(streams, &format!("{whom} told to {what}, and it has booted up")),
        Answer::OtherState => {
            "although it is there, as its heartbeat shows: perhaps it takes longer, which --timeout allows"
        }
        Answer::Others => "and only others are heard on this bus: is this its node-ID?",
        Answer::Silence => "nor is anything else heard: is it on this bus, with this node-ID and bit rate?",
    };
    streams.complain(format_args!(
        "node {node} was told to {what}, but has not sent its boot-up message within {} ms, {doubt}",
        time_out.0 / 1_000
    ));
    Ok(Exit::Failed)
}

/// What is heard after a node was told to reset itself.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Answer {
    Silence,
    /// Frames that are not its heartbeat.
    Others,
    /// Its heartbeat, and no boot-up message.
    OtherState,
    BootUp,
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

/// Waits for the boot-up message; the most that was heard is what counts.
fn wait_for_boot_up(
    bus: &mut dyn Bus,
    node: NodeId,
    time_out: Microseconds,
) -> Result<Answer, edskit_host::BusError> {
    let deadline = bus.now() + time_out;
    let error_control = Party::Heartbeat.predefined_can_id(node);
    let mut answer = Answer::Silence;
    while bus.now() < deadline && answer < Answer::BootUp {
        match bus.receive()? {
            Some(received) => {
                let frame = received.frame;
                let is_its_state = Some(frame.can_id()) == error_control && !frame.is_remote();
                answer = answer.max(match frame.data() {
                    [0] if is_its_state => Answer::BootUp,
                    _ if is_its_state => Answer::OtherState,
                    _ => Answer::Others,
                });
            }
            None => bus.wait(deadline)?,
        }
    }
    Ok(answer)
}

#[cfg(test)]
mod tests {
    use super::*;
    use edskit_host::VirtualBus;
    use edskit_types::Bitrate;

    #[test]
    fn the_answer_to_a_reset_is_the_most_that_was_heard() {
        let answer = |frames: &[(u16, &[u8])]| {
            let bus = VirtualBus::new(Bitrate::Kbit1000);
            let (mut tool, mut others) = (bus.attach(), bus.attach());
            for (can_id, data) in frames {
                others.send(&Frame::new(CanId::standard(*can_id).unwrap(), data)).unwrap();
            }
            let answer = wait_for_boot_up(&mut tool, NodeId::new(5).unwrap(), Microseconds(100_000)).unwrap();
            (answer, tool.now().0 >= 100_000)
        };
        assert_eq!(answer(&[]), (Answer::Silence, true));
        assert_eq!(answer(&[(0x706, &[0]), (0x185, &[0])]), (Answer::Others, true));
        assert_eq!(answer(&[(0x705, &[5]), (0x080, &[])]), (Answer::OtherState, true));
        assert_eq!(answer(&[(0x705, &[5]), (0x705, &[0])]), (Answer::BootUp, false));
    }
}
