//! Why a node has not answered, by what was heard on the bus meanwhile.

use super::reasons::{Request, WITHOUT_BLOCKS};
use crate::cli::TransferKind;
use crate::value::hex;
use edskit_host::sdo::{Heard, SdoChannel};
use edskit_runtime::Frame;
use edskit_types::{Index, NmtState, SubIndex};

/// What helps to understand silence, in whole sentences: the nearest reason first, and none that the bus contradicts.
pub(super) fn on_silence(request: &Request<'_>, heard: &Heard) -> Vec<String> {
    let node = request.node;
    let mut reasons = Vec::new();
    if heard.without_blocks {
        reasons.push("It was asked for blocks first, and when that failed for segments.".to_owned());
    }
    let first = reasons.len();
    if let Some(frame) = &heard.untaken {
        reasons.push(on_untaken(request, frame, heard));
    }
    if let Some(frame) = &heard.other_client {
        reasons.push(format!(
            "Another SDO client uses node {node} at the same time: it has sent {}. A server does one transfer after the \
             other.",
            hex(frame.data())
        ));
    }
    let state = heard.state.and_then(NmtState::from_code);
    if heard.has_booted_up {
        reasons.push(format!(
            "Node {node} has sent its boot-up message meanwhile: it was reset or switched on, and what it was asked is \
             lost. Try again."
        ));
    } else if state == Some(NmtState::Stopped) {
        reasons.push(format!(
            "Node {node} says that it is stopped, and then it answers no SDO: `edskit nmt {node} preop` wakes it up."
        ));
    } else if heard.answers > 0 {
        let count = match heard.answers {
            1 => "once".to_owned(),
            count => format!("{count} times"),
        };
        reasons.push(format!(
            "Node {node} has answered {count} and then fallen silent: perhaps it needs longer, which --timeout gives it, \
             or it has left the bus."
        ));
    } else if heard.is_there && reasons.len() == first {
        let channel = SdoChannel::of_node(node);
        let sign = match state {
            Some(state) => format!("it says that it is {state}"),
            None => "it sends other messages".to_owned(),
        };
        reasons.push(format!(
            "Node {node} is there, {sign}, but it does not answer: perhaps it needs longer, which --timeout gives it, or \
             it has no SDO server on {} and {}.",
            channel.request, channel.response
        ));
    }
    let is_away = heard.has_booted_up || state == Some(NmtState::Stopped);
    let is_silent = reasons.len() == first;
    if request.transfer == TransferKind::Block && heard.answers == 0 && !is_away {
        reasons.push(WITHOUT_BLOCKS.to_owned());
    }
    if is_silent {
        reasons.push(if heard.has_others {
            format!("Others are heard on this bus, but not node {node}: perhaps no node has this node-ID.")
        } else {
            format!(
                "Nothing else is heard on this bus either: perhaps no node with node-ID {node} is on it, or it runs with \
                 another bit rate."
            )
        });
        reasons.push(format!(
            "A node in the state stopped answers no SDO: `edskit nmt {node} preop` wakes it up. `edskit monitor` shows \
             who is there."
        ));
    }
    reasons
}

/// What came on the identifier of the answer, and why it is none.
fn on_untaken(request: &Request<'_>, frame: &Frame, heard: &Heard) -> String {
    let node = request.node;
    let channel = SdoChannel::of_node(node);
    if frame.is_remote() {
        return format!(
            "Somebody asks for {} by a remote frame, which SDO does not know (CiA 301 v4.2, 7.2.4.3).",
            channel.response
        );
    }
    let Ok(message) = <[u8; 8]>::try_from(frame.data()) else {
        return format!(
            "Node {node} answers, but not with an SDO message, which always has 8 bytes, whatever of them is used (CiA 301 \
             v4.2, 7.2.4.3): a fault of the node, or of a gateway on the way."
        );
    };
    let asked = (request.index, request.sub_index);
    match place_of(message) {
        Some(place) if place == asked && request.transfer == TransferKind::Block && is_ordinary(message) => {
            "It is how any other request than one for blocks is answered.".to_owned()
        }
        Some(place) if place == asked => {
            "It is about this entry, but answers another kind of request.".to_owned()
        }
        // Who else has asked is said behind it.
        Some((index, sub_index)) if heard.other_client.is_some() => {
            format!("It is about {index}:{sub_index}.")
        }
        Some((index, sub_index)) => format!(
            "It is about {index}:{sub_index}: perhaps the late answer to an earlier request, or that to another SDO client; \
             `edskit monitor` shows it."
        ),
        None if heard.other_client.is_some() => "It belongs to another transfer.".to_owned(),
        None => "It belongs to another step or another transfer: perhaps it comes late or twice, or is for another SDO \
                 client; `edskit monitor` shows it."
            .to_owned(),
    }
}

/// The place that an answer names, if it is of a kind that names one.
fn place_of(message: [u8; 8]) -> Option<(Index, SubIndex)> {
    let [command, low, high, sub_index, ..] = message;
    let names_place = match command >> 5 {
        2..=4 => true,
        5 => command & 3 == 0,
        6 => command & 1 == 0,
        _ => false,
    };
    names_place.then(|| (Index(u16::from_le_bytes([low, high])), SubIndex(sub_index)))
}

/// Whether this is how a transfer begins that is none in blocks.
fn is_ordinary(message: [u8; 8]) -> bool {
    matches!(message[0] >> 5, 2 | 3)
}
