//! The edskit command line.

fn main() {}
