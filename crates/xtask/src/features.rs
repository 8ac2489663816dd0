//! The services of the runtime that a device can do without: that each set of them builds and holds, and what it takes.

use crate::step::{Outcome, cargo, run};

/// Every feature of `edskit-runtime`.
pub(crate) const ALL: &[&str] = &[
    "block-transfer",
    "further-sdo-servers",
    "guarding",
    "heartbeat-consumer",
    "lss",
    "rtr",
    "storage",
    "sync",
    "time",
];

/// A firmware, and the most bytes that it takes: what they were when they were measured last, and a little more for
/// another compiler.
pub(crate) struct Firmware {
    /// The services that it lacks.
    pub(crate) without: &'static [&'static str],
    pub(crate) eds: Eds,
    pub(crate) most_flash: i64,
    pub(crate) most_memory: i64,
}

/// The device of a firmware.
#[derive(PartialEq)]
pub(crate) enum Eds {
    /// That of the conformance check, which claims every service.
    Full,
    /// A small slave.
    Small,
}

/// What is measured. The first one is what the others are compared with.
pub(crate) const FIRMWARES: &[Firmware] = &[
    firmware(&[], Eds::Full, 29_600, 1_700),
    firmware(&["block-transfer"], Eds::Full, 28_000, 1_700),
    firmware(&["further-sdo-servers"], Eds::Full, 29_300, 1_700),
    firmware(&["guarding"], Eds::Full, 28_800, 1_700),
    firmware(&["heartbeat-consumer"], Eds::Full, 28_700, 1_650),
    firmware(&["lss"], Eds::Full, 27_700, 1_700),
    firmware(&["rtr"], Eds::Full, 29_100, 1_700),
    firmware(&["storage"], Eds::Full, 26_900, 1_700),
    firmware(&["sync"], Eds::Full, 27_800, 1_700),
    firmware(&["time"], Eds::Full, 29_100, 1_700),
    firmware(ALL, Eds::Full, 20_200, 1_600),
    firmware(ALL, Eds::Small, 19_300, 1_300),
];

const fn firmware(without: &'static [&'static str], eds: Eds, most_flash: i64, most_memory: i64) -> Firmware {
    Firmware { without, eds, most_flash, most_memory }
}

/// A firmware, for a person.
pub(crate) fn title(firmware: &Firmware) -> String {
    match (firmware.without, &firmware.eds) {
        ([], _) => "every service".to_owned(),
        ([one], _) => format!("without {one}"),
        (_, Eds::Full) => "without all of them".to_owned(),
        (_, Eds::Small) => "small slave".to_owned(),
    }
}

/// Whether the runtime builds without a warning with each service alone and with all but one, and its tests hold without
/// any. With all of them the other steps see it.
pub(crate) fn hold() -> Outcome {
    let alone = ALL.iter().map(|name| (*name).to_owned());
    let all_but = ALL.iter().map(|left| {
        let others: Vec<&str> = ALL.iter().filter(|name| *name != left).copied().collect();
        others.join(",")
    });
    for features in alone.chain(all_but) {
        let mut clippy = cargo(&["clippy", "--quiet", "-p", "edskit-runtime", "--all-targets"]);
        clippy.args(["--no-default-features", "--features", &features, "--", "-D", "warnings"]);
        match run(&mut clippy) {
            Outcome::Passed => {}
            Outcome::Failed(reason) => return Outcome::Failed(format!("with {features}: {reason}")),
            outcome => return outcome,
        }
    }
    run(&mut cargo(&["test", "--quiet", "-p", "edskit-runtime", "--lib", "--no-default-features"]))
}
