//! Generates one device for both sides of the benchmark of nodes: edskit's dictionary, and zencan's.

fn main() {
    edskit_codegen::compile("fixtures/Bench.eds");

    let device = "fixtures/zencan.toml";
    println!("cargo::rerun-if-changed={device}");
    if let Err(error) = zencan_build::build_node_from_device_config("BENCH", device) {
        println!("cargo::error={device}: {error}");
    }
}
