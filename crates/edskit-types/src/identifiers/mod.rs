//! Who uses which CAN-ID, and who is in whose way.
//!
//! A device, or a tool on its behalf, lists what it uses as [`Claim`]s: the active PDOs and the other services, each
//! with its CAN-ID. [`conflicts`] sorts the list and gives every conflict with both parties, by an
//! [`IdentifierRules`] that says what is forbidden besides using one CAN-ID twice. The rules are data, so that a
//! device with rules of its own runs the same function as a linter of data sheets.

mod conflict;
mod party;
mod rules;

pub use conflict::{Conflict, Opponent, conflicts};
pub use party::{Claim, Party, SdoMessage, SdoRole};
pub use rules::{CobIdFault, IdentifierRules, Restriction};

#[cfg(test)]
mod tests;
