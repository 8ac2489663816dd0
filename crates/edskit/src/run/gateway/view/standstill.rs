//! Why there are no PDOs.

use crate::config::apart;
use crate::run::gateway::scenario::words::fault_name;
use crate::run::gateway::session::LiveGateway;
use edskit_devices::gateway::{INITIALISATION_ATTEMPTS, Standstill};
use edskit_runtime::Microseconds;

/// In words, with the time since when the state lasts; `None` where there is communication on CANopen.
pub(super) fn reason(gateway: &LiveGateway, since: Microseconds) -> Option<String> {
    let reason = match gateway.standstill()? {
        Standstill::GatewayOff => "the gateway has no supply".to_owned(),
        Standstill::InBootloader => {
            format!("3099 is {:04X}h: {}", gateway.eeprom_errors().0, gateway.eeprom_errors())
        }
        Standstill::GatewayStarting => "the program of the gateway has not started".to_owned(),
        Standstill::GovernorOff => "the governor, which initialises the gateway, has no supply".to_owned(),
        Standstill::GovernorStarting => "the program of the governor has not started".to_owned(),
        Standstill::Error(error) => format!("error {error}: {}", error.meaning()),
        Standstill::GovernorError(error) => format!("error {error}: {}", error.meaning()),
        Standstill::Apart => {
            let reason = apart(gateway.effective_parameters()).unwrap_or_default();
            format!("gateway and governor do not hear each other: {reason}")
        }
        Standstill::Fault(fault) => format!("the fault {} lasts", fault_name(fault)),
        Standstill::Refused(refusal) => format!(
            "the initialisation has failed {INITIALISATION_ATTEMPTS} times: {refusal}; it stays so until errors are cleared"
        ),
        Standstill::Commanded => "the governor has commanded it".to_owned(),
        Standstill::Initialising => "the governor initialises the gateway".to_owned(),
    };
    let since = format!("{}.{}", since.0 / 1_000_000, since.0 / 100_000 % 10);
    Some(format!("none while {}, since {since} s: {reason}", gateway.state()))
}
