//! Nodes in virtual time: random frames, bad buses, updates, and every file of the corpus.

mod bad_bus;
mod corpus;
mod line;
mod random;
mod update;

use edskit_codegen::Layout;
use std::path::Path;

/// The dictionary of a file that can be laid out.
fn layout_of(eds: &Path) -> Layout {
    edskit_codegen::parse(&edskit_tests::read(eds), None).expect("the file can be laid out")
}

/// A device that has every service.
fn everything() -> Layout {
    layout_of(&edskit_tests::root().join("tests/fixtures/nodes/Everything.eds"))
}
