//! Services whose frames stand for themselves.

use super::Message;
use crate::value;
use edskit_types::{DataType, EmergencyCode, ErrorRegister, NmtCommand, NmtState};

/// The toggle bit of guarding, above the seven bits of the state.
const TOGGLE: u8 = 0x80;

/// CiA 301 v4.2, 7.2.8.2.1.
pub(super) fn nmt(data: &[u8]) -> Option<Message> {
    let &[command, node] = data else { return None };
    let command = match NmtCommand::from_code(command) {
        Some(NmtCommand::Start) => "start".to_owned(),
        Some(NmtCommand::Stop) => "stop".to_owned(),
        Some(NmtCommand::EnterPreOperational) => "enter pre-operational".to_owned(),
        Some(NmtCommand::ResetNode) => "reset node".to_owned(),
        Some(NmtCommand::ResetCommunication) => "reset communication".to_owned(),
        None => format!("unknown command {command:02X}h"),
    };
    Some(Message::Nmt { command, node: (node != 0).then_some(node) })
}

/// CiA 301 v4.2, 7.2.5.
pub(super) fn sync(data: &[u8]) -> Option<Message> {
    match *data {
        [] => Some(Message::Sync { counter: None }),
        [counter] => Some(Message::Sync { counter: Some(counter) }),
        _ => None,
    }
}

/// CiA 301 v4.2, 7.2.6.
pub(super) fn time(data: &[u8]) -> Option<Message> {
    (data.len() == 6).then(|| Message::Time { time: value::text(DataType::TimeOfDay, data) })
}

/// CiA 301 v4.2, 7.2.7.
pub(super) fn emcy(node: u8, data: &[u8]) -> Option<Message> {
    let &[low, high, register, ref info @ ..] = data else { return None };
    let code = EmergencyCode(u16::from_le_bytes([low, high]));
    (info.len() == 5).then(|| Message::Emcy {
        node,
        code: code.0,
        meaning: code.meaning(),
        error_register: register,
        errors: ErrorRegister(register).names().collect(),
        info: value::hex(info),
    })
}

/// Boot-up, heartbeat, or the answer of a node that is guarded (CiA 301 v4.2, 7.2.8.3).
pub(super) fn error_control(node: u8, is_guarded: bool, data: &[u8]) -> Option<Message> {
    let &[byte] = data else { return None };
    let toggle = byte & TOGGLE != 0;
    let code = byte & !TOGGLE;
    let state =
        NmtState::from_code(code).map_or_else(|| format!("unknown state {code}"), |state| state.to_string());
    Some(match byte {
        0 => Message::BootUp { node },
        _ if is_guarded || toggle => Message::Guarding { node, state, toggle },
        _ => Message::Heartbeat { node, state },
    })
}
