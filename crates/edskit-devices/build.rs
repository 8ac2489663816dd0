//! Generates the object dictionary of the gateway.

fn main() {
    edskit_codegen::compile("../../eds/CANopenGateway.eds");
}
