//! Layer setting services (CiA 305).

use super::Message;
use edskit_types::Bitrate;
use serde::Serialize;

/// An LSS message.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub(crate) struct Lss {
    /// Whether it comes from the master.
    pub(crate) is_request: bool,
    pub(crate) what: String,
}

/// The parts of an LSS address, in the order of the command specifiers.
const PARTS: [&str; 4] = ["vendor-ID", "product code", "revision number", "serial number"];
const RANGES: [&str; 6] = [
    "vendor-ID",
    "product code",
    "lowest revision number",
    "highest revision number",
    "lowest serial number",
    "highest serial number",
];

impl Lss {
    pub(super) fn of_request(data: &[u8]) -> Option<Message> {
        let &[command, a, b, c, d, e, f, g] = data else { return None };
        let number = u32::from_le_bytes([a, b, c, d]);
        let hex = format!("{number:08X}h");
        let what = match command {
            0x04 if a == 0 => "switch all to the state waiting".to_owned(),
            0x04 if a == 1 => "switch all to the state configuration".to_owned(),
            0x04 => format!("switch all to an unknown state, {a}"),
            0x11 if a == 0xFF => "take the node-ID away".to_owned(),
            0x11 => format!("configure node-ID {a}"),
            0x13 => match Bitrate::from_lss_index(b) {
                Some(bit_rate) if a == 0 => format!("configure {bit_rate}"),
                _ if a == 0 && b == 9 => "configure automatic bit rate detection".to_owned(),
                _ => format!("configure bit timing {b} of table {a}"),
            },
            0x15 => format!("activate bit timing in {} ms", u16::from_le_bytes([a, b])),
            0x17 => "store the configuration".to_owned(),
            0x40..=0x43 => format!("switch selectively, {} {hex}", PARTS[usize::from(command - 0x40)]),
            0x46..=0x4B => format!("identify, {} {hex}", RANGES[usize::from(command - 0x46)]),
            0x4C => "identify nodes without node-ID".to_owned(),
            0x51 if e == 0x80 => "fast scan, begin".to_owned(),
            0x51 => {
                let name = |part: u8| PARTS.get(usize::from(part)).copied().unwrap_or("unknown part");
                format!("fast scan, {} {hex}, bits from {e} on, then {}", name(f), name(g))
            }
            0x5A..=0x5D => format!("inquire {}", PARTS[usize::from(command - 0x5A)]),
            0x5E => "inquire node-ID".to_owned(),
            _ => format!("unknown command {command:02X}h"),
        };
        Some(Message::Lss(Self { is_request: true, what }))
    }

    pub(super) fn of_response(data: &[u8]) -> Option<Message> {
        let &[command, a, b, c, d, ..] = data else { return None };
        let number = u32::from_le_bytes([a, b, c, d]);
        let outcome = |what: &str, errors: &[&str]| match a {
            0 => format!("{what}: done"),
            0xFF => format!("{what}: refused, error {b} of the manufacturer"),
            error => {
                let meaning = errors.get(usize::from(error) - 1).copied().unwrap_or("unknown error");
                format!("{what}: refused, {meaning}")
            }
        };
        let what = match command {
            0x11 => outcome("configure node-ID", &["node-ID out of range"]),
            0x13 => outcome("configure bit timing", &["bit rate not supported"]),
            0x17 => outcome("store the configuration", &["storing not supported", "storage not accessible"]),
            0x44 => "selected".to_owned(),
            0x4F => "here is one, identified or found by the scan".to_owned(),
            0x50 => "here is one without node-ID".to_owned(),
            0x5A..=0x5D => format!("{} is {number:08X}h", PARTS[usize::from(command - 0x5A)]),
            0x5E if a == 0xFF => "there is no node-ID".to_owned(),
            0x5E => format!("node-ID is {a}"),
            _ => format!("unknown command {command:02X}h"),
        };
        (data.len() == 8).then_some(Message::Lss(Self { is_request: false, what }))
    }
}
