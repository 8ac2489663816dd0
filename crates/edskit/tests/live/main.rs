//! The commands on a live bus, each in a process of its own: `edskit run` and `bus` on one side, `sdo`, `nmt` and
//! `monitor` on the other.

mod gateway;
mod process;
mod readme;
mod virtual_time;

use process::{Output, Process, edskit};
use std::fs;
use std::path::PathBuf;

const PUMP: &str = "fixtures/generated/Pump.eds";

/// A node with node-ID 5 and the address of its hub.
fn pump() -> (Process, String) {
    let node = Process::start(&["run", PUMP, "--node-id", "5", "--listen", "127.0.0.1:0"]);
    node.wait_for("pre-operational");
    let bus = node.bus("socketcand");
    (node, bus)
}

/// Ends the heartbeat, so that what is heard on the bus does not depend on when.
fn quiet(bus: &str) {
    let written = edskit(&["sdo", "write", "5", "1017", "0", "--type", "u16", "--bus", bus]);
    assert_eq!(written.code, 0, "{}", written.all());
}

/// An output without what differs from run to run.
fn clean(output: &Output, bus: &str) -> String {
    let port = bus.rsplit_once(':').expect("an address has a port").1;
    output.all().replace(port, "<port>")
}

/// A file that is gone when the test is.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        Self(std::env::temp_dir().join(format!("edskit-live-{}-{name}", std::process::id())))
    }

    fn path(&self) -> &str {
        self.0.to_str().expect("temporary paths are UTF-8")
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // A file that stays behind harms nobody.
        let _ = fs::remove_file(&self.0);
    }
}

#[test]
fn entries_are_read_and_written_by_type_and_name() {
    let (_node, bus) = pump();
    let mut all = String::new();
    let cases: [&[&str]; 18] = [
        &["read", "5", "1018:2"],
        &["read", "5", "1008"],
        &["read", "5", "1008", "--type", "string"],
        &["read", "5", "1017", "--eds", PUMP],
        &["write", "5", "1017", "500", "--eds", PUMP],
        &["write", "5", "2000", "-100", "--type", "i16"],
        &["read", "5", "Set speed", "--eds", PUMP],
        &["write", "5", "Gain", "0.1", "--eds", PUMP],
        &["read", "5", "Gain", "--eds", PUMP, "--format", "json"],
        &["write", "5", "Location", "engine room", "--eds", PUMP],
        &["read", "5", "Location", "--eds", PUMP],
        &["read", "5", "Vendor-ID", "--eds", PUMP],
        &["read", "5", "Identity object/Product code", "--eds", PUMP],
        &["read", "5", "Running time", "--eds", PUMP],
        &["read", "5", "Is enabled", "--eds", PUMP],
        &["write", "5", "Is enabled", "false", "--eds", PUMP],
        &["read", "5", "2007", "--format", "json"],
        &["write", "5", "2004", "hall 4", "--type", "string"],
    ];
    for arguments in cases {
        let output = edskit(&[&["sdo"], arguments, &["--bus", &bus]].concat());
        all += &format!("$ edskit sdo {}\n{}\n", arguments.join(" "), clean(&output, &bus));
    }
    insta::assert_snapshot!(all);
}

#[test]
fn every_kind_of_transfer_goes_through() {
    let eds = Scratch::new("log.eds");
    fs::write(eds.path(), "[2008]\nParameterName=Log\nDataType=0x000F\nAccessType=rw\n").unwrap();
    let node = Process::start(&["run", eds.path(), "--node-id", "5", "--listen", "127.0.0.1:0"]);
    let bus = node.bus("socketcand");
    let (input, output) = (Scratch::new("input"), Scratch::new("output"));
    let value: Vec<u8> = (0..7000_u32).map(|place| (place % 251) as u8).collect();
    fs::write(input.path(), &value).unwrap();
    for transfer in ["auto", "segmented", "block"] {
        let rest = ["--bus", &bus, "--transfer", transfer, "--eds", eds.path()];
        let written = edskit(&[&["sdo", "write", "5", "Log", "--file", input.path()], &rest[..]].concat());
        assert_eq!(written.code, 0, "{transfer}: {}", written.all());
        let read = edskit(&[&["sdo", "read", "5", "Log", "--file", output.path()], &rest[..]].concat());
        assert_eq!(read.code, 0, "{transfer}: {}", read.all());
        assert!(fs::read(output.path()).unwrap() == value, "{transfer}");
    }
    let expedited = ["--bus", &bus, "--transfer", "expedited"];
    let written = edskit(&[&["sdo", "write", "5", "2008", "07", "--type", "hex"], &expedited[..]].concat());
    assert_eq!(written.stdout, "2008h:00h = 07\n");
    let refused =
        edskit(&[&["sdo", "write", "5", "2008", "0102030405", "--type", "hex"], &expedited[..]].concat());
    insta::assert_snapshot!("not_expedited", clean(&refused, &bus));
}

