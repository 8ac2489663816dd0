//! Generates the dictionary of the EDS that `EDSKIT_DEVICE_EDS` names, of a small pump where it names none.

use edskit_codegen::Config;
use std::env;
use std::path::Path;

const VARIABLE: &str = "EDSKIT_DEVICE_EDS";
const PUMP: &str = "tests/fixtures/generated/Pump.eds";

fn main() {
    println!("cargo::rerun-if-env-changed={VARIABLE}");
    let eds = env::var_os(VARIABLE).unwrap_or_else(|| PUMP.into());
    // A relative path begins at the root of the repository.
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    Config::new().name("device").compile(root.join(eds));
}
