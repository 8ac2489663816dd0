//! Lint rules for CANopen EDS, DCF and nodelist.cpj files.
//!
//! A [`Linter`] walks a [`Datasheet`](edskit_model::Datasheet) once and calls each [`Rule`] at the level that it asked
//! for. Rules return [`Finding`]s: data, with places in the file, a help text and edits that would mend them. The
//! crate opens no file and prints nothing.
//!
//! One rule is one file under `rules/`: documentation, metadata, check and tests, plus one line in its group's list.

mod conflicts;
mod context;
mod described;
mod edits;
mod evaluate;
mod finding;
mod fixer;
mod inline_comment;
mod linter;
mod listing;
mod missing;
mod neighbours;
mod numbering;
mod odd_lines;
mod pdos;
mod peers;
mod profile;
mod rule;
mod rule_set;
pub mod rules;
mod settings;
mod suppression;
#[cfg(test)]
mod testing;
mod wording;

pub use context::{Context, MOST_FINDINGS, Report, Variable};
pub use edskit_model::nearest;
pub use finding::{Applicability, Edit, Finding, Fix, Label, Severity};
pub use fixer::{Fixed, fix, fix_with, withdraw_refused};
pub use linter::Linter;
pub use neighbours::Neighbours;
pub use peers::{PEER_FINDINGS, Peer, PeerFinding};
pub use profile::{Profile, ProfileError, StandardDefault, standard_default};
pub use rule::{
    ALL_FILES, Check, DEVICE_FILES, EntryCheck, FileCheck, FileKind, FileKinds, Group, LineCheck, NODE_LISTS,
    ObjectCheck, Rule, SectionCheck, VariableCheck,
};
pub use rule_set::{RuleSet, UnknownRule, find};
pub use settings::{FILE_NAME as SETTINGS_FILE, ProfilePath, Settings, SettingsError};
