//! Object dictionaries in Rust, generated from CANopen EDS and DCF files for `edskit-runtime`.
//!
//! A build script needs one line, and the device another one:
//!
//! ```text
//! // build.rs
//! fn main() { edskit_codegen::compile("eds/Device.eds"); }
//!
//! // main.rs
//! edskit_runtime::include_dictionary!("Device");
//! let node = Node::new(device::Dictionary::new(), Settings::default(), storage);
//! ```
//!
//! | idea | items |
//! |---|---|
//! | for build scripts | [`compile`], [`Config`]; the rules of the linter: [`RuleSet`], [`Severity`] |
//! | the same without files | [`generate`], [`parse`], [`render`] |
//! | the dictionary as data | [`Layout`], [`lay_out`] |
//! | a node without compiling | [`LoadedDictionary`] |
//! | what an EDS cannot say | [`SideFile`] |
//! | what stands against it | [`Problem`] |

mod compile;
mod gate;
mod generate;
mod identifier;
mod layout;
mod loaded;
mod names;
mod problem;
mod render;
mod settings;
mod side_file;
mod text;
mod transliteration;

pub use compile::{Config, compile, write_if_changed};
pub use edskit_lint::{RuleSet, Severity};
pub use generate::{Generated, generate, parse};
pub use identifier::module_name;
pub use layout::{
    Array, CobIdParameter, Counts, Layout, MOST_BYTES, MOST_ENTRIES, Mapped, Mapping, Place, Source, lay_out,
};
pub use loaded::LoadedDictionary;
pub use problem::{InputFile, Problem};
pub use render::{Naming, render};
pub use side_file::SideFile;
