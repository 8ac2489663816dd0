//! The code that edskit-codegen generates, as the compiler sees it.

mod build_script;
mod checks;
mod compiler;
mod corpus;
mod hostile;
mod speed;
