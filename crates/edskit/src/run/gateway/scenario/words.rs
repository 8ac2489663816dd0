//! The words of a scenario.

use edskit_devices::gateway::{Fault, Owner, State};
use edskit_types::NmtCommand;

/// The keys of a step beside `at`, in the order in which they are carried out.
pub(in crate::run::gateway) const KEYS: [&str; 18] = [
    "off",
    "on",
    "reset",
    "gateway",
    "governor",
    "pc-tool",
    "store",
    "supply",
    "eeprom",
    "engine",
    "engine-error",
    "engine-error-gone",
    "inject",
    "remove",
    "clear-errors",
    "command",
    "nmt",
    "read",
];

/// The two control units.
pub(in crate::run::gateway) const UNITS: [(&str, Owner); 2] =
    [("gateway", Owner::Gateway), ("governor", Owner::Governor)];

/// What the governor can command (3; GW-NMT-03).
pub(super) const COMMANDS: [(&str, State); 3] =
    [("undefined", State::Undefined), ("init", State::Init), ("pre-operational", State::PreOperational)];

/// What the NMT master can command.
pub(super) const NMT: [(&str, NmtCommand); 5] = [
    ("start", NmtCommand::Start),
    ("stop", NmtCommand::Stop),
    ("pre-operational", NmtCommand::EnterPreOperational),
    ("reset-node", NmtCommand::ResetNode),
    ("reset-communication", NmtCommand::ResetCommunication),
];

/// The word for a meaning, which the table has.
pub(in crate::run::gateway) fn word_for<T: Copy + PartialEq>(
    words: &[(&'static str, T)],
    meaning: T,
) -> &'static str {
    words.iter().find(|(_, own)| *own == meaning).map_or("", |(word, _)| word)
}

/// The word for a fault.
pub(in crate::run::gateway) fn fault_name(fault: Fault) -> &'static str {
    match fault {
        Fault::LinkBroken => "link-broken",
        Fault::GatewayCanBus1 => "gateway-can-bus-1",
        Fault::GatewayTransmitBuffer1 => "gateway-transmit-buffer-1",
        Fault::GatewayReceiveBuffer1 => "gateway-receive-buffer-1",
        Fault::CanOpenBuffer1 => "canopen-buffer-1",
        Fault::DuplicateGateway => "duplicate-gateway",
        Fault::GatewayCanBus2 => "gateway-can-bus-2",
        Fault::ReceiveBuffer2 => "receive-buffer-2",
        Fault::TransmitBuffer2 => "transmit-buffer-2",
        Fault::GovernorCanBus => "governor-can-bus",
        Fault::GovernorCanComm => "governor-can-comm",
        Fault::InitTelegrams => "init-telegrams",
        Fault::ParamStore => "param-store",
        Fault::ProgramTest => "program-test",
        Fault::RamTest => "ram-test",
        Fault::Data => "data",
        Fault::Stack => "stack",
        Fault::Intern => "intern",
    }
}
