//! What holds on a microcontroller: the crates of the device half know no operating system, and a firmware stays small.

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

/// The most bytes of flash that the firmware with every service takes, and of memory that its node takes: what they were
/// when they were measured last, and a little more for another compiler.
const MOST_FLASH: u64 = 31_800;
const MOST_MEMORY: u64 = 1_700;

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

/// Whether a firmware with every service fits into so much flash and memory, and has nothing that panics.
pub(crate) fn firmware() -> Outcome {
    with_toolchain(|bin| {
        let mut build = cargo(bin);
        build.current_dir(root().join(FIRMWARE)).args(["build", "--release"]);
        let eds = shared().join("conformance/full.eds");
        if !eds.is_file() {
            return Outcome::LeftOut(format!("{} is no file", eds.display()));
        }
        let target = root().join("target/firmware");
        let eds = eds.canonicalize().unwrap_or(eds);
        match run(build.env("EDSKIT_FIRMWARE_EDS", eds).env("CARGO_TARGET_DIR", &target)) {
            Outcome::Passed => judge(&target.join(USUAL).join("release/firmware")),
            outcome => outcome,
        }
    })
}

fn judge(program: &Path) -> Outcome {
    let (Some(sections), Some(symbols)) = (output("size", program), output("nm", program)) else {
        return Outcome::LeftOut("there is no `size` or no `nm`, which binutils have".to_owned());
    };
    let numbers = sections.lines().nth(1).unwrap_or_default().split_whitespace();
    let numbers: Vec<u64> = numbers.map_while(|number| number.parse().ok()).collect();
    let [code, data, zeroed, ..] = numbers[..] else {
        return Outcome::Failed(format!("`size` says\n{sections}"));
    };
    let (flash, memory) = (code + data, data + zeroed);
    say(format_args!(
        "flash {flash} bytes of at most {MOST_FLASH}, memory {memory} of at most {MOST_MEMORY}"
    ));
    if let Some(panicking) = symbols.lines().find(|line| line.contains("panic")) {
        return Outcome::Failed(format!("the firmware can panic: {panicking}"));
    }
    if flash > MOST_FLASH || memory > MOST_MEMORY {
        return Outcome::Failed("the firmware has grown".to_owned());
    }
    Outcome::Passed
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
