//! Generates the dictionary of the device that `EDSKIT_FIRMWARE_EDS` names, by default that of the pump of the tests.

use std::env;
use std::path::PathBuf;

fn main() {
    println!("cargo::rerun-if-env-changed=EDSKIT_FIRMWARE_EDS");
    println!("cargo::rerun-if-changed=memory.x");
    let folder = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    println!("cargo::rustc-link-search={}", folder.display());
    let pump = || folder.join("../fixtures/generated/Pump.eds");
    let eds = env::var_os("EDSKIT_FIRMWARE_EDS").map_or_else(pump, PathBuf::from);
    edskit_codegen::Config::new().name("device").compile(eds);
}