#[test]
fn what_goes_wrong_is_explained() {
    let (_node, bus) = pump();
    quiet(&bus);
    let mut all = String::new();
    let cases: [&[&str]; 18] = [
        &["write", "5", "1000", "5", "--eds", PUMP],
        &["write", "5", "1017", "70000", "--eds", PUMP],
        &["write", "5", "1017", "5", "--type", "u32", "--eds", PUMP],
        &["write", "5", "1017", "5", "--type", "u32"],
        &["write", "5", "1017", "5"],
        &["write", "5", "Gain", "11", "--eds", PUMP],
        &["write", "5", "Set speed", "4000", "--eds", PUMP],
        &["write", "5", "1A00:1", "0x20000010", "--eds", PUMP],
        &["write", "5", "1010:1", "1", "--eds", PUMP],
        &["read", "5", "5000"],
        &["read", "5", "5000", "--eds", PUMP],
        &["read", "5", "1018:9", "--eds", PUMP],
        &["read", "5", "Identity object", "--eds", PUMP],
        &["read", "5", "vendor", "--eds", PUMP],
        &["read", "5", "Vendor-ID"],
        &["read", "9", "1000", "--timeout", "100"],
        &["read", "5", "1000", "--type", "float"],
        &["write", "5", "1017", "--file", "nowhere.bin"],
    ];
    for arguments in cases {
        let output = edskit(&[&["sdo"], arguments, &["--bus", &bus]].concat());
        assert_eq!(output.code, 2, "{arguments:?}");
        all += &format!("$ edskit sdo {}\n{}\n", arguments.join(" "), clean(&output, &bus));
    }
    insta::assert_snapshot!(all);
}

#[test]
fn a_bus_that_is_not_there_is_explained() {
    let mut all = String::new();
    let cases: [&[&str]; 5] = [
        &["sdo", "read", "5", "1000", "--bus", "socketcand:127.0.0.1:1/can0"],
        &["sdo", "read", "5", "1000", "--bus", "hub"],
        &["nmt", "5", "start", "--bus", "slcan:127.0.0.1"],
        &["nmt", "128", "start"],
        &["monitor", "--bus", "slcan:127.0.0.1:1"],
    ];
    for arguments in cases {
        let output = edskit(arguments);
        assert_eq!(output.code, 2, "{arguments:?}");
        all += &format!("$ edskit {}\n{}\n", arguments.join(" "), output.all());
    }
    insta::assert_snapshot!(all);
}

#[test]
fn nmt_commands_reach_the_node() {
    let (node, bus) = pump();
    let nmt =
        |arguments: &[&str]| edskit(&[&["nmt"], arguments, &["--bus", &bus, "--timeout", "5000"]].concat());
    assert_eq!(nmt(&["5", "start"]).stdout, "node 5 told to go to operational\n");
    node.wait_for("operational");
    quiet(&bus);
    assert_eq!(nmt(&["all", "stop"]).stdout, "all nodes told to go to stopped\n");
    node.wait_for("stopped");
    let silent = edskit(&["sdo", "read", "5", "1000", "--bus", &bus, "--timeout", "100"]);
    insta::assert_snapshot!("stopped", clean(&silent, &bus));
    assert_eq!(nmt(&["5", "reset"]).stdout, "node 5 told to reset itself, and it has booted up\n");
    assert_eq!(
        nmt(&["5", "reset-comm"]).stdout,
        "node 5 told to reset its communication, and it has booted up\n"
    );
    let states = ["pre-operational", "operational", "stopped", "initialising", "pre-operational"];
    let seen: Vec<String> = node.lines().into_iter().skip(3).take(states.len()).collect();
    assert_eq!(seen, states);
    quiet(&bus);
    let absent = edskit(&["nmt", "9", "reset", "--bus", &bus, "--timeout", "100"]);
    insta::assert_snapshot!("absent", clean(&absent, &bus));
}

