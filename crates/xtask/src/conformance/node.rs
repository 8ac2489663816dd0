//! Nodes in processes of their own.

use crate::root;
use crate::step::{Outcome, cargo, command, run};
use std::env;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};

pub(super) const NODE_ID: &str = "5";

/// A program that is a node. It takes `--node-id` and `--listen`, and prints where it listens.
#[derive(Clone, Copy)]
pub(super) struct Program {
    /// What its dictionary is.
    pub(super) dictionary: &'static str,
    binary: &'static str,
    /// Whether it is told at its start which file it is to be, with the command `run`.
    takes_file: bool,
}

/// A node that is told at its start which file it is to be.
pub(super) const LOADED: Program = Program { dictionary: "loaded", binary: "edskit", takes_file: true };
/// A node whose dictionary is generated.
pub(super) const GENERATED: Program =
    Program { dictionary: "generated", binary: "edskit-tests-device", takes_file: false };

/// Builds the programs, the second one with the dictionary of this file.
pub(super) fn build(eds: &Path) -> Result<(), String> {
    // With the whole workspace, so that no dependency has other features than in the tests and is built again.
    let mut build = cargo(&["build", "--quiet", "--workspace"]);
    build.args([LOADED, GENERATED].iter().flat_map(|program| ["--bin", program.binary]));
    match run(build.env("EDSKIT_DEVICE_EDS", eds)) {
        Outcome::Passed => Ok(()),
        outcome => Err(format!("the nodes cannot be built ({outcome})")),
    }
}

/// A running node, with the ports that its hub has taken; it ends with this value.
pub(super) struct Node {
    pub(super) program: Program,
    process: Child,
    pub(super) socketcand: String,
    pub(super) slcan: String,
}

impl Node {
    pub(super) fn start(program: Program, eds: &Path) -> Result<Self, String> {
        let name = program.binary;
        let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
        let mut start = command(target.join("debug").join(name), &[]);
        if program.takes_file {
            start.arg("run").arg(eds);
        }
        start.args(["--node-id", NODE_ID, "--listen", "127.0.0.1:0"]).stdout(Stdio::piped());
        let process = start.spawn().map_err(|error| format!("{name}: {error}"))?;
        let mut node = Self { program, process, socketcand: String::new(), slcan: String::new() };
        let output = node.process.stdout.take().ok_or(format!("{name} has no output"))?;
        let mut lines = BufReader::new(output).lines();
        let mut port = |protocol: &str| {
            let line = lines.next().and_then(Result::ok).unwrap_or_default();
            let port = line.strip_prefix(protocol).and_then(|address| address.rsplit_once(':'));
            port.map(|(_, port)| port.to_owned()).ok_or(format!("{name} says `{line}`"))
        };
        (node.socketcand, node.slcan) = (port("socketcand ")?, port("slcan ")?);
        // Nobody else reads what the node says from now on, and a full pipe would stop it.
        std::thread::spawn(move || lines.for_each(drop));
        Ok(node)
    }
}

impl Drop for Node {
    fn drop(&mut self) {
        // A process that has ended already cannot be ended again, and that is no matter.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
