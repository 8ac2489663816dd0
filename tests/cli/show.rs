//! `edskit show`.

use edskit_tests::{edskit, edskit_with_input};

const GATEWAY: &str = "../eds/CANopenGateway.eds";
const DRIVE: &str = "fixtures/drive.dcf";

#[test]
fn a_device() {
    insta::assert_snapshot!("show_drive", edskit(&["show", DRIVE]).all());
    let gateway = edskit(&["show", GATEWAY, "--node-id", "5"]).stdout;
    assert!(gateway.contains("$NODEID+0x580 = 585h"), "{gateway}");
}

#[test]
fn one_object_with_its_pdo() {
    insta::assert_snapshot!("show_object", edskit(&["show", DRIVE, "1A00"]).all());
    insta::assert_snapshot!("show_entry", edskit(&["show", DRIVE, "1018:01"]).all());
    insta::assert_snapshot!("show_compact", edskit(&["show", DRIVE, "2100"]).all());
}

#[test]
fn json() {
    insta::assert_snapshot!("show_object_json", edskit(&["show", DRIVE, "1A00", "--format", "json"]).all());
    let device: serde_json::Value =
        serde_json::from_str(&edskit(&["show", DRIVE, "--format", "json"]).stdout).unwrap();
    assert_eq!(device["node_id"], 12);
    assert_eq!(device["pdos"][1]["mapped"][0]["name"], "Statusword");
}

#[test]
fn standard_input() {
    let text = std::fs::read(DRIVE).unwrap();
    assert_eq!(edskit_with_input(&["show", "-"], &text).stdout, edskit(&["show", DRIVE]).stdout);
}