#[cfg(unix)]
#[test]
fn the_monitor_shows_what_happens() {
    let (node, bus) = pump();
    let trace = Scratch::new("trace.log");
    let device = format!("{PUMP}@5");
    let mut monitor =
        Process::start(&["monitor", "--bus", &node.bus("slcan"), "--eds", &device, "--trace", trace.path()]);
    // The heartbeat of the fixture, so that the monitor is there before anything else happens.
    monitor.wait_for("heartbeat");
    let sdo = |arguments: &[&str]| edskit(&[&["sdo"], arguments, &["--bus", &bus, "--eds", PUMP]].concat());
    sdo(&["write", "5", "1017", "0"]);
    sdo(&["read", "5", "Location"]);
    sdo(&["write", "5", "Gain", "1.5"]);
    sdo(&["write", "5", "1000", "1"]);
    sdo(&["read", "5", "Location", "--transfer", "block"]);
    edskit(&["nmt", "5", "start", "--bus", &bus]);
    monitor.wait_for("TPDO1");
    edskit(&["nmt", "5", "reset", "--bus", &bus]);
    monitor.wait_for("boot-up");
    assert_eq!(monitor.end("INT"), 0);
    let mut lines: Vec<String> = monitor.lines();
    lines.retain(|line| !line.contains("heartbeat"));
    // The event timer of the TPDO may have run several times.
    lines.dedup_by_key(|line| line.split_once("  ").map(|(_, rest)| rest.to_owned()));
    insta::with_settings!({filters => vec![(r"\d\d:\d\d:\d\d\.\d{6}", "<time>")]}, {
        insta::assert_snapshot!(lines.join("\n"));
    });
    let log = fs::read_to_string(trace.path()).unwrap();
    assert!(log.contains(") can0 605#4004200000000000\n"), "{log}");
}

#[test]
fn the_monitor_follows_a_remapping() {
    let (node, bus) = pump();
    let monitor = Process::start(&["monitor", "--bus", &node.bus("slcan"), "--eds", &format!("{PUMP}@5")]);
    monitor.wait_for("heartbeat");
    let writes = [
        ("1800:1", "0x80000185"),
        ("1A00:0", "0"),
        ("1A00:1", "0x20020020"),
        ("1A00:0", "1"),
        ("1800:1", "0x1B5"),
    ];
    for (place, value) in writes {
        let written = edskit(&["sdo", "write", "5", place, value, "--bus", &bus, "--eds", PUMP]);
        assert_eq!(written.code, 0, "{place}: {}", written.all());
    }
    edskit(&["nmt", "5", "start", "--bus", &bus]);
    let line = monitor.wait_for("TPDO1");
    assert!(line.contains("  1B5h  ") && line.contains("node 5   TPDO1     Power = "), "{line}");
}

#[cfg(unix)]
#[test]
fn a_bus_has_clients_and_ends_when_asked_to() {
    let mut bus = Process::start(&["bus", "--listen", "127.0.0.1:0", "--log", "json"]);
    let line = bus.wait_for(r#"{"event":"listening","protocol":"slcan","#);
    let port = line.rsplit_once(':').unwrap().1.trim_end_matches("\"}");
    let mut node = Process::start(&["run", PUMP, "--bus", &format!("slcan:127.0.0.1:{port}")]);
    bus.wait_for("1 client connected");
    let read = edskit(&[
        "sdo",
        "read",
        "1",
        "1008",
        "--type",
        "string",
        "--bus",
        &format!("slcan:127.0.0.1:{port}"),
    ]);
    assert_eq!(read.stdout, "1008h:00h: \"Pump\"\n");
    assert_eq!(node.end("TERM"), 0);
    bus.wait_for("0 clients connected");
    assert_eq!(bus.end("INT"), 0);
}
