//! Nodes in processes of their own.

use crate::root;
use crate::step::{Outcome, cargo, command, run};
use std::env;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;

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

    /// The command that starts it on a bus which it opens itself, at a free port.
    fn command(self, eds: &Path, bus: &str) -> Command {
        let mut start = command(binaries().join(self.binary()), &[]);
        match self {
            Self::Loaded => start.arg("run").arg(eds).args(["--node-id", NODE_ID]),
            Self::Generated => start.args(["--node-id", NODE_ID]),
            Self::Gateway => start.args(["run", "gateway", "--params"]).arg(root().join(GATEWAY)),
        };
        start.args(["--bus", bus, "--listen", "127.0.0.1:0"]);
        start
    }
}

/// Where the programs are.
pub(crate) fn binaries() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from).join("debug")
}

/// Builds the programs, the second one with the dictionary of this file.
pub(super) fn build(eds: &Path) -> Result<(), String> {
    build_programs(&[Program::Loaded, Program::Generated], Some(eds))
}

/// Builds `edskit` as the tests have built it.
pub(crate) fn build_edskit() -> Result<(), String> {
    build_programs(&[Program::Loaded], None)
}

fn build_programs(programs: &[Program], eds: Option<&Path>) -> Result<(), String> {
    // With the whole workspace and one of its tests, so that no dependency has other features than in the tests and is
    // built again.
    let mut build = cargo(&["build", "--quiet", "--workspace", "--test", "layering"]);
    build.args(programs.iter().flat_map(|program| ["--bin", program.binary()]));
    if let Some(eds) = eds {
        build.env("EDSKIT_DEVICE_EDS", eds);
    }
    match run(&mut build) {
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

/// A running node; it ends with this value.
pub(super) struct Node {
    process: Child,
    /// Where its bus is reached: the protocol, and the port.
    ports: Vec<(String, String)>,
}

impl Node {
    /// Starts a node with a hub for the real transports.
    pub(super) fn start(program: Program, eds: &Path) -> Result<Self, String> {
        Self::start_on(program.command(eds, "hub"), 2)
    }

    /// Starts a node with a bus in virtual time.
    pub(super) fn start_virtual(program: Program, eds: &Path) -> Result<Self, String> {
        Self::start_on(program.command(eds, "virtual"), 1)
    }

    /// Starts a node, which says first where each of so many protocols is spoken.
    fn start_on(mut start: Command, protocols: usize) -> Result<Self, String> {
        let name = start.get_program().display().to_string();
        let mut process = start
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| format!("{name}: {error}"))?;
        let output = process.stdout.take().ok_or(format!("{name} has no output"))?;
        let complaints = process.stderr.take().ok_or(format!("{name} has no error output"))?;
        let mut node = Self { process, ports: Vec::new() };
        // Nobody else reads what the node says, and a full pipe would stop it.
        let complaints = thread::spawn(move || io::read_to_string(complaints).unwrap_or_default());
        let mut lines = BufReader::new(output).lines();
        for line in lines.by_ref().map_while(Result::ok).take(protocols) {
            let port =
                line.split_once(' ').and_then(|(protocol, at)| Some((protocol, at.rsplit_once(':')?.1)));
            let (protocol, port) = port.ok_or(format!("{name} says `{line}`"))?;
            node.ports.push((protocol.to_owned(), port.to_owned()));
        }
        if node.ports.len() < protocols {
            let complaints = complaints.join().unwrap_or_default();
            return Err(complaints.lines().last().unwrap_or("it ends without a word").to_owned());
        }
        thread::spawn(move || lines.for_each(drop));
        Ok(node)
    }

    /// The port at which a protocol is spoken.
    pub(super) fn port(&self, protocol: &str) -> Result<&str, String> {
        let port = self.ports.iter().find(|(spoken, _)| spoken == protocol);
        port.map(|(_, port)| port.as_str()).ok_or_else(|| format!("the node does not speak {protocol}"))
    }
}

impl Drop for Node {
    fn drop(&mut self) {
        // A process that has ended already cannot be ended again, and that is no matter.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
