//! Words for PDOs: what they carry, and why they are active or not.

use super::signals::KnownSignals;
use edskit_devices::gateway::{Activity, Configuration, Hindrance, Parameter, Pdo, Source};

/// Milliseconds with as many digits as they need.
pub(crate) fn milliseconds(micros: u32) -> String {
    (f64::from(micros) / 1000.0).to_string()
}

/// Why gateway and governor do not hear each other with these parameters; `None` where they do (GW-CFG-48).
pub(crate) fn apart(configuration: &Configuration) -> Option<String> {
    let is =
        |parameter: Parameter| format!("{parameter} is {}", parameter.amount(configuration.get(parameter)));
    let reasons = configuration.hindrances().map(|hindrance| match hindrance {
        Hindrance::SwitchedOff(parameter) => is(parameter),
        Hindrance::NodeNumbers { gateway, governor } | Hindrance::BitRates { gateway, governor } => {
            format!("{} in the gateway, and {} in the governor", is(gateway), is(governor))
        }
    });
    let reasons: Vec<String> = reasons.collect();
    (!reasons.is_empty()).then(|| reasons.join("; "))
}

/// What a word of a PDO is.
pub(crate) fn content(configuration: &Configuration, signals: &KnownSignals, source: Source) -> String {
    match source {
        Source::Dummy => "-".to_owned(),
        Source::Errors { first } => format!("errors {first} to {}", first + 15),
        Source::EngineStatus => "engine status".to_owned(),
        Source::Signal { number, .. } => signals.title(number),
        Source::SwitchFunctions => "switch functions".to_owned(),
        Source::SensorFlags => "error flags of sensors".to_owned(),
        Source::Sensor { channel } => {
            let sensors = configuration.sensors();
            let own = sensors.filter(|input| input.target.channel() == Some(channel));
            let names: Vec<String> = own.map(|input| input.assignment.to_string()).collect();
            names.join(" and ")
        }
    }
}

/// Why a PDO is active or not.
pub(crate) fn why(configuration: &Configuration, pdo: &Pdo) -> String {
    let count = |count: usize, what: &str| match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    };
    let functions = || configuration.switch_functions().filter(|input| input.target.is_assigned()).count();
    let sensors = || configuration.sensors().filter(|input| input.target.is_assigned()).count();
    let selecting = || match pdo.number {
        3 => Parameter::SEND_STATUS,
        _ => Parameter::SEND_ERRORS,
    };
    match pdo.activity {
        Activity::Selected => format!("{} is 1", selecting()),
        Activity::NotSelected => format!("{} is 0", selecting()),
        Activity::DataAndCycle => "data and a cycle time".to_owned(),
        Activity::NoCycle => "no cycle time".to_owned(),
        Activity::NoData => "no data".to_owned(),
        Activity::NeitherDataNorCycle => "no data, no cycle time".to_owned(),
        Activity::SwitchFunctions => count(functions(), "switch function"),
        Activity::SensorFlags => format!("error flags of {}", count(sensors(), "sensor")),
        Activity::SwitchFunctionsAndSensorFlags => {
            format!("{}, {}", count(functions(), "switch function"), count(sensors(), "sensor"))
        }
        Activity::NoInputs => "no switch function, no sensor".to_owned(),
        Activity::Sensors => {
            let words = pdo.words().iter().filter(|word| matches!(word.source, Source::Sensor { .. }));
            count(words.count(), "sensor")
        }
        Activity::NoSensors => "no sensor".to_owned(),
    }
}
