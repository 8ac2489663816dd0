//! Text and meaning of CANopen EDS, DCF and nodelist.cpj files (CiA 306).
//!
//! - [`Document`] is the text: every byte, every line, lossless. Parsing never fails.
//! - [`Datasheet`] is the meaning: sections, objects, values, each with its place in the text.
//! - [`format()`] gives the canonical text, and [`same_meaning`] tells whether two files say the same.
//! - [`meant`] knows what malformed values were meant to be.
//! - [`nature`] tells what a file is before anybody reads it as an EDS.
//!
//! The crate opens no file, prints nothing and knows no clock.

mod datasheet;
mod document;
mod format;
mod key;
pub mod meant;
pub mod nature;
pub mod own_file;
mod section;
mod similar;
mod span;
mod value;

pub use datasheet::{
    Assumed, Channel, ChannelOffset, Commissioning, Datasheet, Description, DeviceInfo, DictionaryEntry,
    Difference, Entry, Field, FileInfo, ImplicitPdo, ListItem, Meant, Module, ModuleCount, Object, Pdo,
    ResolvedType, Section, SubExtension, SubObject, Tool, Topology, TopologyNode, same_meaning,
};
pub use document::{Document, Encoding, Line, LineEnding, LineKind, Position, is_merge_marker};
pub use format::{Unformattable, format, try_format};
pub use key::{Key, KeyGroup, KeyName, Shape};
pub use section::{ModuleSection, SectionKind};
pub use similar::nearest;
pub use span::Span;
pub use value::{
    EvaluationError, Formula, FormulaError, FormulaErrorKind, FormulaStyle, Number, NumberError,
    NumberErrorKind, Radix, Value, ValueError, ValueErrorKind, octets,
};
