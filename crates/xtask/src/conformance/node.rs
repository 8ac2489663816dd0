//! Nodes in processes of their own.

use crate::root;
use crate::step::{Outcome, cargo, command, run};
use std::env;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

pub(super) const NODE_ID: &str = "5";

/// A program that is a node. It prints where it listens.
#[derive(Clone, Copy)]
pub(super) enum Program {
    /// `edskit run` with the file.
    Loaded,
    /// A device with a dictionary that is generated from the file.
    Generated,
    /// The gateway, with the parameters of [`GATEWAY`].
    Gateway,
}

/// The parameters of the gateway that is judged: node-ID 5, and PDOs of every kind.
const GATEWAY: &str = "tests/fixtures/gateway/conformance.toml";

impl Program {
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Loaded => "loaded",
            Self::Generated => "generated",
            Self::Gateway => "live",
        }
    }

    fn binary(self) -> &'static str {
        match self {
            Self::Loaded | Self::Gateway => "edskit",
            Self::Generated => "edskit-tests-device",
        }
    }

    fn command(self, eds: &Path) -> Command {
        let mut start = command(binaries().join(self.binary()), &[]);
        match self {
            Self::Loaded => start.arg("run").arg(eds).args(["--node-id", NODE_ID]),
            Self::Generated => start.args(["--node-id", NODE_ID]),
            Self::Gateway => start.args(["run", "gateway", "--params"]).arg(root().join(GATEWAY)),
        };
        start
    }
}

/// Where the programs are.
pub(crate) fn binaries() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from).join("debug")
}

/// Builds the programs, the second one with the dictionary of this file.
pub(super) fn build(eds: &Path) -> Result<(), String> {
    // With the whole workspace, so that no dependency has other features than in the tests and is built again.
    let mut build = cargo(&["build", "--quiet", "--workspace"]);
    build.args([Program::Loaded, Program::Generated].iter().flat_map(|program| ["--bin", program.binary()]));
    match run(build.env("EDSKIT_DEVICE_EDS", eds)) {
        Outcome::Passed => Ok(()),
        outcome => Err(format!("the nodes cannot be built ({outcome})")),
    }
}

/// The DCF of the gateway that is judged: which entries its parameters leave, and what they hold.
pub(super) fn dcf_of_gateway() -> Result<PathBuf, String> {
    let dcf = root().join("target/CANopenGateway.dcf");
    let mut write = command(binaries().join(Program::Gateway.binary()), &["config", "dcf", GATEWAY, "-o"]);
    match run(write.arg(&dcf)) {
        Outcome::Passed => Ok(dcf),
        outcome => Err(format!("the gateway has no DCF ({outcome})")),
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
        let name = program.binary();
        let mut start = program.command(eds);
        start.args(["--listen", "127.0.0.1:0"]).stdout(Stdio::piped());
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
