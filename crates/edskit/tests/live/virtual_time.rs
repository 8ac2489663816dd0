//! Devices on a bus in virtual time: the commands, and a program that speaks the protocol by hand.

use crate::process::{Process, edskit};
use crate::{PUMP, Scratch};
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::net::TcpStream;

/// A program on the bus of a process.
struct Program(BufReader<TcpStream>);

impl Program {
    fn new(process: &Process) -> Self {
        let address = process.wait_for("virtual ");
        let stream =
            TcpStream::connect(address.trim_start_matches("virtual ")).expect("the bus takes connections");
        let mut program = Self(BufReader::new(stream));
        assert_eq!(program.line(), "now 0");
        program
    }

    fn line(&mut self) -> String {
        let mut line = String::new();
        self.0.read_line(&mut line).expect("the bus speaks");
        line.trim_end().to_owned()
    }

    /// Says something, lets so much time pass, and gives the frames that come.
    fn let_pass(&mut self, words: &str, microseconds: u64) -> Vec<String> {
        let mut frames = Vec::new();
        self.0.get_mut().write_all(words.as_bytes()).expect("the bus listens");
        let (mut now, mut end) = (0, u64::MAX);
        while now < end {
            let wait = format!("wait {}\n", if end == u64::MAX { 0 } else { end - now });
            self.0.get_mut().write_all(wait.as_bytes()).expect("the bus listens");
            loop {
                let line = self.line();
                match line.strip_prefix("now ") {
                    Some(time) => break now = time.parse().expect("a time is a number"),
                    None => frames.push(line),
                }
            }
            if end == u64::MAX {
                end = now + microseconds;
            }
        }
        frames
    }
}

#[test]
fn the_commands_attach_to_a_device_in_virtual_time() {
    let node =
        Process::start(&["run", PUMP, "--node-id", "5", "--bus", "virtual", "--listen", "127.0.0.1:0"]);
    let bus = node.bus("virtual");
    let read = edskit(&["sdo", "read", "5", "1018:2", "--type", "u32", "--bus", &bus]);
    assert_eq!(read.code, 0, "{}", read.all());
    let started = edskit(&["nmt", "5", "start", "--bus", &bus]);
    assert_eq!(started.code, 0, "{}", started.all());
    node.wait_for("operational");
    // A minute without an answer is no time at all.
    let silent = edskit(&["sdo", "read", "6", "1018:2", "--timeout", "60000", "--bus", &bus]);
    assert_eq!(silent.code, 2, "{}", silent.all());
    assert!(silent.stderr.contains("no answer within 60000 ms"), "{}", silent.all());
}

#[test]
fn a_bit_takes_as_long_as_the_bit_rate_says() {
    for (bit_rate, times) in [("1000", 1), ("125", 8), ("10", 100)] {
        let node = Process::start(&[
            "run",
            PUMP,
            "--node-id",
            "5",
            "--bus",
            "virtual",
            "--listen",
            "127.0.0.1:0",
            "--bit-rate",
            bit_rate,
        ]);
        let frames = Program::new(&node).let_pass("", 10_000);
        assert_eq!(frames, [format!("frame {} 705 00", 55 * times)], "{bit_rate}");
    }
}

#[test]
fn a_dcf_brings_its_bit_rate() {
    let dcf = Scratch::new("commissioned.dcf");
    let text = "[1000]\nParameterName=Device type\nObjectType=0x7\nDataType=0x0007\nAccessType=ro\nDefaultValue=0\n\n\
                [DeviceComissioning]\nNodeID=5\nBaudrate=125\n";
    fs::write(dcf.path(), text).unwrap();
    let node = Process::start(&["run", dcf.path(), "--bus", "virtual", "--listen", "127.0.0.1:0"]);
    assert_eq!(Program::new(&node).let_pass("", 10_000), ["frame 440 705 00"]);
}

#[cfg(unix)]
#[test]
fn a_scenario_happens_in_virtual_time_and_every_run_is_the_same() {
    let scenario = Scratch::new("virtual-time.toml");
    let steps = "[[step]]\nat = 1.0\nnmt = \"start\"\n\n[[step]]\nat = 2.5\noff = \"governor\"\n";
    fs::write(scenario.path(), steps).unwrap();
    let trace = Scratch::new("virtual-time.log");
    let run = || {
        let mut gateway = Process::start(&[
            "run",
            "gateway",
            "--params",
            "fixtures/gateway/conformance.toml",
            "--scenario",
            scenario.path(),
            "--trace",
            trace.path(),
            "--bus",
            "virtual",
            "--listen",
            "127.0.0.1:0",
        ]);
        let frames = Program::new(&gateway).let_pass("", 5_000_000);
        // Only what has ended has printed everything.
        assert_eq!(gateway.end("INT"), 0);
        let lines: Vec<String> =
            gateway.lines().into_iter().filter(|line| !line.starts_with("virtual ")).collect();
        let recorded = fs::read_to_string(trace.path()).unwrap();
        assert_eq!(recorded.lines().count(), frames.len(), "each frame is recorded once");
        (frames, lines, recorded)
    };
    let (frames, lines, recorded) = run();
    assert!(lines.iter().any(|line| line.contains("2.500000") && line.contains("governor")), "{lines:?}");
    assert!(frames.len() > 50, "{frames:?}");
    assert_eq!((frames, lines, recorded), run());
}

#[test]
fn a_bit_rate_that_means_nothing_is_refused() {
    let mut all = String::new();
    let cases: [&[&str]; 4] = [
        &["run", PUMP, "--bit-rate", "125"],
        &["run", PUMP, "--bus", "virtual", "--bit-rate", "126"],
        &["run", "gateway", "--bus", "virtual", "--bit-rate", "1000"],
        &["sdo", "read", "5", "1000", "--bus", "virtual"],
    ];
    for arguments in cases {
        all += &format!("$ edskit {}\n{}\n", arguments.join(" "), edskit(arguments).all());
    }
    insta::assert_snapshot!(all);
}
