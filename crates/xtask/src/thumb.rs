//! What holds on a microcontroller: the crates of the device half know no operating system, and a firmware stays small.

use crate::features::{ALL, Eds, FIRMWARES, Firmware, title};
use crate::python::shared;
use crate::root;
use crate::say;
use crate::step::{Outcome, command, run};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Processors without atomic compare-and-swap: the smallest that are in use.
const SMALLEST: &str = "thumbv6m-none-eabi";
/// The processor that sizes are compared on.
const USUAL: &str = "thumbv7m-none-eabi";
/// A toolchain that `.ci/run` makes where that of the machine lacks the targets.
const OWN_TOOLCHAIN: &str = "target/thumb-toolchain/bin";
const FIRMWARE: &str = "tests/firmware";

/// A small slave of its own: NMT, heartbeat, SDO, two PDOs of each direction, EMCY.
const SMALL: &str = "tests/firmware/Small.eds";

/// Whether the crates of a device compile without an operating system.
pub(crate) fn no_std() -> Outcome {
    with_toolchain(|bin| {
        let mut check = cargo(bin);
        check.env("CARGO_TARGET_DIR", root().join("target/thumb"));
        // The generator runs once, in a build script: it need not be fast, but soon built.
        for name in ["codegen", "lint", "model"] {
            check.arg("--config").arg(format!("profile.dev.package.edskit-{name}.opt-level=0"));
        }
        let crates = ["edskit-types", "edskit-runtime", "edskit-devices"].map(|name| ["-p", name]);
        run(check.args(["check", "--target", SMALLEST]).args(crates.as_flattened()))
    })
}

/// What firmwares take with every service, without each, and with none, and whether they have grown or can panic.
pub(crate) fn firmware() -> Outcome {
    with_toolchain(|bin| {
        let full = shared().join("conformance/full.eds");
        if !full.is_file() {
            return Outcome::LeftOut(format!("{} is no file", full.display()));
        }
        let full = full.canonicalize().unwrap_or(full);
        let (mut all, mut outcome) = (None, Outcome::Passed);
        for firmware in FIRMWARES {
            let Firmware { without, eds, most_flash, most_memory } = firmware;
            let features = ALL.iter().filter(|name| !without.contains(name));
            let features: Vec<String> = features.map(|name| format!("edskit-runtime/{name}")).collect();
            let eds = if *eds == Eds::Small { root().join(SMALL) } else { full.clone() };
            let target = root().join("target/firmware");
            let mut build = cargo(bin.clone());
            build.current_dir(root().join(FIRMWARE)).args(["build", "--quiet", "--release"]);
            build.args(["--no-default-features", "--features", &features.join(",")]);
            build.env("EDSKIT_FIRMWARE_EDS", eds).env("CARGO_TARGET_DIR", &target);
            match run(&mut build) {
                Outcome::Passed => {}
                failed => return failed,
            }
            let (flash, memory) = match measure(&target.join(USUAL).join("release/firmware")) {
                Ok(measured) => measured,
                Err(outcome) => return outcome,
            };
            let (all_flash, all_memory) = *all.get_or_insert((flash, memory));
            say(format_args!(
                "{:27} flash {flash:>6} of at most {most_flash:>6} ({:+}), memory {memory:>5} of at most {most_memory:>5} ({:+})",
                title(firmware),
                flash - all_flash,
                memory - all_memory,
            ));
            if flash > *most_flash || memory > *most_memory {
                outcome = Outcome::Failed(format!("the firmware has grown: {}", title(firmware)));
            }
        }
        outcome
    })
}

/// The bytes of flash and of memory that a firmware takes.
fn measure(program: &Path) -> Result<(i64, i64), Outcome> {
    let (Some(sections), Some(symbols)) = (output("size", program), output("nm", program)) else {
        return Err(Outcome::LeftOut("there is no `size` or no `nm`, which binutils have".to_owned()));
    };
    let numbers = sections.lines().nth(1).unwrap_or_default().split_whitespace();
    let numbers: Vec<i64> = numbers.map_while(|number| number.parse().ok()).collect();
    let [code, data, zeroed, ..] = numbers[..] else {
        return Err(Outcome::Failed(format!("`size` says\n{sections}")));
    };
    if let Some(panicking) = symbols.lines().find(|line| line.contains("panic")) {
        return Err(Outcome::Failed(format!("the firmware can panic: {panicking}")));
    }
    Ok((code + data, data + zeroed))
}

/// What a tool says about a program.
fn output(tool: &str, program: &Path) -> Option<String> {
    let output = Command::new(tool).arg(program).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Runs something with a toolchain that has both targets: that of the machine, or the one of `.ci/run`.
fn with_toolchain(act: impl FnOnce(Option<PathBuf>) -> Outcome) -> Outcome {
    let own = root().join(OWN_TOOLCHAIN);
    if has_targets(&mut command("rustc", &[])) {
        act(None)
    } else if has_targets(&mut command(own.join("rustc"), &[])) {
        act(Some(own))
    } else {
        Outcome::LeftOut(format!("the toolchain lacks the targets: `rustup target add {SMALLEST} {USUAL}`"))
    }
}

/// Whether a compiler has the libraries of both targets.
fn has_targets(rustc: &mut Command) -> bool {
    let Ok(output) = rustc.args(["--print", "sysroot"]).output() else { return false };
    let sysroot = PathBuf::from(String::from_utf8_lossy(&output.stdout).trim());
    let has = |target: &&str| sysroot.join("lib/rustlib").join(target).join("lib").is_dir();
    output.status.success() && [SMALLEST, USUAL].iter().all(has)
}

/// The cargo of a toolchain, or that of the machine.
fn cargo(bin: Option<PathBuf>) -> Command {
    let Some(bin) = bin else { return crate::step::cargo(&[]) };
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = [bin.clone()].into_iter().chain(std::env::split_paths(&path));
    let mut cargo = command(bin.join("cargo"), &[]);
    // What this task's own cargo has set would lead back to its toolchain.
    cargo.env_remove("RUSTUP_TOOLCHAIN").env_remove("RUSTC").env_remove("CARGO");
    cargo.env("PATH", std::env::join_paths(folders).unwrap_or(path));
    cargo
}
