//! The gateway on a bus, in a process of its own.

use crate::process::{Process, edskit};

/// The gateway with these parameters, which tells in JSON; its bus.
fn gateway(parameters: &str) -> (Process, String) {
    let parameters = format!("fixtures/gateway/{parameters}.toml");
    let rest = ["--params", &parameters, "--log", "json", "--listen", "127.0.0.1:0"];
    let process = Process::start(&[&["run", "gateway"], &rest[..]].concat());
    let line = process.wait_for(r#""protocol":"socketcand""#);
    let address = line.split('"').rfind(|part| part.starts_with("127.")).expect("the hub has an address");
    let bus = format!("socketcand:{address}");
    (process, bus)
}

#[test]
fn the_gateway_boots_up_and_answers() {
    let (gateway, bus) = gateway("node-1");
    gateway.wait_for(r#"{"event":"state","state":"pre-operational","time":"#);
    let read = edskit(&["sdo", "read", "1", "1000", "--type", "u32", "--bus", &bus]);
    assert_eq!((read.stdout.as_str(), read.code), ("1000h:00h: 0 (00000000h)\n", 0));
    let eds = ["--eds", "../eds/CANopenGateway.eds", "--bus", &bus];
    let written = edskit(&[&["sdo", "write", "1", "1017", "500"], &eds[..]].concat());
    assert!(written.code == 2 && written.stderr.contains("06010002h"), "GW-OD-24: {}", written.all());
    let reset = edskit(&["nmt", "1", "reset", "--bus", &bus, "--timeout", "5000"]);
    assert_eq!(reset.stdout, "node 1 told to reset itself, and it has booted up\n");
    edskit(&["nmt", "1", "start", "--bus", &bus]);
    gateway.wait_for(r#""state":"operational""#);
}

// GW-CFG-15, GW-CFG-17, GW-APP-16, GW-APP-19
#[test]
fn a_bad_configuration_is_refused_three_times() {
    let (gateway, bus) = gateway("node-2");
    gateway.wait_for(r#""attempt":3,"most":3,"reason":"TPDO5 and TPDO2 on 282h""#);
    gateway.wait_for(r#""number":12412,"name":"CanOpInitErr""#);
    gateway.wait_for(r#""number":3074,"name":"ErrCanOpen""#);
    let silent = edskit(&["sdo", "read", "2", "1000", "--bus", &bus, "--timeout", "100"]);
    assert_eq!(silent.code, 2, "{}", silent.all());
}

#[cfg(unix)]
#[test]
fn a_scenario_goes_on_in_real_time_until_ctrl_c() {
    let trace = crate::Scratch::new("gateway.log");
    let mut gateway = Process::start(&[
        "run",
        "gateway",
        "--params",
        "fixtures/gateway/node-1.toml",
        "--scenario",
        "fixtures/scenarios/started.toml",
        "--listen",
        "127.0.0.1:0",
        "--trace",
        trace.path(),
    ]);
    gateway.wait_for("  scenario: nmt start");
    gateway.wait_for("  operational");
    assert_eq!(gateway.end("INT"), 0);
    let times: Vec<f64> = gateway.lines()[2..]
        .iter()
        .map(|line| line.split_whitespace().next().unwrap().parse().expect("a line begins with its time"))
        .collect();
    assert!(times.is_sorted() && times.last().is_some_and(|last| *last >= 0.5), "{times:?}");
    let frames = std::fs::read_to_string(trace.path()).unwrap();
    for frame in [" 701#00\n", " 000#0100\n"] {
        assert!(frames.contains(frame), "{frame:?}: {frames}");
    }
}
