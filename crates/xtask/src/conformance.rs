//! The independent check of a CANopen slave, against nodes that `edskit run` runs.

use crate::python::{self, shared};
use crate::root;
use crate::say;
use crate::step::{Outcome, cargo, command, run};
use std::env;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

const VENV: &str = "target/conformance-venv";
const REQUIREMENTS: &str = "tests/conformance/requirements.txt";
const NODE_ID: &str = "5";

/// Whether a node made of `full.eds` passes, over socketcand and over SLCAN.
pub(crate) fn of_a_loaded_file() -> Outcome {
    let folder = shared().join("conformance");
    let script = folder.join("conformance.py");
    if !script.is_file() {
        return Outcome::LeftOut(format!("{} is no file", script.display()));
    }
    let python = match python::installed(VENV, REQUIREMENTS) {
        Ok(python) => python,
        Err(reason) => return Outcome::LeftOut(reason),
    };
    let eds = folder.join("full.eds");
    let mut node = match Node::start(&eds) {
        Ok(node) => node,
        Err(reason) => return Outcome::Failed(reason),
    };
    let outcome = [Transport::Socketcand, Transport::Slcan]
        .into_iter()
        .map(|transport| node.check(transport, &python, &script, &eds))
        .find(|outcome| !matches!(outcome, Outcome::Passed));
    node.stop();
    outcome.unwrap_or(Outcome::Passed)
}

#[derive(Clone, Copy)]
enum Transport {
    Socketcand,
    Slcan,
}

/// A node in a process of its own, with the ports that its hub has taken.
struct Node {
    process: Child,
    socketcand: String,
    slcan: String,
}

impl Node {
    fn start(eds: &Path) -> Result<Self, String> {
        // With the whole workspace, so that no dependency has other features than in the tests and is built again.
        match run(&mut cargo(&["build", "--quiet", "--workspace", "--bin", "edskit"])) {
            Outcome::Passed => {}
            outcome => return Err(format!("edskit cannot be built ({outcome})")),
        }
        let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
        let mut start = command(target.join("debug/edskit"), &["run"]);
        start.arg(eds).args(["--node-id", NODE_ID, "--listen", "127.0.0.1:0"]);
        let mut process =
            start.stdout(Stdio::piped()).spawn().map_err(|error| format!("edskit run: {error}"))?;
        let output = process.stdout.take().ok_or("edskit run has no output")?;
        let mut lines = BufReader::new(output).lines();
        let mut port = |protocol: &str| {
            let line = lines.next().and_then(Result::ok).unwrap_or_default();
            let port = line.strip_prefix(protocol).and_then(|address| address.rsplit_once(':'));
            port.map(|(_, port)| port.to_owned()).ok_or(format!("edskit run says `{line}`"))
        };
        let (socketcand, slcan) = (port("socketcand ")?, port("slcan ")?);
        // Nobody else reads what the node says from now on, and a full pipe would stop it.
        std::thread::spawn(move || lines.for_each(drop));
        Ok(Self { process, socketcand, slcan })
    }

    /// Runs the check. What fails is run again by itself: on a busy machine an answer can come late once.
    fn check(&mut self, transport: Transport, python: &Path, script: &Path, eds: &Path) -> Outcome {
        let (name, options) = match transport {
            Transport::Socketcand => (
                "socketcand",
                vec!["-i", "socketcand", "--host", "127.0.0.1", "--port", &self.socketcand, "-c", "can0"],
            ),
            Transport::Slcan => ("slcan", vec!["-i", "slcan", "--bus", "{\"sleep_after_open\":0}", "-c"]),
        };
        let report = root().join(format!("target/conformance-{name}.txt"));
        let ask = || -> Command {
            let mut ask = command(python, &[]);
            ask.arg(script).args(&options);
            if matches!(transport, Transport::Slcan) {
                ask.arg(format!("socket://127.0.0.1:{}", self.slcan));
            }
            ask.args(["-n", NODE_ID, "--store", "-e"]).arg(eds);
            ask
        };
        let output = match File::create(&report) {
            Ok(output) => output,
            Err(error) => return Outcome::Failed(format!("{}: {error}", report.display())),
        };
        let outcome = run(ask().stdout(output));
        let lines = std::fs::read_to_string(&report).unwrap_or_default();
        let is_notable =
            |line: &&str| line.starts_with("FAIL") || line.starts_with("WARN") || line.starts_with('#');
        lines.lines().filter(is_notable).for_each(|line| say(format_args!("{name}: {line}")));
        let failed: Vec<&str> =
            lines.lines().filter_map(|line| line.strip_prefix("FAIL ")?.split(' ').next()).collect();
        if failed.is_empty() {
            return outcome;
        }
        let again = failed.into_iter().map(|id| run(ask().args(["--only", id])));
        again.into_iter().find(|outcome| !matches!(outcome, Outcome::Passed)).unwrap_or(Outcome::Passed)
    }

    fn stop(&mut self) {
        // A process that has ended already cannot be ended again, and that is no matter.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Drop for Node {
    fn drop(&mut self) {
        self.stop();
    }
}
